// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/kruskal_min_spanning_tree.hpp>

#include "lines/spanning_forest.h"
#include "support/stage_inputs.h"

#include <cmath>
#include <random>
#include <set>
#include <tuple>

using namespace pcl::crest;

namespace {

using Pairs = std::set<std::pair<index_t, index_t>>;

Pairs
pairsOf (const std::vector<CrestEdge>& edges)
{
  Pairs pairs;
  for (const CrestEdge& e : edges)
    pairs.emplace (e.a, e.b);
  return pairs;
}

/** \brief Weight, length and points: the total order that makes the forest unique. */
using Rank = std::tuple<int, float, index_t, index_t>;

Rank
rankOf (const CrestEdge& e)
{
  return {static_cast<int> (e.type), e.length, e.a, e.b};
}

/** \brief Kruskal as the textbook has it (Cormen et al. 1993): sort all edges, take
 * each that joins two trees, relabel one of them.
 */
Pairs
textbookForest (std::size_t size, std::vector<CrestEdge> edges)
{
  std::sort (edges.begin(), edges.end(), [] (const CrestEdge& e, const CrestEdge& f) {
    return rankOf (e) < rankOf (f);
  });
  std::vector<int> tree (size);
  std::iota (tree.begin(), tree.end(), 0);
  Pairs taken;
  for (const CrestEdge& e : edges) {
    const int from = tree[e.a];
    const int to = tree[e.b];
    if (from == to)
      continue;
    taken.emplace (e.a, e.b);
    std::replace (tree.begin(), tree.end(), from, to);
  }
  return taken;
}

/** \brief Total weight of Boost's minimum spanning forest with the weights 1, 5, 10. */
int
boostWeight (std::size_t size, const std::vector<CrestEdge>& edges)
{
  using Graph = boost::adjacency_list<boost::vecS,
                                      boost::vecS,
                                      boost::undirectedS,
                                      boost::no_property,
                                      boost::property<boost::edge_weight_t, int>>;
  Graph graph (size);
  for (const CrestEdge& e : edges)
    boost::add_edge (e.a, e.b, static_cast<int> (e.type), graph);
  std::vector<Graph::edge_descriptor> forest;
  boost::kruskal_minimum_spanning_tree (graph, std::back_inserter (forest));
  int sum = 0;
  for (const auto& e : forest)
    sum += boost::get (boost::edge_weight, graph, e);
  return sum;
}

std::vector<CrestEdge>
randomEdges (std::size_t size, std::size_t count, std::mt19937& random)
{
  std::uniform_int_distribution<int> vertex (0, static_cast<int> (size) - 1);
  std::uniform_int_distribution<int> length (1, 6); // few values, so many ties
  const EdgeType types[] = {EdgeType::A, EdgeType::B, EdgeType::C};
  Pairs taken;
  std::vector<CrestEdge> edges;
  while (edges.size() < count) {
    const int a = vertex (random);
    const int b = vertex (random);
    if (a < b && taken.emplace (a, b).second)
      edges.push_back (
          {a, b, types[random() % 3], static_cast<float> (length (random))});
  }
  return edges;
}

} // namespace

TEST (SpanningForest, EqualsTheTextbookOnRandomGraphs)
{
  std::mt19937 random (7);
  for (const std::size_t count : {10, 60, 100, 150, 400}) {
    constexpr std::size_t SIZE = 100; // with few edges a forest of many trees
    const std::vector<CrestEdge> edges = randomEdges (SIZE, count, random);
    const std::vector<CrestEdge> forest = minimumSpanningForest (SIZE, edges);
    EXPECT_EQ (pairsOf (forest), textbookForest (SIZE, edges));
    int weight = 0;
    for (const CrestEdge& e : forest)
      weight += static_cast<int> (e.type);
    EXPECT_EQ (weight, boostWeight (SIZE, edges));
  }
}

