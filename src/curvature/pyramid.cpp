// SPDX-License-Identifier: BSD-3-Clause
#include "curvature/pyramid.h"

#include "base/large_arrays.h"
#include "base/parallel.h"
#include "base/scrambled.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace pcl {
namespace crest {

namespace {

/** \brief Rounds of local minima. Each leaves about a quarter of the free nodes free:
 * after this many it is one in a thousand or less, wherever the cloud is cut to tiles.
 * Where symmetry changes smoothly, as on lattices, minima are few and more is left: for
 * that there are as many rounds again without it.
 */
constexpr int ROUNDS = 8;

/** \brief Least cosine between normals of nodes that may be averaged: neighbours across
 * a sharp edge or on two sheets are not one piece of surface.
 */
constexpr float MERGE_COSINE = 0.5F;

/** What of a priority is hash. */
constexpr std::uint64_t HASH = 0xFFFFFFFFU;

/** \brief How lopsided the star of a node is, then a hash, so that ties on a lattice
 * fall at random and do not build long chains: smaller comes first.
 */
std::uint64_t
priority (const std::vector<Eigen::Vector3f>& positions,
          const SurfaceGraph& graph,
          index_t node)
{
  const Eigen::Vector3d p = positions[node].cast<double>();
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double lengths = 0.0;
  for (const index_t q : graph.star (node)) {
    const Eigen::Vector3d e = positions[q].cast<double>() - p;
    sum += e;
    lengths += e.norm();
  }
  // 0 where the edges balance, 1 where all go one way; the steps outlast rounding.
  constexpr double STEPS = 1 << 16;
  const double asymmetry = lengths > 0.0 ? sum.norm() / lengths : 1.0;
  return static_cast<std::uint64_t> (STEPS * asymmetry) << 32 |
         scrambled (static_cast<std::uint32_t> (node));
}

bool
mayMerge (const std::vector<Eigen::Vector3f>& normals, index_t a, index_t b)
{
  return normals[a].dot (normals[b]) > MERGE_COSINE;
}

/** \brief The nearest centre that a covered node may join. */
index_t
nearestCentre (const PyramidLevel& fine,
               const std::vector<std::uint8_t>& centres,
               index_t node)
{
  index_t nearest = node;
  double least = 0.0;
  for (const index_t q : fine.graph.star (node)) {
    if (centres[q] == 0 || !mayMerge (fine.normals, node, q))
      continue;
    const double d =
        (fine.positions[q] - fine.positions[node]).cast<double>().squaredNorm();
    if (nearest == node || d < least) {
      nearest = q;
      least = d;
    }
  }
  return nearest;
}

/** \brief Makes means of the nodes that share a centre. */
void
average (const PyramidLevel& fine,
         const std::vector<index_t>& coarse_of,
         PyramidLevel& coarse)
{
  std::vector<Eigen::Vector3d> positions (coarse.size(), Eigen::Vector3d::Zero());
  std::vector<Eigen::Vector3d> normals = positions;
  for (std::size_t i = 0; i < fine.size(); ++i) {
    const index_t c = coarse_of[i];
    positions[c] += fine.weights[i] * fine.positions[i].cast<double>();
    normals[c] += fine.weights[i] * fine.normals[i].cast<double>();
    coarse.weights[c] += fine.weights[i];
  }
  for (std::size_t c = 0; c < coarse.size(); ++c) {
    coarse.positions[c] =
        (positions[c] / static_cast<double> (coarse.weights[c])).cast<float>();
    // All are within 60 degrees of the centre's normal: the sum is not zero.
    coarse.normals[c] = normals[c].normalized().cast<float>();
  }
}

SurfaceGraph
coarserGraph (const SurfaceGraph& fine,
              const std::vector<index_t>& coarse_of,
              std::size_t size)
{
  const auto forEachEdge = [&] (const auto& work) {
    for (index_t a = 0; a < static_cast<index_t> (fine.size()); ++a)
      for (const index_t b : fine.star (a))
        if (coarse_of[a] != coarse_of[b])
          work (coarse_of[a], coarse_of[b]);
  };
  // Each edge as often as fine ones make it, sorted by its first node.
  std::vector<std::size_t> ends (size + 1, 0);
  forEachEdge ([&] (index_t a, index_t) { ++ends[a + 1]; });
  std::partial_sum (ends.begin(), ends.end(), ends.begin());
  std::vector<index_t> repeated (ends.back());
  forEachEdge ([&] (index_t a, index_t b) { repeated[ends[a]++] = b; });

  SurfaceGraph graph;
  graph.offsets = makeOffsets (size);
  // The last node that each was found to be a neighbour of.
  std::vector<index_t> found_by (size, OrientedPoints::INVALID);
  std::size_t at = 0;
  for (std::size_t a = 0; a < size; ++a) {
    const auto first = static_cast<std::ptrdiff_t> (graph.neighbors.size());
    for (; at < ends[a]; ++at) {
      index_t& finder = found_by[repeated[at]];
      if (finder != static_cast<index_t> (a))
        graph.neighbors.push_back (repeated[at]);
      finder = static_cast<index_t> (a);
    }
    std::sort (graph.neighbors.begin() + first, graph.neighbors.end());
    graph.offsets.push_back (graph.neighbors.size());
  }
  return graph;
}

} // namespace

PyramidLevel
finestLevel (const OrientedPoints& points,
             SurfaceGraph graph,
             std::shared_ptr<const PointTree> tree)
{
  PyramidLevel level;
  level.positions = copyLarge (points.positions);
  level.normals = copyLarge (points.normals);
  level.tree = std::move (tree);
  level.weights.assign (points.size(), 1.0F);
  level.graph = std::move (graph);
  level.node_of.resize (points.size());
  std::iota (level.node_of.begin(), level.node_of.end(), 0);
  return level;
}

std::vector<std::uint8_t>
chooseCentres (const std::vector<Eigen::Vector3f>& positions,
               const std::vector<Eigen::Vector3f>& normals,
               const SurfaceGraph& graph,
               const Workers& workers)
{
  enum class Role : std::uint8_t { FREE, CENTRE, COVERED };

  const std::size_t size = positions.size();
  std::vector<std::uint64_t> priorities (size);
  const auto forEachNode = [&] (const auto& work) {
    forEachBlock (
        size, workers, [&] (std::size_t, std::size_t first, std::size_t last) {
          for (std::size_t i = first; i < last; ++i)
            work (static_cast<index_t> (i));
        });
  };
  forEachNode ([&] (index_t i) { priorities[i] = priority (positions, graph, i); });

  std::vector<Role> roles (size, Role::FREE);
  std::vector<Role> before;
  const auto anyNeighbor = [&] (index_t i, Role role, const auto& condition) {
    for (const index_t q : graph.star (i))
      if (before[q] == role && mayMerge (normals, i, q) && condition (q))
        return true;
    return false;
  };
  const auto becomesCentre = [&] (index_t i) {
    return !anyNeighbor (i, Role::FREE, [&] (index_t q) {
      return std::make_pair (priorities[q], q) < std::make_pair (priorities[i], i);
    });
  };
  const auto any_free = [&roles] {
    return std::find (roles.begin(), roles.end(), Role::FREE) != roles.end();
  };
  for (int round = 0; round < 2 * ROUNDS && any_free(); ++round) {
    if (round == ROUNDS)
      for (std::uint64_t& priority : priorities)
        priority &= HASH;
    before = roles;
    forEachNode ([&] (index_t i) {
      if (before[i] == Role::FREE && becomesCentre (i))
        roles[i] = Role::CENTRE;
    });
    before = roles;
    forEachNode ([&] (index_t i) {
      if (before[i] == Role::FREE &&
          anyNeighbor (i, Role::CENTRE, [] (index_t) { return true; }))
        roles[i] = Role::COVERED;
    });
  }
  std::vector<std::uint8_t> centres;
  centres.reserve (size);
  for (const Role role : roles)
    centres.push_back (role == Role::COVERED ? 0 : 1);
  return centres;
}

PyramidLevel
coarserLevel (const PyramidLevel& fine, const Workers& workers)
{
  const std::vector<std::uint8_t> centres =
      chooseCentres (fine.positions, fine.normals, fine.graph, workers);
  std::vector<index_t> coarse_of (fine.size(), OrientedPoints::INVALID);
  index_t size = 0;
  for (std::size_t i = 0; i < fine.size(); ++i)
    if (centres[i] != 0)
      coarse_of[i] = size++;
  for (std::size_t i = 0; i < fine.size(); ++i)
    if (centres[i] == 0)
      coarse_of[i] = coarse_of[nearestCentre (fine, centres, static_cast<index_t> (i))];

  PyramidLevel coarse;
  coarse.positions.resize (size);
  coarse.normals.resize (size);
  coarse.weights.assign (size, 0.0F);
  average (fine, coarse_of, coarse);
  coarse.tree = treeOver (coarse.positions, workers.threads);
  coarse.graph = coarserGraph (fine.graph, coarse_of, coarse.size());
  coarse.node_of.reserve (fine.node_of.size());
  for (const index_t node : fine.node_of)
    coarse.node_of.push_back (coarse_of[node]);
  return coarse;
}

} // namespace crest
} // namespace pcl
