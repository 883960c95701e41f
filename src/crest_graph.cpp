// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_crest/crest_graph.h>

#include "disjoint_sets.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace pcl {
namespace crest {

namespace {

EdgeType
edgeType (Membership a, Membership b)
{
  if (a == Membership::CREST && b == Membership::CREST)
    return EdgeType::A;
  return a == Membership::GROWN && b == Membership::GROWN ? EdgeType::C : EdgeType::B;
}

} // namespace

std::vector<Membership>
growRegions (const SurfaceGraph& graph,
             const std::vector<PrincipalCurvature>& curvature,
             const std::vector<CrestType>& crest_points,
             CrestType type)
{
  std::vector<Membership> membership (graph.size(), Membership::OUTSIDE);
  for (std::size_t i = 0; i < graph.size(); ++i) {
    if (crest_points[i] != type)
      continue;
    membership[i] = Membership::CREST;
    for (const index_t q : graph.star (static_cast<index_t> (i)))
      if (crest_points[q] == CrestType::NONE && curvature[q].valid)
        membership[q] = Membership::GROWN;
  }
  return membership;
}

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
        edges.push_back ({a,
                          b,
                          edgeType (membership[a], membership[b]),
                          points.edge (a, b).squaredNorm()});
  }
  return edges;
}

std::vector<Membership>
growAlongCrests (const SurfaceGraph& graph,
                 const std::vector<CrestProfile>& profiles,
                 const std::vector<CrestType>& crest_points,
                 const std::vector<CrestType>& likely_points,
                 CrestType type)
{
  std::vector<Membership> membership (graph.size(), Membership::OUTSIDE);
  std::vector<index_t> reached;
  for (std::size_t i = 0; i < graph.size(); ++i)
    if (crest_points[i] == type) {
      membership[i] = Membership::CREST;
      reached.push_back (static_cast<index_t> (i));
    }
  const auto join = [&] (index_t q) {
    const bool free =
        membership[q] == Membership::OUTSIDE && crest_points[q] == CrestType::NONE;
    if (free)
      membership[q] = Membership::GROWN;
    return free;
  };
  for (std::size_t i = 0; i < reached.size(); ++i)
    for (const index_t q : graph.star (reached[i]))
      if (likely_points[q] == type && join (q))
        reached.push_back (q);

  constexpr double FARTHEST_FOOT = 3.0;
  for (const index_t p : reached)
    for (const index_t q : graph.star (p)) {
      const CrestProfile& profile = profiles[q];
      if (profile.curvature.valid &&
          (profile.curvature.k1 > 0.0F) == (type == CrestType::RIDGE) &&
          std::abs (profile.foot) < FARTHEST_FOOT * graph.spacing[q])
        join (q);
    }
  return membership;
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
minimumSpanningForest (std::size_t size,
                       std::vector<CrestEdge> edges,
                       const std::vector<CrestEdge>& given)
{
  const auto b_begin =
      std::partition (edges.begin(), edges.end(), [] (const CrestEdge& e) {
        return e.type == EdgeType::A;
      });
  const auto c_begin = std::partition (
      b_begin, edges.end(), [] (const CrestEdge& e) { return e.type == EdgeType::B; });
  const auto shorter = [] (const CrestEdge& e, const CrestEdge& f) {
    return std::tie (e.squared_length, e.a, e.b) <
           std::tie (f.squared_length, f.a, f.b);
  };

  DisjointSets trees (size);
  std::vector<CrestEdge> forest = given;
  for (const CrestEdge& edge : given)
    trees.unite (edge.a, edge.b);
  const auto takeBucket = [&] (auto first, auto last) {
    // Most edges of the later buckets close a cycle already: drop them before sorting.
    last = std::remove_if (first, last, [&] (const CrestEdge& e) {
      return trees.find (e.a) == trees.find (e.b);
    });
    std::sort (first, last, shorter);
    for (auto edge = first; edge != last; ++edge)
      if (trees.unite (edge->a, edge->b))
        forest.push_back (*edge);
  };
  takeBucket (edges.begin(), b_begin);
  takeBucket (b_begin, c_begin);
  takeBucket (c_begin, edges.end());
  return forest;
}

} // namespace crest
} // namespace pcl
