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

TEST (BallSearch, EndsWithTheFirstThatAConditionHoldsOf)
{
  std::mt19937 random (2);
  std::vector<Eigen::Vector3f> points = randomPoints (2000, 1.0F, random);
  // As of directions to points on one line.
  points.insert (points.end(), 2000, Eigen::Vector3f (0.1F, 0.2F, 0.0F));
  const auto tree = treeOver (points, 1);
  for (const Eigen::Vector3f& centre : randomPoints (50, 1.0F, random))
    for (const int part : {2, 17, 5000}) {
      const auto holds = [part] (std::int32_t i) { return i % part == part - 1; };
      const std::vector<std::int32_t> within = bruteForce (points, centre, 0.41);
      std::size_t asked = 0;
      const bool found = anyWithin (*tree, centre.data(), 0.41, [&] (std::int32_t i) {
        EXPECT_TRUE (std::find (within.begin(), within.end(), i) != within.end());
        ++asked;
        return holds (i);
      });
      EXPECT_EQ (std::any_of (within.begin(), within.end(), holds), found);
      if (!found)
        EXPECT_EQ (within.size(), asked);
    }
  std::size_t asked = 0;
  EXPECT_TRUE (anyWithin (*tree, points.back().data(), 1e-3, [&asked] (std::int32_t) {
    ++asked;
    return true;
  }));
  EXPECT_EQ (1U, asked);
}

TEST (BallSearch, FindsNothingAmongNothing)
{
  const auto tree = treeOver ({}, 1);
  std::vector<std::int32_t> found{3};
  const float centre[] = {0.0F, 0.0F, 0.0F};
  findWithin (*tree, centre, 1.0, found);
  EXPECT_TRUE (found.empty());
}
