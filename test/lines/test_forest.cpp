// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "lines/forest.h"

#include <random>
#include <set>

using namespace pcl::crest;

namespace {

using Neighbors = std::vector<std::set<int>>;

void
expectSame (const Forest& forest, const Neighbors& expected)
{
  for (int v = 0; v < forest.size(); ++v) {
    const Forest::Neighbors found = forest.neighbors (v);
    EXPECT_EQ (std::vector<int> (found.begin(), found.end()),
               std::vector<int> (expected[v].begin(), expected[v].end()))
        << v;
    EXPECT_EQ (forest.degree (v), expected[v].size());
  }
}

} // namespace

TEST (Forest, KnowsItsNeighboursWhileEdgesComeAndGo)
{
  // Against sets. Of 40 points 30 have edges at first, so that local numbers differ.
  std::mt19937 random (1);
  std::uniform_int_distribution<index_t> any (0, 29);
  std::set<std::pair<index_t, index_t>> known;
  std::vector<CrestEdge> edges;
  for (index_t p = 0; p < 30; ++p) {
    const index_t q = (p + 1) % 30;
    known.emplace (std::min (p, q), std::max (p, q));
    edges.push_back ({p + 10, q + 10, EdgeType::A, 1.0F});
  }
  Forest forest (edges);
  ASSERT_EQ (forest.size(), 30);
  Neighbors expected (30);
  for (const auto& [p, q] : known) {
    expected[p].insert (q);
    expected[q].insert (p);
  }
  expectSame (forest, expected);
  for (int step = 0; step < 300; ++step) {
    const index_t p = any (random);
    const index_t q = any (random);
    if (p == q)
      continue;
    if (expected[p].count (q) == 0) {
      forest.addEdge (p + 10, q + 10);
      expected[p].insert (q);
      expected[q].insert (p);
    }
    else {
      forest.removeEdge (p, q);
      expected[p].erase (q);
      expected[q].erase (p);
    }
    expectSame (forest, expected);
  }
  EXPECT_EQ (forest.packed (0), 10);
  EXPECT_EQ (forest.local (39), 29);
}

TEST (Forest, LeavesOfItsEdgesThoseNotRemoved)
{
  const std::vector<CrestEdge> edges{
      {3, 5, EdgeType::A, 1.0F}, {5, 8, EdgeType::B, 2.0F}, {5, 9, EdgeType::C, 3.0F}};
  Forest forest (edges);
  forest.removeEdge (forest.local (5), forest.local (8));
  const std::vector<CrestEdge> left = forest.remaining (edges);
  ASSERT_EQ (left.size(), 2U);
  EXPECT_EQ (left[0].b, 5);
  EXPECT_EQ (left[1].b, 9);
}
