// SPDX-License-Identifier: BSD-3-Clause
// Clouds as scans from all sides give them, of even samples that are known exactly.
#pragma once

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <Eigen/Core>

namespace oracle {

/** \brief The points of a cloud as a scanner that stands still sees them several times:
 * as many frames, each with its own normal noise. The normals stay.
 */
pcl::PointCloud<pcl::PointNormal>
accumulatedFrames (const pcl::PointCloud<pcl::PointNormal>& exact,
                   int frames,
                   double standard_deviation,
                   unsigned seed = 1);

/** \brief Two scans of one surface whose registration is off, by half of that distance
 * to either side, each with its own normal noise. The normals stay.
 */
pcl::PointCloud<pcl::PointNormal>
registeredScans (const pcl::PointCloud<pcl::PointNormal>& first,
                 const pcl::PointCloud<pcl::PointNormal>& second,
                 const Eigen::Vector3d& apart,
                 double standard_deviation,
                 unsigned seed = 1);

/** \brief What dense matching of photographs makes of samples. All lengths in h, mean
 * distance to the 6 nearest.
 */
struct Photogrammetry {
  /** over which what the noise of two samples has in common falls to 1 / e; half of it
   * and more are the windows that are matched */
  double correlation_length = 5.0;
  /** standard deviation along each axis, and of what samples do not share */
  double correlated_noise = 0.25;
  double own_noise = 0.05;
  /** balls without samples, where there is nothing to match, and the part of the
   * samples that they take */
  double hole_radius = 5.0;
  double part_in_holes = 0.05;
};

/** \brief The normals stay. */
pcl::PointCloud<pcl::PointNormal>
photogrammetry (const pcl::PointCloud<pcl::PointNormal>& exact,
                const Photogrammetry& how,
                unsigned seed = 1);

} // namespace oracle
