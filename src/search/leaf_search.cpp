// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_crest/search/leaf_search.h>

#include "kernels.h"
#include "nearest_first.h"

#include <algorithm>
#include <limits>

namespace pcl {
namespace crest {

namespace {

/** How much farther than in the leaf before neighbours are looked for, in squared
 * distance: more finds too many, less has to look again too often. */
constexpr float GUESS = 1.3F;

} // namespace

class LeafSearch::Worker {
public:
  Worker (const PointTree& tree, const NeighborCount& count, Simd simd)
  : tree_ (tree)
  , most_ (othersOf (tree, std::max (count.nearest, count.most)))
  , nearest_ (othersOf (tree, count.nearest))
  , equidistant_ (1.0 + count.equidistant)
  , kernels_ (kernelsFor (simd))
  , nearest_first_ (tree, kernels_)
  , most_leaves_ (64 + 8 * static_cast<std::size_t> (nearest_))
  , most_ranked_ (64 + std::max (4 * nearest_, most_))
  {
    leaves_.reserve (most_leaves_ + LEAF_SIZE);
    const std::size_t room = (most_leaves_ + 1) * LEAF_SIZE + KERNEL_SLACK;
    squared_.resize (room);
    places_.resize (room);
    indices_.resize (room);
    ranks_.resize (room);
  }

  std::size_t
  size () const
  {
    return tree_.size;
  }

  /** \brief Searches for the points [first, last) of one leaf. */
  const Neighborhoods&
  search (std::int32_t first, std::int32_t last)
  {
    found_.first = first;
    found_.count = last - first;
    found_.places.clear();
    found_.squared_distances.clear();
    const Box box = boxOf (first, last);
    const std::int32_t own = first / LEAF_SIZE;
    bool gathered = limit_ > 0.0F && gather (box, own);
    float farthest = 0.0F;
    for (std::int32_t place = first; place < last; ++place) {
      found_.offsets[place - first] = found_.places.size();
      if (nearest_ == 0)
        continue;
      if (!gathered || !searchGathered (place)) {
        searchAlone (place);
        limit_ = GUESS * found_.squared_distances.back();
        gathered = place + 1 < last && gather (box, own);
      }
      farthest = std::max (farthest, found_.squared_distances.back());
    }
    found_.offsets[found_.count] = found_.places.size();
    limit_ = GUESS * farthest;
    return found_;
  }

private:
  /** \brief So many neighbours as there can be of those wanted. */
  static int
  othersOf (const PointTree& tree, int wanted)
  {
    const std::size_t others = tree.size == 0 ? 0 : tree.size - 1;
    return static_cast<int> (
        std::min (others, static_cast<std::size_t> (std::max (0, wanted))));
  }

  static const Kernels&
  kernelsFor (Simd simd)
  {
    const Kernels* const kernels = simd == Simd::AVX2   ? avx2Kernels()
                                   : simd == Simd::SSE2 ? sse2Kernels()
                                                        : nullptr;
    return kernels == nullptr ? portableKernels() : *kernels;
  }

  void
  coordinatesOf (std::int32_t place, float* point) const
  {
    const PointLeaf& leaf = tree_.leaves[place / LEAF_SIZE];
    point[0] = leaf.x[place % LEAF_SIZE];
    point[1] = leaf.y[place % LEAF_SIZE];
    point[2] = leaf.z[place % LEAF_SIZE];
  }

  Box
  boxOf (std::int32_t first, std::int32_t last) const
  {
    Box box;
    coordinatesOf (first, box.low);
    coordinatesOf (first, box.high);
    for (std::int32_t place = first + 1; place < last; ++place) {
      float point[3];
      coordinatesOf (place, point);
      for (int axis = 0; axis < 3; ++axis) {
        box.low[axis] = std::min (box.low[axis], point[axis]);
        box.high[axis] = std::max (box.high[axis], point[axis]);
      }
    }
    return box;
  }

  /** \brief Lists the leaves within the limit of a box, its own first.
   * \return false if there are too many
   */
  bool
  gather (const Box& box, std::int32_t own)
  {
    leaves_.assign (1, own);
    stack_.clear();
    stack_.push_back ({static_cast<int> (tree_.levels.size()) - 1, 0});
    while (!stack_.empty()) {
      const Node node = stack_.back();
      stack_.pop_back();
      float ignored[LEAF_SIZE];
      unsigned within = kernels_.boxesWithin (
          tree_.levels[node.level][node.group], box, limit_, ignored);
      for (; within != 0; within &= within - 1) {
        const std::int32_t child = node.group * LEAF_SIZE + __builtin_ctz (within);
        if (node.level > 0)
          stack_.push_back ({node.level - 1, child});
        else if (child != own)
          leaves_.push_back (child);
      }
      if (leaves_.size() > most_leaves_)
        return false;
    }
    return true;
  }

