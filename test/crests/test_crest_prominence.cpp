// SPDX-License-Identifier: BSD-3-Clause
// How far curvature falls beside a crest, on a row of points across it, one unit apart.
#include <gtest/gtest.h>

#include "crests/crest_prominence.h"
#include "support/stage_inputs.h"

#include <cmath>
#include <functional>
#include <utility>
#include <vector>

using namespace pcl::crest;

namespace {

/** \brief A row along x of points of some curvatures. */
struct Row {
  OrientedPoints points;
  SurfaceGraph graph;
  std::vector<CrestProfile> profiles;

  explicit Row (const std::vector<float>& curvatures)
  {
    const auto size = static_cast<int> (curvatures.size());
    std::vector<Eigen::Vector3f> positions;
    std::vector<std::pair<int, int>> pairs;
    for (int i = 0; i < size; ++i) {
      positions.emplace_back (static_cast<float> (i), 0.0F, 0.0F);
      if (i > 0)
        pairs.emplace_back (i - 1, i);
      CrestProfile profile;
      profile.curvature = {curvatures[i], 0.0F, Eigen::Vector3f::UnitX(), true};
      profile.normal = Eigen::Vector3f::UnitZ();
      profile.radius = 2.7F;
      profiles.push_back (profile);
    }
    points = oracle::pointsAt (positions);
    graph = oracle::graphOf (static_cast<std::size_t> (size), pairs);
  }

  /** \brief The prominence of one of the points. */
  [[nodiscard]] float
  at (int crest) const
  {
    return whole (crest).fall;
  }

  [[nodiscard]] Prominence
  whole (int crest) const
  {
    std::vector<CrestType> crest_points (points.size(), CrestType::NONE);
    crest_points[crest] =
        profiles[crest].curvature.k1 > 0.0F ? CrestType::RIDGE : CrestType::VALLEY;
    std::vector<Prominence> prominence =
        measureProminence (points, graph, profiles, crest_points, Workers (1));
    const Prominence of_crest = std::exchange (prominence[crest], Prominence());
    for (const Prominence& of_other : prominence)
      EXPECT_EQ (of_other.fall, 0.0F);
    return of_crest;
  }
};

} // namespace

TEST (CrestProminence, IsThePartThatCurvatureFallsByOnTheLowerSideOfTheTwo)
{
  // To .1 and up again on the left, to .16 and up again on the right.
  const Row row ({.3F, .1F, .15F, .2F, .18F, .16F, .17F, .4F});
  EXPECT_FLOAT_EQ (row.at (3), 1.0F - .16F / .2F);
}

namespace {

/** \brief |k1| at 21 points one spacing apart, the crest in their middle. */
Row
rowOf (const std::function<double (double)>& k1)
{
  std::vector<float> curvatures;
  for (int x = -10; x <= 10; ++x)
    curvatures.push_back (static_cast<float> (k1 (x)));
  return Row (curvatures);
}

} // namespace

TEST (CrestProminence, TellsABlendByItsShoulders)
{
  const auto shoulders = [] (const std::function<double (double)>& k1) {
    return rowOf (k1).whole (10).shoulders;
  };
  // Half is at 7; the mean over a window about 3.5 is a little more than that there.
  EXPECT_NEAR (
      shoulders ([] (double x) { return 0.1 * (1.0 - 0.5 * x * x / 49.0 * 1.02); }),
      0.125,
      0.04);
  EXPECT_NEAR (
      shoulders ([] (double x) { return std::abs (x) < 6.5 ? 0.1 : 0.01; }), 0.0, 1e-6);
  // As wide as two edges that are near to each other.
  EXPECT_FALSE (std::isfinite (
      shoulders ([] (double x) { return std::abs (x) < 3.5 ? 0.1 : 0.01; })));
  Row noisy = rowOf ([] (double x) { return std::abs (x) < 6.5 ? 0.1 : 0.01; });
  for (CrestProfile& profile : noisy.profiles)
    profile.noise = 0.5F;
  EXPECT_FALSE (std::isfinite (noisy.whole (10).shoulders));
}

TEST (CrestProminence, IsTheSameForAValley)
{
  const Row row ({-.3F, -.1F, -.15F, -.2F, -.18F, -.16F, -.17F, -.4F});
  EXPECT_FLOAT_EQ (row.at (3), 1.0F - .16F / .2F);
}

TEST (CrestProminence, IsWholeWhereNothingIsLeftOfTheCrestsSign)
{
  // The other curvature, which counts where it is the larger for this sign, is zero.
  const Row row ({-.1F, .05F, .2F, .05F, -.06F});
  EXPECT_EQ (row.at (2), 1.0F);
}

TEST (CrestProminence, IsThatOfTheOtherFlankWhereDataEndOnOne)
{
  const Row row ({.19F, .2F, .15F, .1F, .05F, .3F});
  EXPECT_FLOAT_EQ (row.at (1), 1.0F - .05F / .2F);
}

TEST (CrestProminence, IsNothingOnASlope)
{
  const Row row ({.3F, .25F, .2F, .1F, .0F, .2F});
  // Of a quarter, .25 is not yet the next crest; .3 is.
  EXPECT_FLOAT_EQ (row.at (2), 0.0F);
}

TEST (CrestProminence, IsWholeOnASharpEdge)
{
  Row row ({.3F, .3F, .3F});
  row.profiles[1].sharp = true;
  EXPECT_EQ (row.at (1), 1.0F);
}

TEST (CrestProminence, OfAWideFitIsNothingWhereDataEndBesideIt)
{
  // Over more than a radian, once far from where data end and once beside.
  std::vector<float> curvatures (21, .05F);
  curvatures[2] = curvatures[10] = .4F;
  const Row row (curvatures);
  EXPECT_FLOAT_EQ (row.at (10), 1.0F - .05F / .4F);
  EXPECT_EQ (row.at (2), 0.0F);
}

TEST (CrestProminence, OfTheCoarsestLevelIsAllOrNothing)
{
  std::vector<float> curvatures (21, .05F);
  Row row (curvatures);
  for (CrestProfile& profile : row.profiles)
    profile.coarsest_level = true;
  EXPECT_EQ (row.at (10), 1.0F);
  EXPECT_EQ (row.at (2), 0.0F);
}
