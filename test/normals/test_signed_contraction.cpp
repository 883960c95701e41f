// SPDX-License-Identifier: BSD-3-Clause
// Signs by votes, against planted ones and against all that there are.
#include <gtest/gtest.h>

#include "normals/signed_contraction.h"

#include <cmath>
#include <random>

using namespace pcl::crest;

namespace {

struct Vote {
  index_t a, b;
  float weight;
};

/** \brief What of the votes the signs of a graph satisfy. */
double
satisfied (SignedContraction& graph, const std::vector<Vote>& votes)
{
  double sum = 0.0;
  for (const Vote& vote : votes) {
    const bool opposite = graph.find (vote.a).turned != graph.find (vote.b).turned;
    sum += opposite ? -vote.weight : vote.weight;
  }
  return sum;
}

TEST (SignedContraction, FindsPlantedSignsThroughNoise)
{
  // A lattice whose votes are wrong in a fifth of all cases.
  constexpr int SIDE = 30;
  constexpr std::size_t ALL = 900;
  std::mt19937 random (5);
  std::bernoulli_distribution wrong (0.2);
  std::bernoulli_distribution coin (0.5);
  std::vector<bool> planted;
  for (int i = 0; i < SIDE * SIDE; ++i)
    planted.push_back (coin (random));
  SignedContraction graph (std::vector<std::size_t> (ALL, 1));
  const auto vote = [&] (int a, int b) {
    const float weight = planted[a] == planted[b] ? 1.0F : -1.0F;
    graph.vote (a, b, wrong (random) ? -weight : weight);
  };
  for (int i = 0; i < SIDE; ++i)
    for (int j = 0; j < SIDE; ++j)
      for (const auto& [di, dj] :
           {std::pair (0, 1), {1, 0}, {1, 1}, {1, -1}, {0, 2}, {2, 0}})
        if (i + di < SIDE && j + dj >= 0 && j + dj < SIDE)
          vote (i * SIDE + j, (i + di) * SIDE + j + dj);
  graph.contract (0.0F, 0.0F, ALL);
  int same = 0;
  for (int i = 0; i < SIDE * SIDE; ++i) {
    EXPECT_EQ (graph.find (i).root, graph.find (0).root);
    same +=
        (graph.find (i).turned == graph.find (0).turned) == (planted[i] == planted[0]);
  }
  EXPECT_GE (std::max (same, SIDE * SIDE - same), 0.97 * SIDE * SIDE);
}

TEST (SignedContraction, IsNearlyAsGoodAsTryingAllSigns)
{
  constexpr int NODES = 12;
  std::mt19937 random (2);
  std::normal_distribution<float> weight (0.0F, 1.0F);
  for (int run = 0; run < 20; ++run) {
    std::vector<Vote> votes;
    for (index_t a = 0; a < NODES; ++a)
      for (index_t b = a + 1; b < NODES; ++b)
        if (random() % 2 == 0)
          votes.push_back ({a, b, weight (random)});
    double best = 0.0;
    for (unsigned signs = 0; signs < 1U << NODES; ++signs) {
      double sum = 0.0;
      for (const Vote& vote : votes)
        sum += ((signs >> vote.a ^ signs >> vote.b) & 1U) != 0 ? -vote.weight
                                                               : vote.weight;
      best = std::max (best, sum);
    }
    SignedContraction graph (std::vector<std::size_t> (NODES, 1));
    for (const Vote& vote : votes)
      graph.vote (vote.a, vote.b, vote.weight);
    graph.contract (0.0F, 0.0F, NODES);
    EXPECT_GE (satisfied (graph, votes), 0.75 * best) << run;
  }
}

TEST (SignedContraction, AWholeBorderWinsOverItsBestEdge)
{
  // Two clusters of three, one sure edge against many less sure ones.
  SignedContraction graph (std::vector<std::size_t> (6, 1));
  for (const auto& [a, b] : {std::pair (0, 1), {1, 2}, {0, 2}, {3, 4}, {4, 5}, {3, 5}})
    graph.vote (a, b, 2.0F);
  graph.vote (0, 3, -1.0F);
  for (const auto& [a, b] : {std::pair (1, 4), {2, 5}, {1, 3}, {2, 4}})
    graph.vote (a, b, 0.6F);
  graph.contract (0.0F, 0.0F, 6);
  EXPECT_EQ (graph.find (0).turned, graph.find (3).turned);
  // (4 * .6 - 1) of (4 * .6 + 1) agree on it; within the clusters all do.
  const std::vector<float> agreements = graph.agreements();
  EXPECT_NEAR (
      *std::min_element (agreements.begin(), agreements.end()), 1.4 / 3.4, 1e-5);
  EXPECT_EQ (*std::max_element (agreements.begin(), agreements.end()), 1.0F);
}

TEST (SignedContraction, KeepsToWhatItMayJoin)
{
  SignedContraction graph ({10, 10, 1, 1});
  graph.vote (0, 1, 5.0F);
  graph.vote (1, 2, 3.0F);
  graph.vote (2, 3, 3.0F);
  graph.vote (2, 3, -2.5F);
  graph.contract (0.9F, 1.5F, 15);
  EXPECT_NE (graph.find (0).root, graph.find (1).root) << "too large together";
  EXPECT_EQ (graph.find (1).root, graph.find (2).root);
  EXPECT_NE (graph.find (2).root, graph.find (3).root) << "votes that do not agree";
  EXPECT_FLOAT_EQ (graph.border (graph.find (3).root), 5.5F);
}

} // namespace
