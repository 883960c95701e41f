// SPDX-License-Identifier: BSD-3-Clause
// Curvature by one plain fit: the reference for fine detail.
#pragma once

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <vector>

namespace accuracy {

/** \brief How many neighbours a plain cubic is fitted to, beside the sample itself. */
constexpr int PLAIN_NEIGHBORS = 20;

/** \brief The larger |principal curvature| at each sample of a cubic height function
 * with all ten terms, fitted by least squares without weights to the nearest in space,
 * in the frame of the sample's normal (as Cazals and Pouget 2005, with degree 3).
 */
std::vector<double>
plainCubicCurvatures (const pcl::PointCloud<pcl::PointNormal>& cloud);

} // namespace accuracy
