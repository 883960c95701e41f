// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "support/stage_inputs.h"
#include "surface/node_walk.h"

#include <algorithm>
#include <random>
#include <set>

using namespace pcl::crest;

namespace {

/** \brief Edges between points of a long grid, by random numbers of these. */
SurfaceGraph
scrambledGrid (int width, int height)
{
  std::vector<int> number (static_cast<std::size_t> (width * height));
  std::iota (number.begin(), number.end(), 0);
  std::shuffle (number.begin(), number.end(), std::mt19937 (1));
  std::vector<std::pair<int, int>> edges;
  const auto connect = [&] (int a, int b) {
    edges.emplace_back (number[a], number[b]);
  };
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const int i = y * width + x;
      if (x + 1 < width)
        connect (i, i + 1);
      if (y + 1 < height)
        connect (i, i + width);
    }
  return oracle::graphOf (number.size(), edges);
}

struct Twice {
  int
  operator() (index_t q) const
  {
    return 2 * q;
  }
};

/** \brief A walk by sets: its rings, of nodes that are accepted. */
template <typename Accept>
std::vector<std::set<index_t>>
ringsPlainly (const SurfaceGraph& graph, index_t node, int rings, const Accept& accept)
{
  std::vector<std::set<index_t>> result{{node}};
  std::set<index_t> asked{node};
  for (int ring = 0; ring < rings && !result.back().empty(); ++ring) {
    std::set<index_t> next;
    for (const index_t p : result.back())
      for (const index_t q : graph.star (p))
        if (asked.insert (q).second && accept (q))
          next.insert (q);
    result.push_back (next);
  }
  return result;
}

template <typename Accept>
void
expectRings (NodeWalk<Twice>& walk,
             const SurfaceGraph& graph,
             index_t node,
             int rings,
             const Accept& accept)
{
  walk.start (node);
  std::size_t first = 0;
  for (const std::set<index_t>& expected : ringsPlainly (graph, node, rings, accept)) {
    std::set<index_t> ring;
    for (std::size_t i = first; i < walk.size(); ++i) {
      ring.insert (walk.node (i));
      ASSERT_EQ (walk[i], 2 * walk.node (i));
    }
    ASSERT_EQ (ring, expected) << "from " << node;
    ASSERT_EQ (ring.size(), walk.size() - first) << "a node twice";
    first = walk.size();
    const bool goes_on = walk.advance ([&] (int twice) { return accept (twice / 2); });
    ASSERT_EQ (goes_on, walk.size() > first);
  }
}

} // namespace

TEST (NodeWalk, ReachesRingByRing)
{
  const SurfaceGraph graph = scrambledGrid (80, 50);
  NodeWalk<Twice> walk (graph, Twice());
  const auto all = [] (index_t) { return true; };
  // Far more walks, and here and there a longer one, than fit into what is kept.
  for (index_t node = 0; node < 4000; node += 7)
    expectRings (walk, graph, node, node % 1000 < 7 ? 40 : 4, all);
}

TEST (NodeWalk, GoesAroundWhatIsNotAccepted)
{
  const SurfaceGraph graph = scrambledGrid (60, 40);
  NodeWalk<Twice> walk (graph, Twice());
  const auto most = [] (index_t q) { return q % 3 != 0; };
  for (index_t node = 0; node < 2400; node += 11)
    expectRings (walk, graph, node, 12, most);
}

TEST (NodeWalk, StopsWhereNothingIsLeft)
{
  const SurfaceGraph graph = oracle::graphOf (3, {{0, 1}});
  NodeWalk<Twice> walk (graph, Twice());
  const auto all = [] (int) { return true; };
  walk.start (0);
  EXPECT_TRUE (walk.advance (all));
  EXPECT_FALSE (walk.advance (all));
  EXPECT_FALSE (walk.advance (all));
  EXPECT_EQ (walk.size(), 2U);
  walk.start (2);
  EXPECT_FALSE (walk.advance (all));
  EXPECT_EQ (walk.size(), 1U);
}
