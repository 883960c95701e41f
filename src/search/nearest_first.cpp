// SPDX-License-Identifier: BSD-3-Clause
#include "search/nearest_first.h"

#include <algorithm>
#include <cstring>

namespace pcl {
namespace crest {

namespace {

std::uint64_t
keyOf (float squared_distance, std::int32_t index)
{
  std::uint32_t bits = 0;
  std::memcpy (&bits, &squared_distance, sizeof (bits));
  return static_cast<std::uint64_t> (bits) << 32 | static_cast<std::uint32_t> (index);
}

bool
isNearer (const Ranked& a, const Ranked& b)
{
  return a.key < b.key;
}

bool
isFarther (const Ranked& a, const Ranked& b)
{
  return a.key > b.key;
}

} // namespace

float
squaredDistanceOf (const Ranked& ranked)
{
  const auto bits = static_cast<std::uint32_t> (ranked.key >> 32);
  float squared_distance = 0.0F;
  std::memcpy (&squared_distance, &bits, sizeof (bits));
  return squared_distance;
}

NearestFirst::NearestFirst (const PointTree& tree, const Kernels& kernels)
: tree_ (tree), kernels_ (kernels)
{}

const std::vector<Ranked>&
NearestFirst::search (std::int32_t place,
                      const float* point,
                      std::size_t count,
                      float limit)
{
  count_ = count;
  limit_ = limit;
  found_.clear();
  nodes_.clear();
  if (count > 0)
    nodes_.push_back ({0, 0, static_cast<std::int32_t> (tree_.levels.size())});
  const Box box{{point[0], point[1], point[2]}, {point[0], point[1], point[2]}};
  while (!nodes_.empty() && nodes_.front().key < worstKey()) {
    const Ranked node = nodes_.front();
    std::pop_heap (nodes_.begin(), nodes_.end(), isFarther);
    nodes_.pop_back();
    if (node.height == 0)
      visitLeaf (node.number, place, point);
    else
      visitGroup (node, box);
  }
  std::sort_heap (found_.begin(), found_.end(), isNearer);
  return found_;
}

void
NearestFirst::visitLeaf (std::int32_t leaf, std::int32_t self, const float* point)
{
  float squared[LEAF_SIZE + KERNEL_SLACK];
  std::int32_t places[LEAF_SIZE + KERNEL_SLACK];
  const int within = kernels_.pointsWithin (
      tree_.leaves.get(), &leaf, 1, point, self, limit_, squared, places);
  for (int i = 0; i < within; ++i) {
    const Ranked neighbor{keyOf (squared[i], tree_.index (places[i])), places[i], 0};
    if (neighbor.key >= worstKey())
      continue;
    if (found_.size() == count_) {
      std::pop_heap (found_.begin(), found_.end(), isNearer);
      found_.pop_back();
    }
    found_.push_back (neighbor);
    std::push_heap (found_.begin(), found_.end(), isNearer);
  }
}

void
NearestFirst::visitGroup (const Ranked& node, const Box& box)
{
  const BoxGroup& group = tree_.levels[node.height - 1][node.number];
  float squared[LEAF_SIZE];
  unsigned within = kernels_.boxesWithin (group, box, limit_, squared);
  for (int i = 0; within != 0; ++i, within >>= 1)
    if ((within & 1U) != 0) {
      const Ranked child{keyOf (squared[i], group.lowest_index[i]),
                         node.number * LEAF_SIZE + i,
                         node.height - 1};
      if (child.key < worstKey()) {
        nodes_.push_back (child);
        std::push_heap (nodes_.begin(), nodes_.end(), isFarther);
      }
    }
}

std::uint64_t
NearestFirst::worstKey() const
{
  return found_.size() < count_ ? ~std::uint64_t{0} : found_.front().key;
}

} // namespace crest
} // namespace pcl
