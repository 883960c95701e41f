// SPDX-License-Identifier: BSD-3-Clause
#include "lidar.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace oracle {

namespace {

using Eigen::Vector3d;
constexpr double DEGREES = 180.0 / M_PI;

void
addBeams (Lidar& lidar, int beams, double lowest, double step)
{
  for (int i = 0; i < beams; ++i)
    lidar.elevations.push_back (lowest + step * i);
}

} // namespace

Lidar
lidarOf (int beams)
{
  Lidar lidar{{}, 1800, 0.015, 0.003};
  switch (beams) {
  case 16:
    addBeams (lidar, 16, -15.0, 2.0);
    break;
  case 32:
    lidar.range_noise = 0.01;
    addBeams (lidar, 32, -92.0 / 3.0, 4.0 / 3.0);
    break;
  case 64:
    lidar = {{}, 2083, 0.01, 0.002};
    addBeams (lidar, 32, -24.33, 0.5);
    addBeams (lidar, 32, -8.33, 1.0 / 3.0);
    break;
  default:
    lidar.columns = 1024;
    addBeams (lidar, 128, -22.5, 45.0 / 127.0);
  }
  return lidar;
}

double
rangeNoise (const Lidar& lidar, double range, double incidence)
{
  // A quarter of the spot is the standard deviation of a beam whose edges are at two.
  return std::hypot (lidar.range_noise,
                     0.25 * lidar.divergence * range * std::tan (incidence));
}

pcl::PointCloud<pcl::PointXYZ>
lidarTurn (const Lidar& lidar,
           const RayCaster& cast,
           const Eigen::Isometry3d& pose,
           unsigned seed)
{
  constexpr double GRAZING = 85.0 / DEGREES;
  std::mt19937 random (seed);
  std::normal_distribution<double> noise (0.0, 1.0);
  pcl::PointCloud<pcl::PointXYZ> cloud;
  for (int column = 0; column < lidar.columns; ++column)
    for (const double elevation : lidar.elevations) {
      const double azimuth = 2.0 * M_PI * column / lidar.columns;
      const double up = elevation / DEGREES;
      const Vector3d direction =
          pose.linear() * Vector3d (std::cos (azimuth) * std::cos (up),
                                    std::sin (azimuth) * std::cos (up),
                                    std::sin (up));
      const Hit hit = cast (pose.translation(), direction);
      const double incidence =
          std::acos (std::min (1.0, std::abs (hit.normal.dot (direction))));
      if (!std::isfinite (hit.distance) || incidence > GRAZING)
        continue;
      const double range =
          hit.distance + rangeNoise (lidar, hit.distance, incidence) * noise (random);
      const Eigen::Vector3f p = (pose.translation() + range * direction).cast<float>();
      cloud.push_back ({p.x(), p.y(), p.z()});
    }
  cloud.sensor_origin_.head<3>() = pose.translation().cast<float>();
  return cloud;
}

View
viewOf (const Lidar& lidar, const Eigen::Isometry3d& pose)
{
  double step = 2.0 * M_PI / lidar.columns;
  for (std::size_t i = 1; i < lidar.elevations.size(); ++i)
    step = std::max (step, (lidar.elevations[i] - lidar.elevations[i - 1]) / DEGREES);
  const double low = lidar.elevations.front() / DEGREES;
  const double high = lidar.elevations.back() / DEGREES;
  const auto covers = [=] (const Vector3d& direction) {
    const double up = std::asin (direction.z());
    return low <= up && up <= high;
  };
  return {pose, covers, step};
}

} // namespace oracle
