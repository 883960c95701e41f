// SPDX-License-Identifier: BSD-3-Clause
// The trees are small enough to be drawn on paper; points stand one unit apart.
#include <pcl_crest/crest_lines.h>

#include <gtest/gtest.h>

#include "support/stage_inputs.h"

#include <set>

using namespace pcl::crest;

namespace {

/** \brief A tree that grows by paths; each point is one unit from the one before. */
class Tree {
public:
  /** \brief Appends a path of new points to a point (or starts with a new one), and
   * returns the last; `step` is the length of its edges.
   */
  int
  grow (int from, int points, float step = 1.0F)
  {
    if (from < 0) {
      positions_.emplace_back (0.0F, 0.0F, 0.0F);
      from = 0;
    }
    // Each path has a height of its own, so that no two points coincide.
    const float height = positions_[from].z() + 1e-3F * static_cast<float> (++paths_);
    for (int i = 0; i < points; ++i) {
      const int next = static_cast<int> (positions_.size());
      const Eigen::Vector3f& p = positions_[from];
      positions_.emplace_back (p.x() + step, p.y(), height);
      edges_.push_back ({from, next, EdgeType::A, step * step});
      from = next;
    }
    return from;
  }

  OrientedPoints
  points () const
  {
    return oracle::pointsAt (positions_);
  }
  const std::vector<CrestEdge>&
  edges () const
  {
    return edges_;
  }

  std::set<pcl::index_t>
  pruned (std::size_t largest) const
  {
    std::set<pcl::index_t> left;
    for (const CrestEdge& e : pruneBranches (points(), edges_, largest)) {
      left.insert (e.a);
      left.insert (e.b);
    }
    return left;
  }

private:
  std::vector<Eigen::Vector3f> positions_;
  std::vector<CrestEdge> edges_;
  int paths_ = 0;
};

std::set<pcl::index_t>
range (int first, int last)
{
  std::set<pcl::index_t> all;
  for (int i = first; i <= last; ++i)
    all.insert (i);
  return all;
}

/** \brief The lines of a tree in a crest graph that has more edges than it, and more
 * points, all of them members.
 */
std::vector<CrestLine>
trace (const Tree& tree,
       const std::vector<std::pair<int, int>>& more_edges = {},
       std::size_t more_points = 0)
{
  std::vector<std::pair<int, int>> edges = more_edges;
  for (const CrestEdge& e : tree.edges())
    edges.emplace_back (e.a, e.b);
  OrientedPoints points = tree.points();
  points.positions.resize (points.size() + more_points, Eigen::Vector3f::Zero());
  const std::vector<Membership> members (points.size(), Membership::CREST);
  return traceLines (points,
                     oracle::graphOf (points.size(), edges),
                     members,
                     tree.edges(),
                     CrestType::RIDGE,
                     10);
}

} // namespace

TEST (Pruning, LineWithoutJunctionIsNoBranch)
{
  Tree tree;
  tree.grow (-1, 4); // 0 - 1 - 2 - 3 - 4
  EXPECT_EQ (tree.pruned (10), range (0, 4));
}

TEST (Pruning, RemovesBranchesUpToTheSizeOnly)
{
  // A trunk of 0 ... 40 with branches of 10 and of 11 points at 20.
  Tree tree;
  tree.grow (-1, 40);
  tree.grow (20, 10); // 41 ... 50
  tree.grow (20, 11); // 51 ... 61
  std::set<pcl::index_t> expected = range (0, 40);
  expected.merge (range (51, 61));
  EXPECT_EQ (tree.pruned (10), expected);
}

TEST (Pruning, ShortestGoesFirst)
{
  // A star with arms of 3, 4 and 5: without the arm of 3 the rest is one line.
  Tree tree;
  tree.grow (-1, 3);
  tree.grow (0, 4); // 4 ... 7
  tree.grow (0, 5); // 8 ... 12
  std::set<pcl::index_t> expected = range (4, 12);
  expected.insert (0);
  EXPECT_EQ (tree.pruned (10), expected);
}

TEST (Pruning, GoesOnUntilNothingChanges)
{
  // 0 ... 30, and at 15 a twig of 6 points that forks into two of 3: first one of the
  // two goes, then the rest is a branch of 9.
  Tree tree;
  tree.grow (-1, 30);
  const int fork = tree.grow (15, 6);
  tree.grow (fork, 3);
  tree.grow (fork, 3);
  EXPECT_EQ (tree.pruned (10), range (0, 30));
  // With a limit of 8 the branch of 9 stays, and one of the equal twigs with it.
  EXPECT_EQ (tree.pruned (8).size(), 31U + 9U);
}

TEST (Pruning, OfEqualSizesTheOneOfSmallerLengthGoesFirst)
{
  Tree tree;
  tree.grow (-1, 4, 1.0F); // 1 ... 4
  tree.grow (0, 4, 0.5F);  // 5 ... 8
  tree.grow (0, 4, 2.0F);  // 9 ... 12
  std::set<pcl::index_t> expected = range (0, 4);
  expected.merge (range (9, 12));
  EXPECT_EQ (tree.pruned (10), expected);
}

TEST (Pruning, SingleEdgesGoEvenWithoutALimit)
{
  Tree tree;
  tree.grow (-1, 10);
  tree.grow (5, 1); // 11
  tree.grow (7, 2); // 12, 13
  std::set<pcl::index_t> expected = range (0, 13);
  expected.erase (11);
  EXPECT_EQ (tree.pruned (0), expected);
}

TEST (Pruning, SingleEdgesGoBeforeLongerBranches)
{
  // A comb: 0 - 1 - ... - 12 with a tooth of one point at each of 2 ... 10.
  Tree tree;
  tree.grow (-1, 12);
  for (int i = 2; i <= 10; ++i)
    tree.grow (i, 1);
  EXPECT_EQ (tree.pruned (10), range (0, 12));
}

TEST (Pruning, EveryTreeOfTheForestIsItsOwn)
{
  const OrientedPoints points = oracle::pointsAt (
      {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 5, 0}, {1, 5, 0}, {2, 5, 0}, {1, 6, 0}});
  const std::vector<CrestEdge> edges{{0, 1, EdgeType::A, 1.0},
                                     {1, 2, EdgeType::A, 1.0},
                                     {3, 4, EdgeType::A, 1.0},
                                     {4, 5, EdgeType::A, 1.0},
                                     {4, 6, EdgeType::A, 1.0}};
  const std::vector<CrestEdge> left = pruneBranches (points, edges, 10);
  ASSERT_EQ (left.size(), 4U); // of the three single edges at 4 two stay, as a line
  EXPECT_EQ (left[0].b, 1);
  EXPECT_EQ (left[1].b, 2);
}

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
  EXPECT_EQ (lines[0].polylines,
             (std::vector<std::vector<pcl::index_t>>{{0, 1, 2, 3, 4}}));
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
  const std::set<std::vector<pcl::index_t>> polylines (lines[0].polylines.begin(),
                                                       lines[0].polylines.end());
  EXPECT_EQ (polylines,
             (std::set<std::vector<pcl::index_t>>{{0, 1, 2}, {2, 3, 4}, {2, 5}}));
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
             (std::vector<std::vector<pcl::index_t>>{
                 {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 13, 12, 0}}));
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
  EXPECT_EQ (removeSmallLines (lines, 10).size(), 4U);
  EXPECT_EQ (removeSmallLines (lines, 11).size(), 3U);
  EXPECT_EQ (removeSmallLines (lines, 0).size(), 5U);
}
