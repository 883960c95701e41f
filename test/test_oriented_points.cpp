// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "support/analytic_surface.h"
#include "support/stage_inputs.h"

#include <algorithm>
#include <limits>
#include <random>

using namespace pcl::crest;

namespace {

pcl::PointNormal
at (float x, float y, float z, Eigen::Vector3f normal = Eigen::Vector3f::UnitZ())
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
             (std::vector<pcl::index_t>{points.packed_index[0],
                                        OrientedPoints::INVALID,
                                        OrientedPoints::INVALID,
                                        OrientedPoints::INVALID,
                                        OrientedPoints::INVALID,
                                        points.packed_index[5]}));
  for (const pcl::index_t i : {0, 5}) {
    const pcl::index_t packed = points.packed_index[i];
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

TEST (OrientedPoints, OppositeCoincidentNormalsLeaveTheFirst)
{
  pcl::PointCloud<pcl::PointNormal> cloud;
  cloud.push_back (at (0, 0, 0, {0, 0, -1}));
  cloud.push_back (at (0, 0, 0, {0, 0, 1}));
  const OrientedPoints points = oracle::pack (cloud);
  ASSERT_EQ (points.size(), 1U);
  EXPECT_EQ (points.normals[0], -Eigen::Vector3f::UnitZ());
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

TEST (OrientedPoints, FarFromTheOriginNothingIsLost)
{
  pcl::PointCloud<pcl::PointNormal> cloud;
  for (int i = 0; i < 100; ++i)
    cloud.push_back (at (5e5F + static_cast<float> (i), 4e6F, -1e-3F));
  const OrientedPoints points = oracle::pack (cloud);
  EXPECT_EQ (points.size(), 100U);
  EXPECT_DOUBLE_EQ (points.extent, 99.0);
}
