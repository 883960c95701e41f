// SPDX-License-Identifier: BSD-3-Clause
#include "lines/spanning_forest.h"

#include "base/disjoint_sets.h"
#include "base/large_arrays.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace pcl {
namespace crest {

namespace {

bool
isShorter (const CrestEdge& e, const CrestEdge& f)
{
  return std::tie (e.length, e.a, e.b) < std::tie (f.length, f.a, f.b);
}

/** \brief Kruskal's algorithm, which sorts only those of the longer edges that the
 * shorter ones have not made cycles of (Filter-Kruskal: Osipov, Sanders and Singler
 * 2009).
 */
template <typename Iterator>
void
takeShortest (Iterator first,
              Iterator last,
              DisjointSets& trees,
              std::vector<CrestEdge>& forest)
{
  constexpr std::ptrdiff_t FEW = 1000;
  if (last - first <= FEW) {
    std::sort (first, last, isShorter);
    for (auto edge = first; edge != last; ++edge)
      if (trees.unite (edge->a, edge->b))
        forest.push_back (*edge);
    return;
  }
  const auto middle = first + (last - first) / 2;
  std::nth_element (first, middle, last, isShorter);
  takeShortest (first, middle, trees, forest);
  last = std::remove_if (middle, last, [&] (const CrestEdge& e) {
    return trees.find (e.a) == trees.find (e.b);
  });
  takeShortest (middle, last, trees, forest);
}

/** \brief Takes the edges by their types first, then by length. */
void
takeByType (std::vector<CrestEdge>& edges,
            DisjointSets& trees,
            std::vector<CrestEdge>& forest)
{
  const auto endOf = [&edges] (auto begin, EdgeType type) {
    return std::partition (
        begin, edges.end(), [type] (const CrestEdge& e) { return e.type == type; });
  };
  const auto b_begin = endOf (edges.begin(), EdgeType::A);
  const auto c_begin = endOf (b_begin, EdgeType::B);
  takeShortest (edges.begin(), b_begin, trees, forest);
  takeShortest (b_begin, c_begin, trees, forest);
  takeShortest (c_begin, edges.end(), trees, forest);
}

EdgeType
edgeType (Membership a, Membership b)
{
  if (a == Membership::CREST && b == Membership::CREST)
    return EdgeType::A;
  return a == Membership::GROWN && b == Membership::GROWN ? EdgeType::C : EdgeType::B;
}

float
lengthOf (const OrientedPoints& points, index_t p, index_t q)
{
  return static_cast<float> (points.edge (p, q).norm());
}

CrestEdge
makeEdge (const OrientedPoints& points, index_t p, index_t q, EdgeType type)
{
  return {std::min (p, q), std::max (p, q), type, lengthOf (points, p, q)};
}

/** \brief The crest graphs of one type with the trees that are found in them. */
struct GrowingForest {
  const OrientedPoints& points;
  const SurfaceGraph& graph;
  const std::vector<Membership>& membership;
  DisjointSets trees;
  std::vector<CrestEdge> edges;

  /** \brief Takes for each point its shortest edge to a crest point: the first step of
   * Boruvka (1926), which needs no sorting. A grown point is a leaf then, which changes
   * nothing for the edges between crest points that are still to come.
   */
  void
  takeShortestOfEach ()
  {
    constexpr float FAR = std::numeric_limits<float>::infinity();
    std::vector<index_t> nearest (graph.size(), OrientedPoints::INVALID);
    std::vector<float> shortest (graph.size(), FAR);
    for (index_t p = 0; p < static_cast<index_t> (graph.size()); ++p) {
      if (membership[p] != Membership::CREST)
        continue;
      for (const index_t q : graph.star (p)) {
        // Of equally near points the lowest comes first. Which is nearer is as good as
        // random: there is no branch for it.
        const float length = lengthOf (points, p, q);
        const bool shorter = length < shortest[q];
        shortest[q] = shorter ? length : shortest[q];
        nearest[q] = shorter ? p : nearest[q];
      }
    }
    for (index_t q = 0; q < static_cast<index_t> (graph.size()); ++q)
      if (nearest[q] != OrientedPoints::INVALID &&
          membership[q] != Membership::OUTSIDE && trees.unite (nearest[q], q))
        edges.push_back (makeEdge (
            points, nearest[q], q, edgeType (membership[q], Membership::CREST)));
  }

