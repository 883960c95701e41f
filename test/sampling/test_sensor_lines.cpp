// SPDX-License-Identifier: BSD-3-Clause
// Lines of what sensors give, by the scores of docs/accuracy.md.
#include <pcl/search/kdtree.h>

#include <gtest/gtest.h>

#include "sensor_score.h"

#include <algorithm>

namespace {

struct Expected {
  std::string sensor;
  double precision, wide_recall;
  /** of the drawn length, farther than two resolving spacings from all points */
  double most_off_points;
};

std::ostream&
operator<< (std::ostream& stream, const Expected& expected)
{
  return stream << expected.sensor;
}

class SensorLines : public testing::TestWithParam<Expected> {};

/** \brief The part of the drawn length that is farther from all points than that. */
double
partOffPoints (const accuracy::SensorRun& run,
               const pcl::PointCloud<pcl::PointXYZ>& cloud,
               double distance)
{
  pcl::search::KdTree<pcl::PointXYZ> tree (false);
  tree.setInputCloud (cloud.makeShared());
  double off = 0.0;
  double all = 0.0;
  for (const pcl::crest::CrestLine& line : run.lines)
    for (const auto& polyline : line.polylines)
      for (std::size_t i = 1; i < polyline.size(); ++i) {
        const auto at = [&] (std::size_t place) {
          return (*run.line_cloud)[static_cast<std::size_t> (polyline[place])]
              .getVector3fMap();
        };
        const Eigen::Vector3f middle = 0.5F * (at (i - 1) + at (i));
        pcl::Indices found;
        std::vector<float> squared;
        tree.nearestKSearch ({middle.x(), middle.y(), middle.z()}, 1, found, squared);
        const double length = (at (i) - at (i - 1)).norm();
        all += length;
        off += squared[0] > distance * distance ? length : 0.0;
      }
  return off / all;
}

TEST_P (SensorLines, AreThoseOfTheScene)
{
  for (const oracle::SensorCase& one : oracle::sensorCases()) {
    if (one.sensor != GetParam().sensor || one.scene.name != "blocks")
      continue;
    const oracle::SensorCloud scan = one.scan (2);
    const accuracy::SensorRun run = accuracy::runOn (scan, 2);
    const accuracy::SensorScore score =
        accuracy::scoreSensor (run, one.scene, scan.view);
    EXPECT_GT (score.precision, GetParam().precision);
    EXPECT_GT (score.wide_recall, GetParam().wide_recall);
    EXPECT_GT (score.wide_length, 50.0);
    EXPECT_LT (partOffPoints (run, *scan.cloud, 2.0 * score.resolving_spacing),
               GetParam().most_off_points);
    return;
  }
  FAIL() << "there is no such sensor";
}

// Lines along a floor are far from points between the rings of a lidar.
INSTANTIATE_TEST_SUITE_P (
    Sensors,
    SensorLines,
    testing::Values (Expected{"lidar of 16 beams", 0.8, 0.75, 0.25},
                     Expected{"lidar of 128 beams", 0.85, 0.75, 0.3},
                     Expected{"structured light", 0.85, 0.85, 0.02},
                     Expected{"5 frames", 0.95, 0.75, 0.02},
                     Expected{"two scans 0.5 h apart", 0.95, 0.95, 0.02},
                     Expected{"marching cubes of sides", 0.9, 0.75, 0.02}));

} // namespace
