// SPDX-License-Identifier: BSD-3-Clause
// Loops and the pruning of branches by length; points stand one unit apart.
#include <gtest/gtest.h>

#include "lines/branch_pruning.h"
#include "lines/crest_lines.h"
#include "lines/crest_loops.h"
#include "support/stage_inputs.h"
#include "support/tree.h"

#include <cmath>

using namespace pcl::crest;

namespace {

/** \brief Points on a circle, one unit apart, and the edges between neighbours. */
struct Ring {
  OrientedPoints points;
  std::vector<CrestEdge> edges;

  explicit Ring (int size)
  {
    std::vector<Eigen::Vector3f> positions;
    const double radius = 0.5 / std::sin (M_PI / size);
    for (int i = 0; i < size; ++i) {
      const double angle = 2.0 * M_PI * i / size;
      positions.emplace_back (radius * std::cos (angle), radius * std::sin (angle), 0);
      const int next = (i + 1) % size;
      edges.push_back ({std::min (i, next), std::max (i, next), EdgeType::A, 1.0});
    }
    points = oracle::pointsAt (positions);
  }

  std::vector<CrestEdge>
  closed (float limit) const
  {
    const std::vector<float> limits (points.size(), limit);
    return closeLoops (
        points, edges, limits, minimumSpanningForest (points.size(), edges));
  }
};

} // namespace

TEST (Loops, LongerThanTheLimitAreClosed)
{
  const Ring ring (30);
  const std::vector<CrestEdge> edges = ring.closed (20.0F);
  EXPECT_EQ (edges.size(), 30U);
  const std::vector<CrestLine> lines =
      traceLines (ring.points, edges, CrestType::RIDGE);
  ASSERT_EQ (lines.size(), 1U);
  EXPECT_TRUE (lines[0].closed);
  EXPECT_EQ (lines[0].size, 30U);
  EXPECT_NEAR (lines[0].length, 30.0, 1e-4);
  ASSERT_EQ (lines[0].polylines.size(), 1U);
  EXPECT_EQ (lines[0].polylines[0].size(), 31U);
  EXPECT_EQ (lines[0].polylines[0].front(), lines[0].polylines[0].back());
}

TEST (Loops, ShorterThanTheLimitStayCut)
{
  const Ring ring (30);
  const std::vector<CrestEdge> edges = ring.closed (40.0F);
  EXPECT_EQ (edges.size(), 29U);
  EXPECT_FALSE (traceLines (ring.points, edges, CrestType::RIDGE)[0].closed);
}

TEST (Loops, WithATailHaveAJunctionAndAreNotClosed)
{
  Ring ring (30);
  ring.points.positions.push_back (1.2F * ring.points.positions[0]);
  ring.edges.push_back ({0, 30, EdgeType::A, 1.0});
  const std::vector<CrestLine> lines =
      traceLines (ring.points, ring.edges, CrestType::RIDGE);
  ASSERT_EQ (lines.size(), 1U);
  EXPECT_FALSE (lines[0].closed);
  EXPECT_EQ (lines[0].polylines.size(), 2U);
  EXPECT_EQ (lines[0].size, 31U);
}

TEST (Loops, SurviveTheirTails)
{
  Ring ring (30);
  ring.points.positions.push_back (1.2F * ring.points.positions[0]);
  ring.edges.push_back ({0, 30, EdgeType::A, 1.0});
  const std::vector<CrestEdge> left =
      pruneShortBranches (ring.points, ring.edges, std::vector<float> (31, 2.0F));
  EXPECT_EQ (left.size(), 30U);
  EXPECT_TRUE (traceLines (ring.points, left, CrestType::RIDGE)[0].closed);
}

TEST (ShortBranches, ArePrunedByLengthAndNotByPoints)
{
  oracle::Tree tree;
  const int junction = tree.grow (-1, 10);
  tree.grow (junction, 10);
  tree.grow (junction, 1, 4.0F); // one long edge
  tree.grow (junction, 6, 0.5F); // three units in six points
  const std::vector<float> limits (tree.points().size(), 3.5F);
  EXPECT_EQ (pruneShortBranches (tree.points(), tree.edges(), limits).size(), 21U);
}

TEST (ShortBranches, OfALineWithoutJunctionStay)
{
  oracle::Tree tree;
  tree.grow (-1, 3);
  const std::vector<float> limits (tree.points().size(), 100.0F);
  EXPECT_EQ (pruneShortBranches (tree.points(), tree.edges(), limits).size(), 3U);
}