  /** \brief Takes the edges that are missing between the trees, from points of a
   * membership to others of it and to crest points.
   */
  void
  takeOthers (Membership from)
  {
    std::vector<CrestEdge> missing;
    std::vector<index_t> apart;
    const std::vector<index_t>& tree = trees.flatten();
    for (index_t p = 0; p < static_cast<index_t> (graph.size()); ++p) {
      if (membership[p] != from)
        continue;
      const Star star = graph.star (p);
      apart.resize (star.size());
      std::size_t count = 0;
      for (const index_t q : star) {
        const auto same = static_cast<std::size_t> (membership[q] == from);
        const auto crest =
            static_cast<std::size_t> (membership[q] == Membership::CREST);
        const auto once = static_cast<std::size_t> (p < q);
        const auto other_tree = static_cast<std::size_t> (tree[q] != tree[p]);
        apart[count] = q;
        // One of the same membership is met from both ends.
        count += other_tree & ((same & once) | (crest & (1 - same)));
      }
      for (std::size_t i = 0; i < count; ++i)
        missing.push_back (
            makeEdge (points, p, apart[i], edgeType (from, membership[apart[i]])));
    }
    takeByType (missing, trees, edges);
  }
};

} // namespace

std::vector<CrestEdge>
crestEdges (const OrientedPoints& points,
            const SurfaceGraph& graph,
            const std::vector<Membership>& membership)
{
  std::vector<CrestEdge> edges;
  for (index_t a = 0; a < static_cast<index_t> (graph.size()); ++a) {
    if (membership[a] == Membership::OUTSIDE)
      continue;
    for (const index_t b : graph.star (a))
      if (a < b && membership[b] != Membership::OUTSIDE)
        edges.push_back (
            makeEdge (points, a, b, edgeType (membership[a], membership[b])));
  }
  return edges;
}

std::vector<CrestEdge>
admissibleEdges (const OrientedPoints& points,
                 const SurfaceGraph& graph,
                 const std::vector<CrestProfile>& profiles,
                 std::vector<CrestEdge> edges)
{
  // In spacings. Two points at one place of a crest are nearer than SHORTEST_RUNG to
  // each other, and their direction means nothing.
  constexpr double LONGEST = 3.0;
  constexpr double SHORTEST_RUNG = 0.8;
  // A rung runs along t1 of both its ends; where an end was but grown, t1 of one is
  // enough if it is clear.
  constexpr double RUNG_COSINE = 0.8;
  constexpr double CLEAR_RUNG_COSINE = 0.95;

  const auto inadmissible = [&] (const CrestEdge& edge) {
    const Eigen::Vector3d e = points.edge (edge.a, edge.b);
    const double length = e.norm();
    const double spacing = 0.5 * (graph.spacing[edge.a] + graph.spacing[edge.b]);
    if (length > LONGEST * spacing)
      return true;
    if (length <= SHORTEST_RUNG * spacing)
      return false;
    const auto cosine = [&] (index_t i) {
      return std::abs (e.dot (profiles[i].curvature.t1.cast<double>())) / length;
    };
    const double a = cosine (edge.a);
    const double b = cosine (edge.b);
    return std::min (a, b) > RUNG_COSINE ||
           (edge.type != EdgeType::A && std::max (a, b) > CLEAR_RUNG_COSINE);
  };
  edges.erase (std::remove_if (edges.begin(), edges.end(), inadmissible), edges.end());
  return edges;
}

std::vector<CrestEdge>
minimumSpanningForest (const OrientedPoints& points,
                       const SurfaceGraph& graph,
                       const std::vector<Membership>& membership)
{
  GrowingForest forest{points, graph, membership, DisjointSets (points.size()), {}};
  // A tree has one edge less than points.
  reserveLarge (forest.edges,
                static_cast<std::size_t> (std::count_if (
                    membership.begin(), membership.end(), [] (Membership m) {
                      return m != Membership::OUTSIDE;
                    })));
  forest.takeShortestOfEach();
  forest.takeOthers (Membership::CREST);
  forest.takeOthers (Membership::GROWN);
  return std::move (forest.edges);
}

std::vector<CrestEdge>
minimumSpanningForest (std::size_t size,
                       std::vector<CrestEdge> edges,
                       const std::vector<CrestEdge>& given)
{
  DisjointSets trees (size);
  std::vector<CrestEdge> forest = given;
  for (const CrestEdge& edge : given)
    trees.unite (edge.a, edge.b);
  takeByType (edges, trees, forest);
  return forest;
}

} // namespace crest
} // namespace pcl
