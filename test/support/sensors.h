// SPDX-License-Identifier: BSD-3-Clause
// Clouds as sensors give them, of surfaces that are known exactly.
#pragma once

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <Eigen/Core>

#include <vector>

namespace oracle {

/** \brief The points of a cloud as a scanner that stands still sees them several times:
 * as many frames, each with its own normal noise. The normals stay.
 */
pcl::PointCloud<pcl::PointNormal>
accumulatedFrames (const pcl::PointCloud<pcl::PointNormal>& exact,
                   int frames,
                   double standard_deviation,
                   unsigned seed = 1);

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

/** \brief What is in front of the camera: planes normal . x = offset, of which it sees
 * the nearest along each ray, or the farthest, as in the corner of a room.
 */
struct PlaneScene {
  struct Plane {
    Eigen::Vector3d normal;
    double offset;
  };
  std::vector<Plane> planes;
  bool nearest = true;
};

/** \brief The image as an organized cloud, without normals. */
pcl::PointCloud<pcl::PointXYZ>
depthImage (const PlaneScene& scene);

} // namespace oracle
