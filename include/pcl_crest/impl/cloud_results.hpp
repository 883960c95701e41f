// SPDX-License-Identifier: BSD-3-Clause
// The results of the stages, which are those of packed points, for the points of a
// cloud.
#pragma once

#include <pcl_crest/crest_extraction.h>

#include <pcl/memory.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

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
