// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_crest/oriented_points.h>

#include <pcl/kdtree/kdtree_flann.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <algorithm>
#include <vector>

namespace pcl {
namespace crest {

/** \brief Finds places in space, such as feet of creases, within a radius. As with
 * kdTreeSearch, PCL's tree gets them moved and scaled to the unit box.
 */
class PlaceSearch {
public:
  /** \param[in] points that the places are among, for origin and scale */
  PlaceSearch (const OrientedPoints& points, const std::vector<Eigen::Vector3d>& places)
  : origin_ (points.positions.empty() ? Eigen::Vector3d::Zero()
                                      : points.positions[0].cast<double>().eval())
  , scale_ (points.extent > 0.0 ? 1.0 / points.extent : 1.0)
  , places_ (places)
  {
    const auto cloud = pcl::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
    for (const Eigen::Vector3d& place : places)
      cloud->push_back (scaled (place));
    if (!cloud->empty())
      tree_.setInputCloud (cloud);
  }

  /** \brief The indices of the places nearer than the radius, ascending. */
  void
  within (const Eigen::Vector3d& center, double radius, std::vector<int>& found) const
  {
    found.clear();
    if (places_.empty())
      return;
    // Rounding in the tree's floats must not decide.
    constexpr double SLACK = 1.01;
    thread_local std::vector<float> squared;
    tree_.radiusSearch (scaled (center), SLACK * scale_ * radius, found, squared);
    found.erase (
        std::remove_if (found.begin(),
                        found.end(),
                        [&] (int i) { return (places_[i] - center).norm() >= radius; }),
        found.end());
    std::sort (found.begin(), found.end());
  }

private:
  pcl::PointXYZ
  scaled (const Eigen::Vector3d& place) const
  {
    const Eigen::Vector3f p = (scale_ * (place - origin_)).cast<float>();
    return {p.x(), p.y(), p.z()};
  }

  Eigen::Vector3d origin_;
  double scale_;
  std::vector<Eigen::Vector3d> places_;
  pcl::KdTreeFLANN<pcl::PointXYZ> tree_{false};
};

} // namespace crest
} // namespace pcl
