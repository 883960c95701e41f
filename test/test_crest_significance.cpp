// SPDX-License-Identifier: BSD-3-Clause
// Which branches points bear out; points stand one unit, one spacing apart.
#include <pcl_crest/crest_significance.h>

#include <gtest/gtest.h>

#include "support/stage_inputs.h"

#include <algorithm>

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
  std::vector<float> prominence;
  std::vector<CrestEdge> edges;

  Branch (int strong, int weak)
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
    prominence.assign (size, 1.0F);
    std::fill (prominence.begin() + strong, prominence.end(), 0.0F);
  }

  /** \brief The number of edges that remain. */
  [[nodiscard]] std::size_t
  significantEdges () const
  {
    const CrestEvidence evidence{graph, profiles, crest_points, prominence};
    const std::vector<float> limits (points.size(), 5.0F);
    return significantBranches (points, evidence, edges, limits, 25.0).size();
  }

  /** \brief The points of what remains, or 0. */
  [[nodiscard]] std::size_t
  significantPoints () const
  {
    const std::size_t kept = significantEdges();
    return kept == 0 ? 0 : kept + 1;
  }
};

} // namespace

TEST (SignificantBranches, StayWhereAllPointsBearThemOut)
{
  EXPECT_EQ (Branch (40, 0).significantPoints(), 40U);
}

TEST (SignificantBranches, GoWhereNoneDo)
{
  EXPECT_EQ (Branch (0, 40).significantPoints(), 0U);
}

// A twig that is pruned joins a line to what goes on beyond: that must not take the
// line with it. Relief: .48 * 40 / 44 = .433 does not fail, but .48 * 40 / 50 = .38
// does.
TEST (SignificantBranches, LoseAWeakEndAlone)
{
  EXPECT_EQ (Branch (40, 4).significantPoints(), 44U);
  const std::size_t left = Branch (40, 10).significantPoints();
  EXPECT_GE (left, 40U);
  EXPECT_LT (left, 50U);
}

TEST (SignificantBranches, GoWhereMuchIsWeak)
{
  EXPECT_EQ (Branch (20, 20).significantPoints(), 0U);
}

// Two crests along y and points between them that are grown.
TEST (SignificantBranches, AreNoRungs)
{
  const auto bridge = [] (const Eigen::Vector3f& across) {
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
    return chain.significantEdges();
  };
  EXPECT_EQ (bridge (Eigen::Vector3f::UnitX()), 38U);
  EXPECT_EQ (bridge (Eigen::Vector3f::UnitY()), 41U);
}