  /** \brief Appends the neighbours of a point that are in the listed leaves, unless the
   * limit was too small to have them all.
   */
  bool
  searchGathered (std::int32_t place)
  {
    float point[3];
    coordinatesOf (place, point);
    const int count = kernels_.pointsWithin (tree_.leaves.data(),
                                             leaves_.data(),
                                             static_cast<int> (leaves_.size()),
                                             point,
                                             place,
                                             limit_,
                                             squared_.data(),
                                             places_.data());
    if (count < nearest_ || count > most_ranked_)
      return false;
    rank (count);
    const std::size_t before = found_.places.size();
    resizeFound (before + static_cast<std::size_t> (count));
    std::int32_t* const places = found_.places.data() + before;
    float* const squared = found_.squared_distances.data() + before;
    for (int i = 0; i < count; ++i) {
      places[ranks_[i]] = places_[i];
      squared[ranks_[i]] = squared_[i];
    }
    const float tied = tiedWith (squared[nearest_ - 1]);
    if (most_ > nearest_ && tied > limit_) {
      resizeFound (before);
      return false;
    }
    int kept = nearest_;
    while (kept < std::min (count, most_) && squared[kept] <= tied)
      ++kept;
    resizeFound (before + static_cast<std::size_t> (kept));
    return true;
  }

  /** \brief Up to where others are as far away as the last of the nearest. */
  float
  tiedWith (float squared_distance) const
  {
    return static_cast<float> (squared_distance * equidistant_);
  }

  void
  resizeFound (std::size_t size)
  {
    found_.places.resize (size);
    found_.squared_distances.resize (size);
  }

  void
  rank (int count)
  {
    if (kernels_.rankDistinct (squared_.data(), count, ranks_.data()))
      return;
    for (int i = 0; i < count; ++i)
      indices_[i] = tree_.index (places_[i]);
    kernels_.rankTied (squared_.data(), indices_.data(), count, ranks_.data());
  }

  void
  searchAlone (std::int32_t place)
  {
    float point[3];
    coordinatesOf (place, point);
    // Distances are finite, but the places that the last leaf leaves empty are not.
    const std::vector<Ranked>* found = &nearest_first_.search (
        place, point, nearest_, std::numeric_limits<float>::max());
    if (most_ > nearest_) {
      const float tied = tiedWith (squaredDistanceOf (found->back()));
      found = &nearest_first_.search (place, point, most_, tied);
    }
    for (const Ranked& neighbor : *found) {
      found_.places.push_back (neighbor.number);
      found_.squared_distances.push_back (squaredDistanceOf (neighbor));
    }
  }

  struct Node {
    int level;
    std::int32_t group;
  };

  const PointTree& tree_;
  int most_;
  int nearest_;
  double equidistant_;
  const Kernels& kernels_;
  NearestFirst nearest_first_;
  /** beyond these a guess is too bad to go on with */
  std::size_t most_leaves_;
  int most_ranked_;
  /** squared, of the current guess */
  float limit_ = 0.0F;
  std::vector<Node> stack_;
  std::vector<std::int32_t> leaves_;
  std::vector<float> squared_;
  std::vector<std::int32_t> places_;
  std::vector<std::int32_t> indices_;
  std::vector<std::int32_t> ranks_;
  Neighborhoods found_;
};

LeafSearch::LeafSearch (const PointTree& tree, const NeighborCount& count, Simd simd)
: worker_ (std::make_unique<Worker> (tree, count, simd))
{}

LeafSearch::~LeafSearch() = default;

const Neighborhoods&
LeafSearch::searchLeaf (std::size_t leaf)
{
  const std::size_t first = leaf * LEAF_SIZE;
  return worker_->search (
      static_cast<std::int32_t> (first),
      static_cast<std::int32_t> (std::min (first + LEAF_SIZE, worker_->size())));
}

const Neighborhoods&
LeafSearch::searchPoint (std::int32_t place)
{
  return worker_->search (place, place + 1);
}

} // namespace crest
} // namespace pcl
