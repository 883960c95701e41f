// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "support/analytic_surface.h"
#include "support/stage_inputs.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

using namespace pcl::crest;

namespace {

pcl::PointNormal
at (float x, float y, float z, const Eigen::Vector3f& normal = Eigen::Vector3f::UnitZ())
{
  pcl::PointNormal point;
  point.getVector3fMap() = Eigen::Vector3f (x, y, z);
  point.getNormalVector3fMap() = normal;
  return point;
}

} // namespace

TEST (OrientedPoints, InvalidPointsAreLeftOutAndKnown)
{
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float inf = std::numeric_limits<float>::infinity();
  pcl::PointCloud<pcl::PointNormal> cloud;
  cloud.push_back (at (0, 0, 0));
  cloud.push_back (at (nan, 0, 0));
  cloud.push_back (at (0, -inf, 0));
  cloud.push_back (at (1, 0, 0, Eigen::Vector3f::Zero()));
  cloud.push_back (at (2, 0, 0, Eigen::Vector3f (0, nan, 1)));
  cloud.push_back (at (3, 0, 0, Eigen::Vector3f (0, 0, 1e-30F)));
  const OrientedPoints points = oracle::pack (cloud);
  EXPECT_EQ (points.size(), 2U);
  EXPECT_EQ (points.packed_index,
             (std::vector<index_t>{points.packed_index[0],
                                   OrientedPoints::INVALID,
                                   OrientedPoints::INVALID,
                                   OrientedPoints::INVALID,
                                   OrientedPoints::INVALID,
                                   points.packed_index[5]}));
  for (const index_t i : {0, 5}) {
    const index_t packed = points.packed_index[i];
    EXPECT_EQ (points.cloud_index[packed], i);
    EXPECT_EQ (points.positions[packed], cloud[i].getVector3fMap());
    EXPECT_EQ (points.normals[packed], Eigen::Vector3f::UnitZ());
  }
  EXPECT_DOUBLE_EQ (points.extent, 3.0);
}

TEST (OrientedPoints, CoincidentPointsBecomeOneWithTheirMeanNormal)
{
  pcl::PointCloud<pcl::PointNormal> cloud;
  cloud.push_back (at (1, 2, 3, {1, 0, 0}));
  cloud.push_back (at (0, 0, 0));
  cloud.push_back (at (1, 2, 3, {0, 1, 0}));
  // Minus zero is zero.
  cloud.push_back (at (-0.0F, 0, 0));
  const OrientedPoints points = oracle::pack (cloud);
  ASSERT_EQ (points.size(), 2U);
  EXPECT_EQ (points.packed_index[0], points.packed_index[2]);
  EXPECT_EQ (points.packed_index[1], points.packed_index[3]);
  EXPECT_EQ (points.cloud_index[points.packed_index[0]], 0);
  EXPECT_TRUE (points.normals[points.packed_index[0]].isApprox (
      Eigen::Vector3f (1, 1, 0).normalized()));
}

TEST (OrientedPoints, CoincidentNormalsThatCancelOutAreInvalid)
{
  pcl::PointCloud<pcl::PointNormal> cloud;
  cloud.push_back (at (0, 0, 0, {0, 0, -1}));
  cloud.push_back (at (1, 0, 0));
  cloud.push_back (at (0, 0, 0, {0, 0, 1}));
  const OrientedPoints points = oracle::pack (cloud);
  ASSERT_EQ (points.size(), 1U);
  EXPECT_EQ (
      points.packed_index,
      (std::vector<index_t>{OrientedPoints::INVALID, 0, OrientedPoints::INVALID}));
}

TEST (OrientedPoints, OrderDoesNotDependOnTheOrderOfTheCloud)
{
  auto cloud = *oracle::sample (oracle::sphere (1.0), 2000);
  const OrientedPoints before = oracle::pack (cloud);
  std::mt19937 random (3);
  std::shuffle (cloud.begin(), cloud.end(), random);
  const OrientedPoints after = oracle::pack (cloud);
  EXPECT_EQ (before.positions, after.positions);
  EXPECT_EQ (before.normals, after.normals);
  EXPECT_NE (before.cloud_index, after.cloud_index);
}

