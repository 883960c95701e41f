// SPDX-License-Identifier: BSD-3-Clause
// The trees are small enough to be drawn on paper; points stand one unit apart.
#include <gtest/gtest.h>

#include "lines/crest_lines.h"
#include "support/tree.h"

#include <algorithm>
#include <set>

using namespace pcl::crest;
using oracle::Tree;

namespace {

/** \brief The lines of a tree in a crest graph that has more edges than it, and more
 * points, all of them members.
 */
std::vector<CrestLine>
trace (const Tree& tree,
       const std::vector<std::pair<int, int>>& more_edges = {},
       std::size_t more_points = 0,
       Membership more_members = Membership::CREST,
       std::size_t largest_branch = 10)
{
  std::vector<std::pair<int, int>> edges = more_edges;
  for (const CrestEdge& e : tree.edges())
    edges.emplace_back (e.a, e.b);
  OrientedPoints points = tree.points();
  points.positions.resize (points.size() + more_points, Eigen::Vector3f::Zero());
  std::vector<Membership> members (points.size(), Membership::CREST);
  std::fill (members.end() - static_cast<std::ptrdiff_t> (more_points),
             members.end(),
             more_members);
  return traceLines (points,
                     oracle::graphOf (points.size(), edges),
                     members,
                     tree.edges(),
                     CrestType::RIDGE,
                     largest_branch);
}

} // namespace

TEST (Lines, WithoutJunctionIsOnePolylineFromEndToEnd)
{
  Tree tree;
  tree.grow (-1, 4, 0.5F);
  const std::vector<CrestLine> lines = trace (tree);
  ASSERT_EQ (lines.size(), 1U);
  EXPECT_EQ (lines[0].type, CrestType::RIDGE);
  EXPECT_EQ (lines[0].size, 5U);
  EXPECT_NEAR (lines[0].length, 2.0, 1e-5);
  EXPECT_FALSE (lines[0].closed);
  EXPECT_EQ (lines[0].polylines, (std::vector<std::vector<index_t>>{{0, 1, 2, 3, 4}}));
}

TEST (Lines, BranchesShareTheirJunction)
{
  Tree tree;
  tree.grow (-1, 2); // 0 - 1 - 2
  tree.grow (2, 2);  // 3, 4
  tree.grow (2, 1);  // 5
  const std::vector<CrestLine> lines = trace (tree);
  ASSERT_EQ (lines.size(), 1U);
  EXPECT_EQ (lines[0].size, 6U);
  EXPECT_NEAR (lines[0].length, 5.0, 1e-5);
  const std::set<std::vector<index_t>> polylines (lines[0].polylines.begin(),
                                                  lines[0].polylines.end());
  EXPECT_EQ (polylines, (std::set<std::vector<index_t>>{{0, 1, 2}, {2, 3, 4}, {2, 5}}));
}

TEST (Lines, LoopCutByTheTreeIsClosedAgain)
{
  Tree tree;
  tree.grow (-1, 11); // 12 points
  const std::vector<CrestLine> closed = trace (tree, {{0, 11}});
  ASSERT_EQ (closed.size(), 1U);
  EXPECT_TRUE (closed[0].closed);
  EXPECT_EQ (closed[0].size, 12U);
  EXPECT_EQ (closed[0].polylines[0].size(), 13U);
  EXPECT_EQ (closed[0].polylines[0].front(), closed[0].polylines[0].back());
  EXPECT_NEAR (closed[0].length, 22.0, 1e-3); // 11 edges of 1 and one of 11
}

TEST (Lines, LoopIsClosedThroughPrunedPoints)
{
  Tree tree;
  tree.grow (-1, 11);
  const std::vector<CrestLine> closed = trace (tree, {{0, 12}, {12, 13}, {13, 11}}, 2);
  ASSERT_EQ (closed.size(), 1U);
  EXPECT_TRUE (closed[0].closed);
  EXPECT_EQ (closed[0].size, 14U);
  EXPECT_EQ (closed[0].polylines,
             (std::vector<std::vector<index_t>>{
                 {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 13, 12, 0}}));
}

TEST (Lines, NoLoopThroughPointsOutsideTheCrestGraph)
{
  Tree tree;
  tree.grow (-1, 11);
  const std::vector<CrestLine> lines =
      trace (tree, {{0, 12}, {12, 13}, {13, 11}}, 2, Membership::OUTSIDE);
  EXPECT_FALSE (lines.at (0).closed);
}

TEST (Lines, NoLoopOverMorePointsThanABranchMayHave)
{
  Tree tree;
  tree.grow (-1, 39);
  const std::vector<std::pair<int, int>> way{{0, 40}, {40, 41}, {41, 42}, {42, 39}};
  EXPECT_FALSE (trace (tree, way, 3, Membership::CREST, 2).at (0).closed);
  EXPECT_TRUE (trace (tree, way, 3, Membership::CREST, 3).at (0).closed);
}

TEST (Lines, AWayBackBesideTheLineMakesNoLoop)
{
  // Twelve points, and four more that lead back: more than a quarter.
  Tree tree;
  tree.grow (-1, 11);
  const std::vector<CrestLine> lines =
      trace (tree, {{0, 12}, {12, 13}, {13, 14}, {14, 15}, {15, 11}}, 4);
  ASSERT_EQ (lines.size(), 1U);
  EXPECT_FALSE (lines[0].closed);
  EXPECT_EQ (lines[0].size, 12U);
}

TEST (Lines, NoLoopOfTheSizeOfABranch)
{
  Tree tree;
  tree.grow (-1, 9); // 10 points: a branch of this size would be pruned
  const std::vector<CrestLine> lines = trace (tree, {{0, 9}});
  ASSERT_EQ (lines.size(), 1U);
  EXPECT_FALSE (lines[0].closed);
  EXPECT_EQ (lines[0].polylines[0].size(), 10U);
}

TEST (Lines, SizesAreCountedAndSmallLinesRemoved)
{
  std::vector<CrestLine> lines (5);
  const std::size_t sizes[] = {30, 12, 12, 10, 9};
  for (std::size_t i = 0; i < 5; ++i)
    lines[i].size = sizes[i];
  EXPECT_EQ (lineSizes (lines), (LineSizes{{9, 1}, {10, 1}, {12, 2}, {30, 1}}));
  const auto small = [&] (int min_size) {
    return std::count_if (lines.begin(), lines.end(), [&] (const CrestLine& line) {
      return isSmall (line, {min_size, min_size});
    });
  };
  EXPECT_EQ (small (10), 1);
  EXPECT_EQ (small (11), 2);
  EXPECT_EQ (small (0), 0);
}
