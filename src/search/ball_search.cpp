// SPDX-License-Identifier: BSD-3-Clause
#include "search/ball_search.h"

#include <algorithm>

namespace pcl {
namespace crest {

namespace {

/** \brief In doubles, as a place may be so far from the points that floats of their
 * unit do not reach it.
 */
class BallSearch {
public:
  BallSearch (const PointTree& tree,
              const float* centre,
              double radius,
              std::vector<std::int32_t>& found)
  : tree_ (tree), found_ (found)
  {
    for (int axis = 0; axis < 3; ++axis)
      centre_[axis] = centre[axis] / tree.unit;
    squared_radius_ = (radius / tree.unit) * (radius / tree.unit);
  }

  /** \brief Visits what is below a group of boxes. */
  void
  visit (std::size_t level, std::size_t group)
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
        if (level > 0)
          visit (level - 1, child);
        else
          take (tree_.leaves[child]);
      }
  }

private:
  void
  take (const PointLeaf& leaf)
  {
    for (int i = 0; i < LEAF_SIZE; ++i) {
      const double x = leaf.x[i] - centre_[0];
      const double y = leaf.y[i] - centre_[1];
      const double z = leaf.z[i] - centre_[2];
      if (x * x + y * y + z * z < squared_radius_)
        found_.push_back (leaf.index[i]);
    }
  }

  const PointTree& tree_;
  std::vector<std::int32_t>& found_;
  double centre_[3];
  double squared_radius_;
};

} // namespace

void
findWithin (const PointTree& tree,
            const float* centre,
            double radius,
            std::vector<std::int32_t>& found)
{
  found.clear();
  if (tree.size > 0)
    BallSearch (tree, centre, radius, found).visit (tree.levels.size() - 1, 0);
}

} // namespace crest
} // namespace pcl