// One point far away makes the cells of the curve so large that all others share one.
TEST (OrientedPoints, OrderWithinACellDoesNotDependOnTheOrderOfTheCloud)
{
  auto cloud = *oracle::sample (oracle::sphere (1.0), 2000);
  const pcl::PointCloud<pcl::PointNormal> once = cloud;
  cloud.push_back (at (1e9F, 0, 0));
  // Three normals a place, whose sum rounds differently in each order.
  std::mt19937 random (3);
  std::uniform_real_distribution<float> number (-1.0F, 1.0F);
  for (const int copy : {1, 2})
    for (pcl::PointNormal point : once) {
      point.getNormalVector3fMap() +=
          0.1F * static_cast<float> (copy) *
          Eigen::Vector3f (number (random), number (random), number (random));
      cloud.push_back (point);
    }
  const OrientedPoints before = oracle::pack (cloud);
  ASSERT_EQ (before.size(), once.size() + 1);
  for (const unsigned threads : {1U, 4U}) {
    std::shuffle (cloud.begin(), cloud.end(), random);
    const OrientedPoints after = packOrientedPoints (oracle::viewOf (cloud), threads);
    EXPECT_EQ (before.positions, after.positions);
    EXPECT_EQ (before.normals, after.normals);
  }
}

TEST (OrientedPoints, FarFromTheOriginNothingIsLost)
{
  pcl::PointCloud<pcl::PointNormal> cloud;
  for (int i = 0; i < 100; ++i)
    cloud.push_back (at (5e5F + static_cast<float> (i), 4e6F, -1e-3F));
  const OrientedPoints points = oracle::pack (cloud);
  EXPECT_EQ (points.size(), 100U);
  EXPECT_DOUBLE_EQ (points.extent, 99.0);
}

TEST (OrientedPoints, LargestAndSmallestFloatsKeepTheirOrder)
{
  for (const float scale : {3e38F, 1e-30F}) {
    pcl::PointCloud<pcl::PointNormal> cloud;
    cloud.push_back (at (scale, -scale, scale));
    cloud.push_back (at (-scale, scale, -scale));
    cloud.push_back (at (0, 0, 0));
    const OrientedPoints points = oracle::pack (cloud);
    ASSERT_EQ (points.size(), 3U);
    EXPECT_NEAR (points.extent / scale, 2.0, 1e-6);
    EXPECT_NEAR (points.edge (points.packed_index[0], points.packed_index[1]).norm() /
                     scale,
                 std::sqrt (12.0),
                 1e-6);
  }
}

TEST (OrientedPoints, PointsOfAnotherCloudAreFoundByPosition)
{
  const float nan = std::numeric_limits<float>::quiet_NaN();
  pcl::PointCloud<pcl::PointNormal> surface;
  surface.push_back (at (1, 0, 0, Eigen::Vector3f::Zero()));
  surface.push_back (at (2, 0, 0));
  surface.push_back (at (1, 0, 0)); // the first has a valid twin
  surface.push_back (at (3, 0, 0, Eigen::Vector3f::Zero()));
  pcl::PointCloud<pcl::PointNormal> cloud;
  cloud.push_back (at (3, 0, 0));
  cloud.push_back (at (1, 0, 0));
  cloud.push_back (at (nan, 0, 0));
  cloud.push_back (at (2.5F, 0, 0));
  std::vector<index_t> found;
  const auto locate = [&] (const std::vector<index_t>& indices) {
    return locatePoints (
        oracle::viewOf (cloud), indices, oracle::viewOf (surface), found);
  };
  EXPECT_EQ (locate ({2, 1, 0}), OrientedPoints::INVALID);
  EXPECT_EQ (found, (std::vector<index_t>{OrientedPoints::INVALID, 2, 3}));
  EXPECT_EQ (locate ({1, 3}), 3);
}
