// SPDX-License-Identifier: BSD-3-Clause
// Noise that neighbours share.
#pragma once

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <vector>

namespace oracle {

/** \brief Independent noise along all axes, smoothed over the samples by a Gaussian, of
 * unit variance. What it has in common falls to 1 / e over twice the spread.
 */
std::vector<Eigen::Vector3f>
correlatedNoise (const pcl::PointCloud<pcl::PointNormal>& samples,
                 double spread,
                 unsigned seed);

} // namespace oracle
