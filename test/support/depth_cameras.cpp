// SPDX-License-Identifier: BSD-3-Clause
#include "depth_cameras.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace oracle {

namespace {

using Cloud = pcl::PointCloud<pcl::PointXYZ>;
using Eigen::Vector3d;

constexpr double NOTHING = std::numeric_limits<double>::quiet_NaN();

/** \brief Towards a place of the image in pixels, with z = 1. */
template <typename Camera>
Vector3d
rayOf (double column, double row)
{
  return {(column - 0.5 * Camera::WIDTH) / Camera::FOCAL_LENGTH,
          (row - 0.5 * Camera::HEIGHT) / Camera::FOCAL_LENGTH,
          1.0};
}

/** \brief The first hit of a ray of the camera; its distance is the depth. */
Hit
castFrom (const Eigen::Isometry3d& pose, const Vector3d& ray, const RayCaster& cast)
{
  const double length = ray.norm();
  Hit hit = cast (pose.translation(), pose.linear() * ray / length);
  hit.distance /= length;
  return hit;
}

template <typename Camera>
Cloud
asCloud (const std::vector<double>& depths, const Eigen::Isometry3d& pose)
{
  Cloud cloud (Camera::WIDTH, Camera::HEIGHT);
  for (std::size_t i = 0; i < depths.size(); ++i) {
    const int pixel = static_cast<int> (i);
    const int row = pixel / Camera::WIDTH;
    const Vector3d ray = rayOf<Camera> (pixel % Camera::WIDTH, row);
    cloud[i].getVector3fMap() = (pose * (depths[i] * ray)).template cast<float>();
    cloud.is_dense = cloud.is_dense && std::isfinite (depths[i]);
  }
  cloud.sensor_origin_.head<3>() = pose.translation().cast<float>();
  cloud.sensor_orientation_ = Eigen::Quaterniond (pose.linear()).cast<float>();
  return cloud;
}

template <typename Camera>
View
viewOf (const Eigen::Isometry3d& pose)
{
  const auto covers = [] (const Vector3d& direction) {
    const auto within = [&] (double aside, int pixels) {
      return std::abs (aside) < direction.z() * 0.5 * pixels / Camera::FOCAL_LENGTH;
    };
    return within (direction.x(), Camera::WIDTH) &&
           within (direction.y(), Camera::HEIGHT);
  };
  return {pose, covers, 1.0 / Camera::FOCAL_LENGTH};
}

/** \brief Disparities of every pixel, in pixels, without noise. */
std::vector<double>
exactDisparities (const RayCaster& cast, const Eigen::Isometry3d& pose)
{
  const Vector3d projector = pose * Vector3d (DepthCamera::BASELINE, 0.0, 0.0);
  std::vector<double> disparities;
  for (int row = 0; row < DepthCamera::HEIGHT; ++row)
    for (int column = 0; column < DepthCamera::WIDTH; ++column) {
      const Vector3d ray = rayOf<DepthCamera> (column, row);
      const double depth = castFrom (pose, ray, cast).distance;
      const Vector3d way = pose * (depth * ray) - projector;
      constexpr double NEAR = 1e-3;
      const bool is_lit =
          std::isfinite (depth) &&
          cast (projector, way.normalized()).distance > (1.0 - NEAR) * way.norm();
      disparities.push_back (
          is_lit ? DepthCamera::FOCAL_LENGTH * DepthCamera::BASELINE / depth : NOTHING);
    }
  return disparities;
}

} // namespace

Cloud
depthImage (const RayCaster& cast, const Eigen::Isometry3d& pose, unsigned seed)
{
  constexpr int WIDTH = DepthCamera::WIDTH;
  constexpr int HEIGHT = DepthCamera::HEIGHT;
  const std::vector<double> exact = exactDisparities (cast, pose);
  // What matching a window of 5 x 5 pixels makes of the noise of single ones.
  constexpr double NOISE = 0.5;
  std::mt19937 random (seed);
  std::normal_distribution<double> noise (0.0, NOISE);
  std::vector<double> disparities;
  for (const double disparity : exact)
    disparities.push_back (disparity + noise (random));
  const auto at = [] (int column, int row) {
    return static_cast<std::size_t> (std::clamp (row, 0, HEIGHT - 1) * WIDTH +
                                     std::clamp (column, 0, WIDTH - 1));
  };
  // More than any face turns from pixel to pixel unless it is seen at a grazing angle.
  constexpr double JUMP = 2.0 * DepthCamera::DISPARITY_STEP;
  const auto jumps = [&] (int column, int row) {
    const double here = exact[at (column, row)];
    return std::abs (here - exact[at (column + 1, row)]) > JUMP ||
           std::abs (here - exact[at (column, row + 1)]) > JUMP;
  };
  std::vector<double> depths;
  for (int row = 0; row < HEIGHT; ++row)
    for (int column = 0; column < WIDTH; ++column) {
      double sum = 0.0;
      for (int dy = -2; dy <= 2; ++dy)
        for (int dx = -2; dx <= 2; ++dx)
          sum += jumps (column + dx, row + dy)
                     ? NOTHING
                     : disparities[at (column + dx, row + dy)];
      const double steps = std::round (sum / 25.0 / DepthCamera::DISPARITY_STEP);
      depths.push_back (DepthCamera::FOCAL_LENGTH * DepthCamera::BASELINE /
                        (steps * DepthCamera::DISPARITY_STEP));
    }
  return asCloud<DepthCamera> (depths, pose);
}

View
viewOfDepthCamera (const Eigen::Isometry3d& pose)
{
  return viewOf<DepthCamera> (pose);
}

double
timeOfFlightNoise (double depth, double incidence)
{
  const double grazing = incidence / (0.5 * M_PI - incidence);
  return 1e-3 * (1.5 - 0.5 * depth + 0.3 * depth * depth +
                 0.1 * std::pow (depth, 1.5) * grazing * grazing);
}

Cloud
timeOfFlightImage (const RayCaster& cast, const Eigen::Isometry3d& pose, unsigned seed)
{
  std::mt19937 random (seed);
  std::normal_distribution<double> noise (0.0, 1.0);
  std::vector<double> depths;
  for (int row = 0; row < TimeOfFlightCamera::HEIGHT; ++row)
    for (int column = 0; column < TimeOfFlightCamera::WIDTH; ++column) {
      // What falls into four quarters of the pixel.
      constexpr double QUARTER = 0.25;
      double depth = 0.0;
      double incidence = 0.0;
      for (const double dx : {-QUARTER, QUARTER})
        for (const double dy : {-QUARTER, QUARTER}) {
          const Vector3d ray = rayOf<TimeOfFlightCamera> (column + dx, row + dy);
          const Hit hit = castFrom (pose, ray, cast);
          const Vector3d direction = pose.linear() * ray.normalized();
          depth += 0.25 * hit.distance;
          incidence +=
              0.25 * std::acos (std::min (1.0, std::abs (hit.normal.dot (direction))));
        }
      const double unit = noise (random);
      depths.push_back (std::isfinite (depth)
                            ? depth + timeOfFlightNoise (depth, incidence) * unit
                            : NOTHING);
    }
  return asCloud<TimeOfFlightCamera> (depths, pose);
}

View
viewOfTimeOfFlightCamera (const Eigen::Isometry3d& pose)
{
  return viewOf<TimeOfFlightCamera> (pose);
}

} // namespace oracle
