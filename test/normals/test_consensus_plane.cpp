// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "normals/consensus_plane.h"

#include <algorithm>
#include <random>

namespace {

using pcl::crest::consensusPlane;
using pcl::crest::Coordinates;

/** \brief Points as offsets, the nearest first. */
Coordinates
byDistance (std::vector<Eigen::Vector3d> points)
{
  std::sort (points.begin(), points.end(), [] (const auto& a, const auto& b) {
    return a.squaredNorm() < b.squaredNorm();
  });
  Coordinates offsets;
  offsets.resize (points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    offsets.set (i, points[i]);
  return offsets;
}

/** \brief What is within 2.8 of a sample on the rim of a plate: rows that are 1 apart,
 * with noise, seen from one in the middle.
 *
 * \param[in] rows of the rim
 */
Coordinates
onRim (int rows, double noise, std::mt19937& random)
{
  std::normal_distribution<double> normal (0.0, noise);
  std::vector<Eigen::Vector3d> points;
  const auto add = [&] (double x, double y, double z) {
    const Eigen::Vector3d point (x, y, z);
    if (!point.isZero (0.0) && point.norm() <= 2.8)
      points.emplace_back (
          point + Eigen::Vector3d (normal (random), normal (random), normal (random)));
  };
  const int first = -(rows - 1) / 2;
  const int last = first + rows - 1;
  for (int along = -3; along <= 3; ++along) {
    for (int across = first; across <= last; ++across)
      add (along + 0.3 * across, across, 0.0);
    for (int inward = 0; inward < 3; ++inward) {
      add (along + 0.4, first - 0.5, 0.5 + inward);
      add (along + 0.1, last + 0.5, 0.5 + inward);
    }
  }
  return byDistance (std::move (points));
}

TEST (ConsensusPlane, IsThatOfTheFaceThatTheSampleIsOn)
{
  std::mt19937 random (3);
  for (const double noise : {0.0, 0.02, 0.05}) {
    const auto found = consensusPlane (onRim (3, noise, random), 0.03 + 3.0 * noise);
    ASSERT_TRUE (found) << noise;
    EXPECT_NEAR (found->norm(), 1.0F, 1e-5F);
    EXPECT_GT (std::abs (found->z()), noise == 0.0 ? 1.0F - 1e-6F : 0.99F) << noise;
  }
}

TEST (ConsensusPlane, IsNoneWhereAnotherIsAsGood)
{
  // The other row of the rim is a plane with the sample's, as is the first of a sheet.
  std::mt19937 random (3);
  EXPECT_FALSE (consensusPlane (onRim (2, 0.0, random), 0.03));
}

TEST (ConsensusPlane, IsNoneWhereFewAgree)
{
  std::mt19937 random (5);
  std::uniform_real_distribution<double> uniform (-3.0, 3.0);
  for (int run = 0; run < 100; ++run) {
    std::vector<Eigen::Vector3d> ball;
    for (int i = 0; i < 24; ++i)
      ball.emplace_back (uniform (random), uniform (random), uniform (random));
    EXPECT_FALSE (consensusPlane (byDistance (ball), 0.03));
  }
}

TEST (ConsensusPlane, RowsSpanNone)
{
  std::vector<Eigen::Vector3d> row;
  for (int i = -12; i <= 12; ++i)
    row.emplace_back (i, 0.0, 0.0);
  EXPECT_FALSE (consensusPlane (byDistance (row), 0.03));
  EXPECT_FALSE (consensusPlane (Coordinates(), 0.03));
}

} // namespace
