// SPDX-License-Identifier: BSD-3-Clause
#include "search/ball_search.h"

#include <algorithm>

namespace pcl {
namespace crest {

namespace {

/** \brief In doubles, as a place may be so far from the points that floats of their
 * unit do not reach it.
 * \param Use called for the index of each point; ends the search by true
 */
template <typename Use>
class BallSearch {
public:
  BallSearch (const PointTree& tree, const float* centre, double radius, const Use& use)
  : tree_ (tree), use_ (use)
  {
    for (int axis = 0; axis < 3; ++axis)
      centre_[axis] = centre[axis] / tree.unit;
    squared_radius_ = (radius / tree.unit) * (radius / tree.unit);
  }

  /** \brief Visits what is below a group of boxes; whether the search has ended. */
  bool
  visit (std::size_t level, std::size_t group) const
  {
    const BoxGroup& boxes = tree_.levels[level][group];
    double squared[LEAF_SIZE] = {};
    for (int axis = 0; axis < 3; ++axis)
      for (int i = 0; i < LEAF_SIZE; ++i) {
        const double below = boxes.low[axis][i] - centre_[axis];
        const double above = centre_[axis] - boxes.high[axis][i];
        const double outside = std::max (std::max (below, above), 0.0);
        squared[i] += outside * outside;
      }
    for (int i = 0; i < LEAF_SIZE; ++i)
      if (squared[i] < squared_radius_) {
        const std::size_t child = group * LEAF_SIZE + static_cast<std::size_t> (i);
        if (level > 0 ? visit (level - 1, child) : take (tree_.leaves[child]))
          return true;
      }
    return false;
  }

private:
  bool
  take (const PointLeaf& leaf) const
  {
    for (int i = 0; i < LEAF_SIZE; ++i) {
      const double x = leaf.x[i] - centre_[0];
      const double y = leaf.y[i] - centre_[1];
      const double z = leaf.z[i] - centre_[2];
      if (x * x + y * y + z * z < squared_radius_ && use_ (leaf.index[i]))
        return true;
    }
    return false;
  }

  const PointTree& tree_;
  const Use& use_;
  double centre_[3];
  double squared_radius_;
};

template <typename Use>
bool
search (const PointTree& tree, const float* centre, double radius, const Use& use)
{
  return tree.size > 0 &&
         BallSearch<Use> (tree, centre, radius, use).visit (tree.levels.size() - 1, 0);
}

} // namespace

void
findWithin (const PointTree& tree,
            const float* centre,
            double radius,
            std::vector<std::int32_t>& found)
{
  found.clear();
  search (tree, centre, radius, [&found] (std::int32_t i) {
    found.push_back (i);
    return false;
  });
}

bool
anyWithin (const PointTree& tree,
           const float* centre,
           double radius,
           const std::function<bool (std::int32_t)>& holds)
{
  return search (tree, centre, radius, holds);
}

} // namespace crest
} // namespace pcl
