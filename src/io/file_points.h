// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_crest/io/read_cloud.h>

#include <cstring>

namespace pcl {
namespace crest {

/** \brief The points of a file, their positions in doubles, within the memory of the
 * cloud of floats that they become: beside it they would take half as much again.
 */
class FilePoints {
public:
  FilePoints() : cloud_ (new pcl::PointCloud<pcl::PointNormal>) {}

  std::size_t
  size () const
  {
    return cloud_->size();
  }

  void
  reserve (std::size_t points)
  {
    cloud_->reserve (points);
  }

  /** \brief Adds a point of the numbers of a file: three, or six with normals. */
  void
  add (const double* values, bool with_normal)
  {
    pcl::PointNormal point;
    if (with_normal)
      point.getNormalVector3fMap() =
          Eigen::Map<const Eigen::Vector3d> (values + 3).cast<float>();
    std::memcpy (point.data, values, sizeof (point.data));
    std::memcpy (point.data_c, values + 2, sizeof (double));
    cloud_->push_back (point);
  }

  void
  setNormal (std::size_t i, const Eigen::Vector3f& normal)
  {
    (*cloud_)[i].getNormalVector3fMap() = normal;
  }

  /** \brief The position of a point, as the file has it. */
  Eigen::Vector3d
  operator[] (std::size_t i) const
  {
    const pcl::PointNormal& point = (*cloud_)[i];
    Eigen::Vector3d position;
    std::memcpy (position.data(), point.data, sizeof (point.data));
    std::memcpy (position.data() + 2, point.data_c, sizeof (double));
    return position;
  }

  /** \brief The cloud near the origin; there are no points here any more. */
  pcl::PointCloud<pcl::PointNormal>::Ptr
  place (const Placement& placement)
  {
    for (std::size_t i = 0; i < size(); ++i) {
      const Eigen::Vector3f position = placement.toCloud ((*this)[i]);
      pcl::PointNormal& point = (*cloud_)[i];
      const Eigen::Vector3f normal = point.getNormalVector3fMap();
      point = pcl::PointNormal();
      point.getVector3fMap() = position;
      point.getNormalVector3fMap() = normal;
    }
    return std::move (cloud_);
  }

private:
  static_assert (sizeof (pcl::PointNormal::data) == 2 * sizeof (double) &&
                     sizeof (pcl::PointNormal::data_c) >= sizeof (double),
                 "x and y take the place of three floats and their padding, z that of "
                 "the curvature");

  pcl::PointCloud<pcl::PointNormal>::Ptr cloud_;
};

} // namespace crest
} // namespace pcl
