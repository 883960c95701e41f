// SPDX-License-Identifier: BSD-3-Clause
// How far curvature falls beside a crest, on a row of points across it, one unit apart.
#include <gtest/gtest.h>

#include "crests/crest_prominence.h"
#include "support/stage_inputs.h"

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
    std::vector<CrestType> crest_points (points.size(), CrestType::NONE);
    crest_points[crest] =
        profiles[crest].curvature.k1 > 0.0F ? CrestType::RIDGE : CrestType::VALLEY;
    std::vector<float> prominence =
        measureProminence (points, graph, profiles, crest_points, Workers (1));
    const float of_crest = std::exchange (prominence[crest], 0.0F);
    EXPECT_EQ (prominence, std::vector<float> (points.size(), 0.0F));
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
