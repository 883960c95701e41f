// SPDX-License-Identifier: BSD-3-Clause
// Which branches points bear out; points stand one unit, one spacing apart.
#include <gtest/gtest.h>

#include "lines/crest_significance.h"
#include "support/stage_inputs.h"

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

using namespace pcl::crest;

namespace {

/** \brief A branch of some points that are significant and others, at its end, that do
 * not stand out at all.
 */
struct Branch {
  OrientedPoints points;
  SurfaceGraph graph;
  std::vector<CrestProfile> profiles;
  std::vector<CrestType> crest_points;
  std::vector<Prominence> prominence;
  std::vector<CrestEdge> edges;

  /** \param[in] weak_first whether the others come first */
  Branch (int strong, int weak, bool weak_first = false)
  {
    // 41 degrees and, where fully prominent, a relief of 1 / (k1 q) = .48 spacings.
    CrestProfile profile;
    profile.curvature = {0.3F, 0.0F, Eigen::Vector3f::UnitY(), true};
    profile.sharpness = 7.0F;
    const int size = strong + weak;
    std::vector<Eigen::Vector3f> positions;
    std::vector<std::pair<int, int>> pairs;
    for (int i = 0; i < size; ++i) {
      positions.emplace_back (static_cast<float> (i), 0.0F, 0.0F);
      if (i > 0) {
        pairs.emplace_back (i - 1, i);
        edges.push_back ({i - 1, i, EdgeType::A, 1.0});
      }
    }
    points = oracle::pointsAt (positions);
    graph = oracle::graphOf (size, pairs);
    graph.spacing.assign (size, 1.0F);
    profiles.assign (size, profile);
    crest_points.assign (size, CrestType::RIDGE);
    prominence.assign (size, {1.0F});
    std::fill (prominence.begin() + strong, prominence.end(), Prominence());
    if (weak_first)
      std::reverse (prominence.begin(), prominence.end());
  }

  /** \brief The edges that remain.
   * \param[in] limit the greatest length of a branch to prune
   */
  [[nodiscard]] std::vector<CrestEdge>
  significantEdges (double angle = 25.0, float limit = 5.0F) const
  {
    const CrestEvidence evidence{graph, profiles, crest_points, prominence};
    const std::vector<float> limits (points.size(), limit);
    return significantBranches (points, evidence, edges, limits, angle);
  }

  /** \brief The points of what remains, ascending. */
  [[nodiscard]] std::set<index_t>
  significantPoints (double angle = 25.0) const
  {
    std::set<index_t> left;
    for (const CrestEdge& edge : significantEdges (angle))
      left.insert ({edge.a, edge.b});
    return left;
  }
};

} // namespace

TEST (SignificantBranches, StayWhereAllPointsBearThemOut)
{
  EXPECT_EQ (Branch (40, 0).significantPoints().size(), 40U);
}

TEST (SignificantBranches, GoWhereNoneDo)
{
  EXPECT_TRUE (Branch (0, 40).significantPoints().empty());
}

// A twig that is pruned joins a line to what goes on beyond: that must not take the
// line with it. Mean relief: .476 * 40 / 44 = .433 is enough, .476 * 40 / 50 = .381 is
// not, and .476 * 40 / .4 = 47.6 points are the most that have enough.
TEST (SignificantBranches, LoseAWeakEndAlone)
{
  EXPECT_EQ (Branch (40, 4).significantPoints().size(), 44U);
  const std::set<index_t> without_end = Branch (40, 10).significantPoints();
  EXPECT_EQ (without_end.size(), 47U);
  EXPECT_EQ (*without_end.begin(), 0);
  const std::set<index_t> without_start = Branch (40, 10, true).significantPoints();
  EXPECT_EQ (without_start.size(), 47U);
  EXPECT_EQ (*without_start.begin(), 3);
}

// Where a loop begins means nothing: it stays or goes as a whole.
TEST (SignificantBranches, AreLoopsAsAWhole)
{
  for (const bool weak_first : {false, true}) {
    Branch loop (40, 10, weak_first);
    loop.edges.push_back ({0, 49, EdgeType::A, 1.0});
    EXPECT_TRUE (loop.significantPoints().empty());
  }
  Branch loop (40, 4);
  loop.edges.push_back ({0, 43, EdgeType::A, 1.0});
  EXPECT_EQ (loop.significantEdges().size(), 44U);
}

// A relief of .6 * .6 * .476 = .17, and a turn of 41 degrees * .6^1.5 = 19.
TEST (SignificantBranches, MayBeLowerForASmallerAngle)
{
  Branch ripple (40, 0);
  std::fill (ripple.prominence.begin(), ripple.prominence.end(), Prominence{0.6F});
  EXPECT_TRUE (ripple.significantPoints (20.0).empty());
  EXPECT_EQ (ripple.significantPoints (10.0).size(), 40U);
}

// A parabola has fallen by an eighth halfway to one half.
TEST (SignificantBranches, GoWhereCurvatureIsThatOfABlend)
{
  for (const float shoulders : {0.03F, 0.125F}) {
    Branch branch (40, 0);
    for (std::size_t i = 0; i < 20; ++i)
      branch.prominence[2 * i].shoulders = shoulders;
    EXPECT_EQ (branch.significantPoints().size(), shoulders < 0.1F ? 0U : 40U);
  }
  // What two points say of forty is chance.
  Branch branch (40, 0);
  branch.prominence[3].shoulders = branch.prominence[4].shoulders = 0.0F;
  EXPECT_EQ (branch.significantPoints().size(), 40U);
}

TEST (SignificantBranches, GoWhereMuchIsWeak)
{
  EXPECT_TRUE (Branch (20, 20).significantPoints().empty());
}

// Two crests along y and points between them that are grown.
TEST (SignificantBranches, AreNoRungs)
{
  const auto bridge = [] (const Eigen::Vector3f& across, float limit) {
    std::vector<Eigen::Vector3f> positions;
    const auto line = [&] (float x) {
      for (int i = 0; i < 20; ++i)
        positions.emplace_back (x, static_cast<float> (i), 0.0F);
    };
    line (0.0F);
    line (3.0F);
    positions.emplace_back (1.0F, 10.0F, 0.0F);
    positions.emplace_back (2.0F, 10.0F, 0.0F);
    Branch chain (static_cast<int> (positions.size()), 0);
    for (CrestProfile& profile : chain.profiles)
      profile.curvature.t1 = across;
    chain.points = oracle::pointsAt (positions);
    chain.crest_points[40] = chain.crest_points[41] = CrestType::NONE;
    chain.edges = {{10, 40, EdgeType::A, 1.0},
                   {40, 41, EdgeType::A, 1.0},
                   {30, 41, EdgeType::A, 1.0}};
    for (int i = 1; i < 20; ++i)
      for (const int first : {0, 20})
        chain.edges.push_back ({first + i - 1, first + i, EdgeType::A, 1.0});
    return chain.significantEdges (25.0, limit).size();
  };
  EXPECT_EQ (bridge (Eigen::Vector3f::UnitX(), 5.0F), 38U);
  EXPECT_EQ (bridge (Eigen::Vector3f::UnitY(), 5.0F), 41U);
  // Three units long.
  EXPECT_EQ (bridge (Eigen::Vector3f::UnitX(), 2.0F), 41U);
}
