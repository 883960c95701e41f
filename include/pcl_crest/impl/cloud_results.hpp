// SPDX-License-Identifier: BSD-3-Clause
// The results of the stages, which are those of packed points, for the points of a
// cloud.
#pragma once

#include <pcl_crest/crest_extraction.h>

#include <pcl/memory.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <cmath>
#include <limits>

namespace pcl {
namespace crest {

/** \brief The label of a packed point, or of what is none. */
inline Label
labelAt (const std::vector<Label>& labels, index_t packed)
{
  return packed == OrientedPoints::INVALID ? LABEL_INVALID : labels[packed];
}

/** \brief The curvature of a packed point; NaN where it has none. */
inline pcl::PrincipalCurvatures
curvatureAt (const std::vector<PrincipalCurvature>& curvature, index_t packed)
{
  const float nan = std::numeric_limits<float>::quiet_NaN();
  if (packed == OrientedPoints::INVALID || !curvature[packed].valid)
    return {nan, nan, nan, nan, nan};
  const PrincipalCurvature& c = curvature[packed];
  return {c.t1.x(), c.t1.y(), c.t1.z(), c.k1, c.k2};
}

/** \brief Whether points of the same places in two clouds belong together. */
template <typename PointA, typename PointB>
bool
haveSameLayout (const pcl::PointCloud<PointA>& a, const pcl::PointCloud<PointB>& b)
{
  return a.header == b.header && a.width == b.width && a.height == b.height;
}

/** \brief The curvatures of packed points, laid out as another cloud of theirs is. */
template <typename PointT>
pcl::PointCloud<pcl::PrincipalCurvatures>::ConstPtr
curvaturesOf (const pcl::Indices& packed_indices,
              const std::vector<PrincipalCurvature>& curvature,
              const pcl::PointCloud<PointT>& layout)
{
  auto curvatures = pcl::make_shared<pcl::PointCloud<pcl::PrincipalCurvatures>>();
  curvatures->reserve (packed_indices.size());
  for (const index_t packed : packed_indices) {
    curvatures->push_back (curvatureAt (curvature, packed));
    if (std::isnan (curvatures->back().pc1))
      curvatures->is_dense = false;
  }
  curvatures->header = layout.header;
  curvatures->width = layout.width;
  curvatures->height = layout.height;
  return curvatures;
}

/** \brief Lines with indices into the cloud. */
inline std::vector<CrestLine>
linesOfCloud (const OrientedPoints& points, std::vector<CrestLine> lines)
{
  for (CrestLine& line : lines)
    for (std::vector<index_t>& polyline : line.polylines)
      for (index_t& point : polyline)
        point = points.cloud_index[point];
  return lines;
}

/** \brief A copy of the cloud with the points on lines where these run.
 * \param[in] lines with indices into the cloud
 * \param[in] positions of the packed points
 */
template <typename PointT>
typename pcl::PointCloud<PointT>::Ptr
cloudOfLines (const pcl::PointCloud<PointT>& cloud,
              const OrientedPoints& points,
              const std::vector<CrestLine>& lines,
              const std::vector<Eigen::Vector3f>& positions)
{
  auto moved = pcl::make_shared<pcl::PointCloud<PointT>> (cloud);
  for (const CrestLine& line : lines)
    for (const std::vector<index_t>& polyline : line.polylines)
      for (const index_t point : polyline)
        (*moved)[point].getVector3fMap() = positions[points.packed_index[point]];
  return moved;
}

} // namespace crest
} // namespace pcl