TEST (SpanningForest, GrownAlongTheStarsEqualsTheTextbook)
{
  std::mt19937 random (17);
  std::uniform_real_distribution<float> place (0.0F, 1.0F);
  constexpr int SIDE = 20;
  for (const bool lattice : {false, true})
    for (const unsigned most : {2U, 5U}) {
      std::vector<Eigen::Vector3f> positions;
      for (int i = 0; i < SIDE * SIDE; ++i) {
        const int row = i / SIDE;
        positions.emplace_back (
            lattice ? Eigen::Vector3f (
                          static_cast<float> (i % SIDE), static_cast<float> (row), 0.0F)
                    : Eigen::Vector3f (place (random), place (random), place (random)));
      }
      const OrientedPoints points = oracle::pointsAt (positions);
      std::vector<std::pair<int, int>> pairs;
      for (int i = 0; i < SIDE * SIDE; ++i)
        for (const int step : {1, SIDE - 1, SIDE, SIDE + 1})
          if (i + step < SIDE * SIDE)
            pairs.emplace_back (i, i + step);
      const SurfaceGraph graph = oracle::graphOf (positions.size(), pairs);
      // Of grown points each has a crest point beside it.
      std::vector<CrestType> types (positions.size(), CrestType::NONE);
      for (CrestType& type : types)
        if (random() % most == 0)
          type = CrestType::RIDGE;
      const std::vector<PrincipalCurvature> curvature (
          positions.size(), {1.0F, 0.0F, Eigen::Vector3f::UnitX(), true});
      const auto members = growRegions (graph, curvature, types, CrestType::RIDGE);
      EXPECT_EQ (
          pairsOf (minimumSpanningForest (points, graph, members)),
          textbookForest (positions.size(), crestEdges (points, graph, members)));
    }
}

TEST (SpanningForest, DoesNotDependOnTheOrderOfTheEdges)
{
  std::mt19937 random (11);
  std::vector<CrestEdge> edges = randomEdges (50, 300, random);
  const Pairs before = pairsOf (minimumSpanningForest (50, edges));
  std::shuffle (edges.begin(), edges.end(), random);
  EXPECT_EQ (pairsOf (minimumSpanningForest (50, edges)), before);
}

TEST (SpanningForest, TakesAllTypeAFirst)
{
  // A triangle of long A edges: two of them stay, though the C edges are short.
  const std::vector<CrestEdge> edges{{0, 1, EdgeType::A, 100.0},
                                     {1, 2, EdgeType::A, 101.0},
                                     {0, 2, EdgeType::A, 102.0},
                                     {0, 3, EdgeType::B, 50.0},
                                     {3, 4, EdgeType::C, 1.0F},
                                     {2, 4, EdgeType::B, 2.0}};
  EXPECT_EQ (pairsOf (minimumSpanningForest (5, edges)),
             (Pairs{{0, 1}, {1, 2}, {2, 4}, {0, 3}}));
}

TEST (SpanningForest, OfNothingIsNothing)
{
  EXPECT_TRUE (minimumSpanningForest (0, {}).empty());
  EXPECT_TRUE (minimumSpanningForest (3, {}).empty());
}

TEST (SpanningForest, EdgesHaveTheTypeOfTheirEnds)
{
  const OrientedPoints points =
      oracle::pointsAt ({{0, 0, 0}, {3, 4, 0}, {3, 5, 0}, {9, 9, 9}});
  const SurfaceGraph graph = oracle::graphOf (4, {{0, 1}, {1, 2}, {0, 2}, {2, 3}});
  using M = Membership;
  const auto typesFor = [&] (const std::vector<M>& members) {
    std::vector<std::tuple<int, int, EdgeType, float>> found;
    for (const CrestEdge& e : crestEdges (points, graph, members))
      found.emplace_back (e.a, e.b, e.type, e.length);
    return found;
  };
  using Found = std::vector<std::tuple<int, int, EdgeType, float>>;
  EXPECT_EQ (typesFor ({M::CREST, M::CREST, M::GROWN, M::OUTSIDE}),
             (Found{{0, 1, EdgeType::A, 5.0F},
                    {0, 2, EdgeType::B, std::sqrt (34.0F)},
                    {1, 2, EdgeType::B, 1.0F}}));
  EXPECT_EQ (typesFor ({M::OUTSIDE, M::GROWN, M::GROWN, M::OUTSIDE}),
             (Found{{1, 2, EdgeType::C, 1.0F}}));
}
