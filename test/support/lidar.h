// SPDX-License-Identifier: BSD-3-Clause
// Spinning lidars.
#pragma once

#include "scene.h"

#include <vector>

namespace oracle {

/** \brief Beams in a plane through the axis, which turns around z. */
struct Lidar {
  /** of each beam above the horizon in degrees, rising */
  std::vector<double> elevations;
  /** directions of a turn */
  int columns;
  /** of ranges at right angles, a standard deviation in metres */
  double range_noise;
  /** of a beam, its full angle in radians */
  double divergence;
};

/** \brief Lidars by their data sheets: 16 beams 2 degrees apart (Velodyne VLP-16), 32
 * beams 1.33 degrees apart (HDL-32E), 32 beams a third of a degree apart above 32 beams
 * half a degree apart (HDL-64E), 128 beams .35 degrees apart (Ouster OS1-128). All turn
 * ten times a second. The noise is half the accuracy that is stated.
 * \param[in] beams one of these numbers
 */
Lidar
lidarOf (int beams);

/** \brief The standard deviation of a range in metres: at an angle of incidence, in
 * radians, a beam lights a spot that is deep, and what comes back first varies.
 */
double
rangeNoise (const Lidar& lidar, double range, double incidence);

/** \brief A turn, as a cloud in the axes of the scene whose sensor origin is the lidar.
 * What is met at less than five degrees gives no return.
 */
pcl::PointCloud<pcl::PointXYZ>
lidarTurn (const Lidar& lidar,
           const RayCaster& cast,
           const Eigen::Isometry3d& pose,
           unsigned seed = 1);

View
viewOf (const Lidar& lidar, const Eigen::Isometry3d& pose);

} // namespace oracle
