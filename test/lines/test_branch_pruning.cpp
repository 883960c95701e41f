// SPDX-License-Identifier: BSD-3-Clause
// The trees are small enough to be drawn on paper; points stand one unit apart.
#include <gtest/gtest.h>

#include "lines/branch_pruning.h"
#include "support/tree.h"

#include <set>

using namespace pcl::crest;
using oracle::Tree;

namespace {

std::set<index_t>
pruned (const Tree& tree, std::size_t largest)
{
  std::set<index_t> left;
  for (const CrestEdge& e : pruneBranches (tree.points(), tree.edges(), largest)) {
    left.insert (e.a);
    left.insert (e.b);
  }
  return left;
}

std::set<index_t>
range (int first, int last)
{
  std::set<index_t> all;
  for (int i = first; i <= last; ++i)
    all.insert (i);
  return all;
}

} // namespace

TEST (Pruning, LineWithoutJunctionIsNoBranch)
{
  Tree tree;
  tree.grow (-1, 4); // 0 - 1 - 2 - 3 - 4
  EXPECT_EQ (pruned (tree, 10), range (0, 4));
}

TEST (Pruning, RemovesBranchesUpToTheSizeOnly)
{
  // A trunk of 0 ... 40 with branches of 10 and of 11 points at 20.
  Tree tree;
  tree.grow (-1, 40);
  tree.grow (20, 10); // 41 ... 50
  tree.grow (20, 11); // 51 ... 61
  std::set<index_t> expected = range (0, 40);
  expected.merge (range (51, 61));
  EXPECT_EQ (pruned (tree, 10), expected);
}

TEST (Pruning, ShortestGoesFirst)
{
  // A star with arms of 3, 4 and 5: without the arm of 3 the rest is one line.
  Tree tree;
  tree.grow (-1, 3);
  tree.grow (0, 4); // 4 ... 7
  tree.grow (0, 5); // 8 ... 12
  std::set<index_t> expected = range (4, 12);
  expected.insert (0);
  EXPECT_EQ (pruned (tree, 10), expected);
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
  EXPECT_EQ (pruned (tree, 10), range (0, 30));
  // With a limit of 8 the branch of 9 stays, and one of the equal twigs with it.
  EXPECT_EQ (pruned (tree, 8).size(), 31U + 9U);
}

TEST (Pruning, OfEqualSizesTheOneOfSmallerLengthGoesFirst)
{
  Tree tree;
  tree.grow (-1, 4, 1.0F); // 1 ... 4
  tree.grow (0, 4, 0.5F);  // 5 ... 8
  tree.grow (0, 4, 2.0F);  // 9 ... 12
  std::set<index_t> expected = range (0, 4);
  expected.merge (range (9, 12));
  EXPECT_EQ (pruned (tree, 10), expected);
}

TEST (Pruning, SingleEdgesGoEvenWithoutALimit)
{
  Tree tree;
  tree.grow (-1, 10);
  tree.grow (5, 1); // 11
  tree.grow (7, 2); // 12, 13
  std::set<index_t> expected = range (0, 13);
  expected.erase (11);
  EXPECT_EQ (pruned (tree, 0), expected);
}

TEST (Pruning, SingleEdgesGoBeforeLongerBranches)
{
  // A comb: 0 - 1 - ... - 12 with a tooth of one point at each of 2 ... 10.
  Tree tree;
  tree.grow (-1, 12);
  for (int i = 2; i <= 10; ++i)
    tree.grow (i, 1);
  EXPECT_EQ (pruned (tree, 10), range (0, 12));
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

TEST (Pruning, OfEqualSizesAndLengthsTheLowerEndGoesFirst)
{
  // Arms of equal steps: 1 ... 3, 4 ... 6 and 7 ... 9, with ends 3, 6 and 9.
  const auto arm = [] (float x, float y) {
    return std::vector<Eigen::Vector3f>{
        {x, y, 0}, {2 * x, 2 * y, 0}, {3 * x, 3 * y, 0}};
  };
  std::vector<Eigen::Vector3f> positions{{0, 0, 0}};
  std::vector<CrestEdge> edges;
  for (const auto& points : {arm (1, 0), arm (0, 1), arm (-1, 0)}) {
    int from = 0;
    for (const Eigen::Vector3f& p : points) {
      const int next = static_cast<int> (positions.size());
      edges.push_back ({from, next, EdgeType::A, 1.0});
      positions.push_back (p);
      from = next;
    }
  }
  std::set<index_t> left;
  for (const CrestEdge& e : pruneBranches (oracle::pointsAt (positions), edges, 10))
    left.insert (e.b);
  EXPECT_EQ (left, range (4, 9));
}

TEST (Pruning, ABranchThatHasGrownIsMeasuredAgain)
{
  // At 20 of a trunk a stem of 2 points, then twigs of 3 and 4. Without the twig of 3
  // the other is a branch of 6, longer than the branch of 5 at 22, which has to go
  // first; with its old size of 4 it would go before. Then the trunk at 22 ends in the
  // stem.
  Tree tree;
  tree.grow (-1, 22);                 // 0 ... 22
  tree.grow (22, 5);                  // 23 ... 27
  const int fork = tree.grow (22, 2); // 28, 29
  tree.grow (fork, 3);                // 30 ... 32
  tree.grow (fork, 4);                // 33 ... 36
  std::set<index_t> expected = range (0, 22);
  expected.merge (range (28, 29));
  expected.merge (range (33, 36));
  EXPECT_EQ (pruned (tree, 10), expected);
}
