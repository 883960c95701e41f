// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "search/ball_search.h"
#include "search/position_tree.h"

#include <algorithm>
#include <random>

using namespace pcl::crest;

namespace {

std::vector<std::int32_t>
bruteForce (const std::vector<Eigen::Vector3f>& points,
            const Eigen::Vector3f& centre,
            double radius)
{
  std::vector<std::int32_t> found;
  for (std::size_t i = 0; i < points.size(); ++i)
    if ((points[i] - centre).cast<double>().norm() < radius)
      found.push_back (static_cast<std::int32_t> (i));
  return found;
}

std::vector<Eigen::Vector3f>
randomPoints (std::size_t size, float scale, std::mt19937& random)
{
  std::normal_distribution<float> coordinate (0.0F, scale);
  std::vector<Eigen::Vector3f> points;
  for (std::size_t i = 0; i < size; ++i)
    points.emplace_back (
        coordinate (random), coordinate (random), 0.1F * coordinate (random));
  return points;
}

} // namespace

TEST (BallSearch, EqualsBruteForce)
{
  std::mt19937 random (1);
  for (const float scale : {1e-20F, 1.0F, 1e20F})
    for (const std::size_t size : {1U, 7U, 9U, 100U, 3000U}) {
      const std::vector<Eigen::Vector3f> points = randomPoints (size, scale, random);
      const auto tree = treeOver (points, 1);
      for (const Eigen::Vector3f& centre : randomPoints (50, scale, random))
        // No distance is this near to a limit, which floats could take for either.
        for (const double radius : {0.0317 * scale, 0.41 * scale, 20.0 * scale}) {
          std::vector<std::int32_t> found{-1};
          findWithin (*tree, centre.data(), radius, found);
          std::sort (found.begin(), found.end());
          EXPECT_EQ (found, bruteForce (points, centre, radius))
              << size << " " << radius;
        }
    }
}

TEST (BallSearch, FindsNothingAmongNothing)
{
  const auto tree = treeOver ({}, 1);
  std::vector<std::int32_t> found{3};
  const float centre[] = {0.0F, 0.0F, 0.0F};
  findWithin (*tree, centre, 1.0, found);
  EXPECT_TRUE (found.empty());
}
