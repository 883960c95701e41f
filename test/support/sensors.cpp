// SPDX-License-Identifier: BSD-3-Clause
#include "sensors.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace oracle {

pcl::PointCloud<pcl::PointNormal>
accumulatedFrames (const pcl::PointCloud<pcl::PointNormal>& exact,
                   int frames,
                   double standard_deviation,
                   unsigned seed)
{
  std::mt19937 random (seed);
  std::normal_distribution<double> noise (0.0, standard_deviation);
  pcl::PointCloud<pcl::PointNormal> cloud;
  for (int frame = 0; frame < frames; ++frame)
    for (pcl::PointNormal point : exact) {
      for (float& x : point.getVector3fMap())
        x += static_cast<float> (noise (random));
      cloud.push_back (point);
    }
  return cloud;
}

pcl::PointCloud<pcl::PointXYZ>
depthImage (const PlaneScene& scene)
{
  constexpr int WIDTH = DepthCamera::WIDTH;
  constexpr int HEIGHT = DepthCamera::HEIGHT;
  constexpr double FOCAL = DepthCamera::FOCAL_LENGTH;
  const auto rayOf = [] (int column, int row) {
    return Eigen::Vector3d (
        (column - 0.5 * WIDTH) / FOCAL, (row - 0.5 * HEIGHT) / FOCAL, 1.0);
  };
  std::vector<double> depths;
  for (int row = 0; row < HEIGHT; ++row)
    for (int column = 0; column < WIDTH; ++column) {
      std::vector<double> seen;
      for (const PlaneScene::Plane& plane : scene.planes)
        seen.push_back (plane.offset / plane.normal.dot (rayOf (column, row)));
      depths.push_back (scene.nearest ? *std::min_element (seen.begin(), seen.end())
                                      : *std::max_element (seen.begin(), seen.end()));
    }
  // What matching a window of 5 x 5 pixels makes of the noise of single ones.
  constexpr double NOISE = 0.5;
  std::mt19937 random (1);
  std::normal_distribution<double> noise (0.0, NOISE);
  std::vector<double> disparities;
  for (const double depth : depths)
    disparities.push_back (FOCAL * DepthCamera::BASELINE / depth + noise (random));
  const auto at = [] (int column, int row) {
    return static_cast<std::size_t> (std::clamp (row, 0, HEIGHT - 1) * WIDTH +
                                     std::clamp (column, 0, WIDTH - 1));
  };
  pcl::PointCloud<pcl::PointXYZ> cloud (WIDTH, HEIGHT);
  for (int row = 0; row < HEIGHT; ++row)
    for (int column = 0; column < WIDTH; ++column) {
      double sum = 0.0;
      for (int dy = -2; dy <= 2; ++dy)
        for (int dx = -2; dx <= 2; ++dx)
          sum += disparities[at (column + dx, row + dy)];
      const double steps = std::round (sum / 25.0 / DepthCamera::DISPARITY_STEP);
      const double depth =
          FOCAL * DepthCamera::BASELINE / (steps * DepthCamera::DISPARITY_STEP);
      cloud.at (column, row).getVector3fMap() =
          (depth * rayOf (column, row)).cast<float>();
    }
  return cloud;
}

} // namespace oracle
