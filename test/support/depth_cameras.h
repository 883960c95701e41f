// SPDX-License-Identifier: BSD-3-Clause
// Depth images, as organized clouds without normals in the axes of the scene. Their
// sensor origin is the camera; pixels without depth are not finite.
#pragma once

#include "scene.h"

namespace oracle {

/** \brief A camera for depth by structured light, as the first of these were: 320 x 240
 * pixels, whose disparity is found by windows of 5 x 5 pixels, which share its noise,
 * and in steps of an eighth of a pixel, so that steps of depth grow with its square
 * (Khoshelham and Elberink 2012).
 */
struct DepthCamera {
  static constexpr int WIDTH = 320;
  static constexpr int HEIGHT = 240;
  /** in pixels */
  static constexpr double FOCAL_LENGTH = 290.0;
  /** in metres */
  static constexpr double BASELINE = 0.075;
  static constexpr double DISPARITY_STEP = 0.125;
};

/** \brief An image of it. Without depth are pixels whose window holds a jump, and what
 * the projector, a baseline to the right, does not light.
 * \param[in] pose of the camera in the scene; it looks along z, with x to the right
 */
pcl::PointCloud<pcl::PointXYZ>
depthImage (const RayCaster& cast,
            const Eigen::Isometry3d& pose = Eigen::Isometry3d::Identity(),
            unsigned seed = 1);

View
viewOfDepthCamera (const Eigen::Isometry3d& pose);

/** \brief A camera for depth by time of flight, the second Kinect: 512 x 424 pixels and
 * a focal length of 365 pixels (Lachat et al. 2015), noise that depends on depth and
 * incidence (Fankhauser et al. 2015), none of which pixels share.
 */
struct TimeOfFlightCamera {
  static constexpr int WIDTH = 512;
  static constexpr int HEIGHT = 424;
  /** in pixels */
  static constexpr double FOCAL_LENGTH = 365.0;
};

/** \brief Standard deviation of its depths in metres, of a depth in metres and an angle
 * of incidence in radians (Fankhauser et al. 2015, eq. 8).
 */
double
timeOfFlightNoise (double depth, double incidence);

/** \brief An image of it. Pixels at jumps see both surfaces, and fly between. */
pcl::PointCloud<pcl::PointXYZ>
timeOfFlightImage (const RayCaster& cast,
                   const Eigen::Isometry3d& pose = Eigen::Isometry3d::Identity(),
                   unsigned seed = 1);

View
viewOfTimeOfFlightCamera (const Eigen::Isometry3d& pose);

} // namespace oracle
