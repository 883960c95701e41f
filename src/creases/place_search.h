// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "search/ball_search.h"
#include "search/position_tree.h"
#include "surface/oriented_points.h"

#include <algorithm>
#include <memory>
#include <vector>

namespace pcl {
namespace crest {

/** \brief Finds places in space, such as feet of creases, within a radius. Its tree
 * gets them moved and scaled to the unit box, where floats do no harm.
 */
class PlaceSearch {
public:
  /** \param[in] points that the places are among, for origin and scale
   *
   * \param[in] places finite
   */
  PlaceSearch (const OrientedPoints& points, const std::vector<Eigen::Vector3d>& places)
  : origin_ (points.positions.empty() ? Eigen::Vector3d::Zero()
                                      : points.positions[0].cast<double>().eval())
  , scale_ (points.extent > 0.0 ? 1.0 / points.extent : 1.0)
  , places_ (places)
  {
    std::vector<Eigen::Vector3f> scaled_places;
    scaled_places.reserve (places.size());
    for (const Eigen::Vector3d& place : places)
      scaled_places.push_back (scaled (place));
    tree_ = treeOver (scaled_places, 1);
  }

  /** \brief The indices of the places nearer than the radius, ascending. */
  void
  within (const Eigen::Vector3d& center, double radius, std::vector<int>& found) const
  {
    // Rounding in the tree's floats must not decide.
    constexpr double SLACK = 1.01;
    findWithin (*tree_, scaled (center).data(), SLACK * scale_ * radius, found);
    found.erase (
        std::remove_if (found.begin(),
                        found.end(),
                        [&] (int i) { return (places_[i] - center).norm() >= radius; }),
        found.end());
    std::sort (found.begin(), found.end());
  }

private:
  Eigen::Vector3f
  scaled (const Eigen::Vector3d& place) const
  {
    return (scale_ * (place - origin_)).cast<float>();
  }

  Eigen::Vector3d origin_;
  double scale_;
  std::vector<Eigen::Vector3d> places_;
  std::shared_ptr<const PointTree> tree_;
};

} // namespace crest
} // namespace pcl
