// SPDX-License-Identifier: BSD-3-Clause
// Positions of a grid are told from all others, and smoothed only where they hide a
// surface.
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "sampling/grid_positions.h"
#include "sampling/sample_nodes.h"
#include "support/analytic_surface.h"
#include "support/marching_cubes.h"

#include <algorithm>
#include <cmath>
#include <random>

using namespace pcl::crest;
using Positions = std::vector<Eigen::Vector3f>;

namespace {

constexpr double STEP = 0.02;
/** Marching cubes have somewhat more than one vertex for each step. */
constexpr double SPACING = 0.75 * STEP;

Positions
verticesOf (oracle::GridValues values)
{
  Positions positions;
  for (const pcl::PointXYZ& point : oracle::marchingCubesVertices (
           oracle::heightFieldScene (oracle::ridgeAndValley()), STEP, values))
    positions.emplace_back (point.getVector3fMap());
  return positions;
}

/** \brief All places of a grid on the surface of a box with a square base. */
Positions
gridOnBox (int steps, int height)
{
  Positions positions;
  for (int x = 0; x <= steps; ++x)
    for (int y = 0; y <= steps; ++y)
      for (int z = 0; z <= height; ++z)
        if (std::min ({x, y, z}) == 0 || std::max (x, y) == steps || z == height)
          positions.emplace_back (x, y, z);
  return positions;
}

SampleNodes
resolve (const Positions& positions)
{
  return resolveSamples ({positions.front().data(), nullptr, 3, positions.size()}, 2);
}

TEST (GridPositions, AreToldFromOthers)
{
  const Positions sides = verticesOf (oracle::GridValues::SIDES);
  EXPECT_TRUE (lieOnGrid (sides, SPACING));
  EXPECT_FALSE (lieOnGrid (verticesOf (oracle::GridValues::DISTANCES), SPACING));
  // Off the axes, and a grid that is much finer than the samples.
  const Eigen::AngleAxisf turn (0.3F, Eigen::Vector3f (1.0F, 2.0F, 3.0F).normalized());
  Positions turned = sides;
  for (Eigen::Vector3f& position : turned)
    position = turn * position;
  EXPECT_FALSE (lieOnGrid (turned, SPACING));
  EXPECT_FALSE (lieOnGrid (sides, 5.0 * SPACING));
}

TEST (GridPositions, AreNotThoseOfManySamplesAnywhere)
{
  // So many that there is one at nearly every thousandth of a spacing.
  std::mt19937 random (1);
  std::uniform_real_distribution<float> place (0.0F, 10.0F);
  Positions positions;
  for (int i = 0; i < 200000; ++i) {
    const float x = place (random);
    const float y = place (random);
    positions.emplace_back (x, y, place (random));
  }
  EXPECT_FALSE (lieOnGrid (positions, 1.0));
}

TEST (GridPositions, FarFromTheOriginAreTheSame)
{
  Positions sides = verticesOf (oracle::GridValues::SIDES);
  for (Eigen::Vector3f& position : sides)
    position += Eigen::Vector3f (10.0F, -20.0F, 5.0F);
  EXPECT_TRUE (lieOnGrid (sides, SPACING));
}

TEST (GridPositions, AreSmoothedWhereTheyHideTheSurface)
{
  const SampleNodes nodes = resolve (verticesOf (oracle::GridValues::SIDES));
  ASSERT_FALSE (nodes.isEmpty());
  EXPECT_GT (nodes.findings.flaws[static_cast<std::size_t> (SamplingFlaw::GRID_STEPS)],
             0U);
  EXPECT_TRUE (resolve (verticesOf (oracle::GridValues::DISTANCES)).isEmpty());
  // A cube, and a plate whose sides are in the same windows.
  EXPECT_TRUE (resolve (gridOnBox (40, 40)).isEmpty());
  EXPECT_TRUE (resolve (gridOnBox (70, 3)).isEmpty());
}

} // namespace
