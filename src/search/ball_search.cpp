// SPDX-License-Identifier: BSD-3-Clause
#include "search/ball_search.h"

#include <algorithm>

namespace pcl {
namespace crest {

namespace {

class BallSearch {
public:
  BallSearch (const PointTree& tree,
              const float* centre,
              double radius,
              std::vector<std::int32_t>& found)
  : tree_ (tree), found_ (found)
  {
    const double scale = 1.0 / tree.unit;
    for (int axis = 0; axis < 3; ++axis)
      centre_[axis] = static_cast<float> (scale * centre[axis]);
    const auto scaled = static_cast<float> (scale * radius);
    squared_radius_ = scaled * scaled;
  }

  /** \brief Visits what is below a group of boxes. */
  void
  visit (std::size_t level, std::size_t group)
  {
    const BoxGroup& boxes = tree_.levels[level][group];
    float squared[LEAF_SIZE] = {};
    for (int axis = 0; axis < 3; ++axis)
      for (int i = 0; i < LEAF_SIZE; ++i) {
        const float below = boxes.low[axis][i] - centre_[axis];
        const float above = centre_[axis] - boxes.high[axis][i];
        const float outside = std::max (std::max (below, above), 0.0F);
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
      const float x = leaf.x[i] - centre_[0];
      const float y = leaf.y[i] - centre_[1];
      const float z = leaf.z[i] - centre_[2];
      if ((x * x + y * y) + z * z < squared_radius_)
        found_.push_back (leaf.index[i]);
    }
  }

  const PointTree& tree_;
  std::vector<std::int32_t>& found_;
  float centre_[3];
  float squared_radius_;
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
