// SPDX-License-Identifier: BSD-3-Clause
#include "performance_clouds.h"

#include <pcl_crest/io/read_cloud.h>
#include <pcl_crest/parameters.h>

#include "io/parse_number.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace performance {

namespace {

/** \brief About `count` points row by row on z = A sin (x) sin (y), which has the same
 * number of points to a wave whatever the count: the sheet grows with it.
 */
PointCloud::Ptr
waves (std::size_t count)
{
  constexpr double POINTS_A_WAVE = 60.0;
  constexpr double AMPLITUDE = 0.6;
  const auto side =
      static_cast<std::size_t> (std::ceil (std::sqrt (static_cast<double> (count))));
  const double step = 2.0 * M_PI / POINTS_A_WAVE;
  auto cloud = pcl::make_shared<PointCloud>();
  cloud->reserve (side * side);
  std::mt19937 random (1); // NOLINT(cert-msc32-c,cert-msc51-cpp): the same each time
  std::uniform_real_distribution<double> jitter (-0.4, 0.4);
  for (std::size_t row = 0; row < side; ++row)
    for (std::size_t column = 0; column < side; ++column) {
      const double x = step * (static_cast<double> (column) + jitter (random));
      const double y = step * (static_cast<double> (row) + jitter (random));
      const Eigen::Vector3d normal (-AMPLITUDE * std::cos (x) * std::sin (y),
                                    -AMPLITUDE * std::sin (x) * std::cos (y),
                                    1.0);
      pcl::PointNormal point;
      point.getVector3fMap() =
          Eigen::Vector3d (x, y, AMPLITUDE * std::sin (x) * std::sin (y)).cast<float>();
      point.getNormalVector3fMap() = normal.normalized().cast<float>();
      cloud->push_back (point);
    }
  return cloud;
}

} // namespace

std::string
makeCloud (const std::string& name, const std::string& source, Cloud& cloud)
{
  std::size_t count = 0;
  cloud.name = name;
  if (pcl::crest::parseNumber (source, count))
    cloud.points = waves (count);
  else {
    pcl::crest::InputCloud input;
    std::string error;
    if (!pcl::crest::readCloud (source, pcl::crest::Parameters().k, 0, input, error))
      return error;
    cloud.points = input.points;
  }
  return {};
}

PointCloud::ConstPtr
shuffled (const PointCloud& cloud)
{
  auto result = pcl::make_shared<PointCloud> (cloud);
  // NOLINTNEXTLINE(cert-msc32-c,cert-msc51-cpp): the same each time
  std::shuffle (result->begin(), result->end(), std::mt19937 (2));
  return result;
}

} // namespace performance
