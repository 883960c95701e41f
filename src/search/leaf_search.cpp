// SPDX-License-Identifier: BSD-3-Clause
#include "search/leaf_search.h"

#include "search/kernels.h"
#include "search/nearest_first.h"

#include <algorithm>
#include <limits>

namespace pcl {
namespace crest {

namespace {

/** How much farther than for the leaf before, and than for the point before, neighbours
 * are looked for, in squared distance: more finds too many, less has to look again too
 * often. */
constexpr float LEAF_GUESS = 1.3F;
constexpr float POINT_GUESS = 1.25F;
/** How often to guess again before a point is searched for alone. */
constexpr int MOST_GUESSES = 3;

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
  , most_leaves_ (std::min (64 + 8 * nearest_, tree.leafCount()))
  , most_ranked_ (64 + std::max (4 * nearest_, most_))
  {
    leaves_.reserve (most_leaves_ + LEAF_SIZE);
    const std::size_t room = (most_leaves_ + 1) * LEAF_SIZE + KERNEL_SLACK;
    squared_.resize (room);
    places_.resize (room);
    indices_.resize (room);
    ranks_.resize (room);
    const std::size_t results = LEAF_SIZE * most_ + most_ranked_;
    found_places_.resize (results);
    squared_distances_.resize (results);
    found_.places = found_places_.data();
    found_.squared_distances = squared_distances_.data();
  }

  std::size_t
  size () const
  {
    return tree_.size;
  }

  /** \brief Searches for the points [first, last) of one leaf. */
  const LeafNeighbors&
  search (std::int32_t first, std::int32_t last)
  {
    found_.first = first;
    found_.count = last - first;
    used_ = 0;
    const Box box = boxOf (first, last);
    gathered_ = false;
    float farthest = 0.0F;
    for (std::int32_t place = first; place < last; ++place) {
      found_.offsets[place - first] = used_;
      if (nearest_ == 0)
        continue;
      if (limit_ <= 0.0F || !searchNear (place, box, first / LEAF_SIZE)) {
        searchAlone (place);
        gathered_ = false;
        limit_ = LEAF_GUESS * squared_distances_[used_ - 1];
      }
      near_limit_ = POINT_GUESS * squared_distances_[used_ - 1];
      farthest = std::max (farthest, squared_distances_[used_ - 1]);
    }
    found_.offsets[found_.count] = used_;
    limit_ = LEAF_GUESS * farthest;
    return found_;
  }

private:
  /** \brief So many neighbours as there can be of those wanted. */
  static std::size_t
  othersOf (const PointTree& tree, int wanted)
  {
    const std::size_t others = tree.size == 0 ? 0 : tree.size - 1;
    return std::min (others, static_cast<std::size_t> (std::max (0, wanted)));
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

  /** \brief Searches for a point in the leaves near a box that it is in.
   * \return false if it is not worth to guess any more
   */
  bool
  searchNear (std::int32_t place, const Box& box, std::int32_t own)
  {
    float limit = std::min (near_limit_, limit_);
    for (int guesses = 0; guesses < MOST_GUESSES;) {
      if (!gathered_)
        gathered_ = gather (box, own);
      if (!gathered_)
        return false;
      const std::size_t count = pointsWithin (place, limit);
      if (count > most_ranked_)
        return false;
      if (count >= nearest_ && take (count, limit))
        return true;
      if (limit == limit_) {
        const float missing = LEAF_GUESS * static_cast<float> (nearest_ + 1) /
                              static_cast<float> (count + 1);
        limit_ *= std::min (std::max (missing, LEAF_GUESS), 4.0F);
        gathered_ = false;
        ++guesses;
      }
      limit = limit_;
    }
    return false;
  }

  std::size_t
  pointsWithin (std::int32_t place, float limit)
  {
    float point[3];
    coordinatesOf (place, point);
    return static_cast<std::size_t> (
        kernels_.pointsWithin (tree_.leaves.get(),
                               leaves_.data(),
                               static_cast<int> (leaves_.size()),
                               point,
                               place,
                               limit,
                               squared_.data(),
                               places_.data()));
  }

  /** \brief Appends the nearest of all points within a limit.
   * \return false if some as far away as the last may be beyond
   */
  bool
  take (std::size_t count, float limit)
  {
    rank (count);
    std::int32_t* const places = found_places_.data() + used_;
    float* const squared = squared_distances_.data() + used_;
    for (std::size_t i = 0; i < count; ++i) {
      places[ranks_[i]] = places_[i];
      squared[ranks_[i]] = squared_[i];
    }
    std::size_t kept = nearest_;
    if (most_ > nearest_) {
      const float tied = tiedWith (squared[nearest_ - 1]);
      if (tied > limit)
        return false;
      while (kept < std::min (count, most_) && squared[kept] <= tied)
        ++kept;
    }
    used_ += kept;
    return true;
  }

  /** \brief Up to where others are as far away as the last of the nearest. */
  float
  tiedWith (float squared_distance) const
  {
    return static_cast<float> (squared_distance * equidistant_);
  }

  void
  rank (std::size_t count)
  {
    if (kernels_.rankDistinct (
            squared_.data(), static_cast<int> (count), ranks_.data()))
      return;
    for (std::size_t i = 0; i < count; ++i)
      indices_[i] = tree_.index (places_[i]);
    kernels_.rankTied (
        squared_.data(), indices_.data(), static_cast<int> (count), ranks_.data());
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
      found_places_[used_] = neighbor.number;
      squared_distances_[used_] = squaredDistanceOf (neighbor);
      ++used_;
    }
  }

  struct Node {
    int level;
    std::int32_t group;
  };

  const PointTree& tree_;
  std::size_t most_;
  std::size_t nearest_;
  double equidistant_;
  const Kernels& kernels_;
  NearestFirst nearest_first_;
  /** beyond these a guess is too bad to go on with */
  std::size_t most_leaves_;
  std::size_t most_ranked_;
  /** guesses of the squared distance of the last neighbour: for the leaf, for a point
   */
  float limit_ = 0.0F;
  float near_limit_ = 0.0F;
  /** whether leaves_ has those within the limit of the current points */
  bool gathered_ = false;
  std::vector<Node> stack_;
  std::vector<std::int32_t> leaves_;
  std::vector<float> squared_;
  std::vector<std::int32_t> places_;
  std::vector<std::int32_t> indices_;
  std::vector<std::int32_t> ranks_;
  LeafNeighbors found_;
  std::vector<std::int32_t> found_places_;
  std::vector<float> squared_distances_;
  /** how many of these */
  std::size_t used_ = 0;
};

LeafSearch::LeafSearch (const PointTree& tree, const NeighborCount& count, Simd simd)
: worker_ (std::make_unique<Worker> (tree, count, simd))
{}

LeafSearch::~LeafSearch() = default;

const LeafNeighbors&
LeafSearch::searchLeaf (std::size_t leaf)
{
  const std::size_t first = leaf * LEAF_SIZE;
  return worker_->search (
      static_cast<std::int32_t> (first),
      static_cast<std::int32_t> (std::min (first + LEAF_SIZE, worker_->size())));
}

const LeafNeighbors&
LeafSearch::searchPoint (std::int32_t place)
{
  return worker_->search (place, place + 1);
}

} // namespace crest
} // namespace pcl
