// SPDX-License-Identifier: BSD-3-Clause
#include "creases/crease_lines.h"

#include "base/parallel.h"
#include "creases/crease_chains.h"

#include <algorithm>
#include <map>
#include <tuple>

namespace pcl {
namespace crest {

namespace {

/** \brief Which chains stay. */
std::vector<std::uint8_t>
keptChains (const CreaseChains& chains, const CreaseJoins& joins)
{
  constexpr double LEAST_STRONG = 0.3;
  constexpr double LARGEST_ROUNDNESS = 1.5;
  constexpr int LEAST_NODES = 3;
  constexpr int LEAST_NODES_CLOSED = 5;
  // In spacings.
  constexpr double LEAST_LENGTH = 5.0;
  constexpr double LEAST_LENGTH_JOINED = 1.5;

  std::vector<int> joined (chains.chains.size(), 0);
  for (const auto& [end, node] : joins.bridges) {
    ++joined[chains.chain_of[end.node]];
    ++joined[chains.chain_of[node]];
  }
  for (const CreaseJoins::Corner& corner : joins.corners)
    for (const CreaseEnd& end : corner.ends)
      ++joined[chains.chain_of[end.node]];
  std::vector<std::uint8_t> kept;
  for (std::size_t i = 0; i < chains.chains.size(); ++i) {
    const CreaseChains::Chain& chain = chains.chains[i];
    const bool long_enough =
        chain.closed ? chain.nodes >= LEAST_NODES_CLOSED
                     : chain.length >= LEAST_LENGTH ||
                           (joined[i] > 1 && chain.length >= LEAST_LENGTH_JOINED);
    // Those whose roundness is not known count as sharp.
    const bool sharp = chain.strong >= LEAST_STRONG * chain.nodes &&
                       chain.roundness <= LARGEST_ROUNDNESS * chain.nodes;
    kept.push_back (chain.nodes >= LEAST_NODES && sharp && long_enough ? 1 : 0);
  }
  return kept;
}

Crease
creaseOf (const CreaseNode& node)
{
  Crease crease;
  crease.type = node.type;
  crease.foot = node.foot.cast<float>();
  crease.direction = node.direction.cast<float>();
  crease.normal = node.normal.cast<float>();
  crease.angle = static_cast<float> (node.angle);
  crease.ratio = static_cast<float> (node.ratio);
  crease.roundness = static_cast<float> (node.roundness);
  return crease;
}

/** \brief Puts nodes and edges together. */
class Net {
public:
  Net (const OrientedPoints& points, const NeighborSearch& search)
  : points_ (points), search_ (search)
  {}

  void
  addNode (const CreaseNode& node)
  {
    nodes_.emplace (node.point, creaseOf (node));
  }

  void
  addEdge (index_t a, index_t b, CrestType type)
  {
    if (a == b)
      return;
    const double length =
        (nodes_.at (a).foot - nodes_.at (b).foot).cast<double>().norm();
    edges_[type].push_back (
        {std::min (a, b), std::max (a, b), EdgeType::A, static_cast<float> (length)});
  }

  /** \brief Adds a node at a corner, with the looks of one of the lines that meet
   * there, in the place of the nearest sample that is none yet; or INVALID if there is
   * none.
   */
  index_t
  addCorner (const Eigen::Vector3d& position, const CreaseNode& like)
  {
    std::vector<index_t> found;
    search_ (like.point, found);
    index_t nearest = OrientedPoints::INVALID;
    double shortest = 0.0;
    for (const index_t q : found) {
      const double distance =
          (points_.positions[q].cast<double>() - position).squaredNorm();
      if (nodes_.count (q) == 0 &&
          (nearest == OrientedPoints::INVALID ||
           std::make_pair (distance, q) < std::make_pair (shortest, nearest))) {
        nearest = q;
        shortest = distance;
      }
    }
    if (nearest == OrientedPoints::INVALID)
      return nearest;
    Crease crease = creaseOf (like);
    crease.foot = position.cast<float>();
    nodes_.emplace (nearest, crease);
    return nearest;
  }

  SharpLines
  finish (const SurfaceGraph& graph) const
  {
    SharpLines lines;
    for (const auto& [point, crease] : nodes_)
      lines.nodes.push_back ({point, crease});
    lines.edges = edges_;
    for (const CrestType type : CREST_TYPES) {
      std::vector<CrestEdge>& edges = lines.edges[type];
      std::sort (edges.begin(), edges.end(), comesFirst);
      // Two ends can be joined more than once.
      edges.erase (std::unique (edges.begin(),
                                edges.end(),
                                [] (const auto& e, const auto& f) {
                                  return std::tie (e.a, e.b) == std::tie (f.a, f.b);
                                }),
                   edges.end());
    }
    lines.blocked.assign (graph.size(), 0);
    for (const CrestType type : CREST_TYPES)
      for (const CrestEdge& edge : lines.edges[type]) {
        block (graph, edge, edge.a, lines.blocked);
        block (graph, edge, edge.b, lines.blocked);
      }
    for (const SharpNode& node : lines.nodes)
      lines.blocked[node.point] = 1;
    return lines;
  }

private:
  /** \brief Blocks the samples next to an edge among the neighbours of one end. */
  void
  block (const SurfaceGraph& graph,
         const CrestEdge& edge,
         index_t end,
         std::vector<std::uint8_t>& blocked) const
  {
    // In spacings.
    constexpr double WIDTH = 1.2;
    const Eigen::Vector3d a = nodes_.at (edge.a).foot.cast<double>();
    const Eigen::Vector3d e = nodes_.at (edge.b).foot.cast<double>() - a;
    std::vector<index_t> found;
    search_ (end, found);
    for (const index_t q : found) {
      const Eigen::Vector3d p = points_.positions[q].cast<double>() - a;
      const double s =
          edge.length > 0.0F ? std::clamp (p.dot (e) / e.squaredNorm(), 0.0, 1.0) : 0.0;
      if ((p - s * e).norm() < WIDTH * graph.spacing[q])
        blocked[q] = 1;
    }
  }

  const OrientedPoints& points_;
  const NeighborSearch& search_;
  std::map<index_t, Crease> nodes_;
  PerType<std::vector<CrestEdge>> edges_;
};

} // namespace

SharpLines
traceCreases (const OrientedPoints& points,
              const SurfaceGraph& graph,
              const NeighborSearch& search,
              const std::vector<Crease>& creases,
              bool may_curve,
              const Workers& workers)
{
  const CreaseChains chains = chainCreases (points, graph, creases, may_curve, workers);
  const CreaseJoins joins = joinEnds (points, chains);
  const std::vector<std::uint8_t> kept = keptChains (chains, joins);
  const auto isKept = [&] (int node) { return kept[chains.chain_of[node]] != 0; };

  Net net (points, search);
  for (int i = 0; i < static_cast<int> (chains.nodes.size()); ++i)
    if (isKept (i))
      net.addNode (chains.nodes[i]);
  const auto addEdge = [&] (int i, int j) {
    net.addEdge (chains.nodes[i].point, chains.nodes[j].point, chains.nodes[i].type);
  };
  for (int i = 0; i < static_cast<int> (chains.nodes.size()); ++i)
    if (isKept (i))
      for (const int j : chains.next[i])
        if (j > i)
          addEdge (i, j);
  for (const auto& [end, node] : joins.bridges)
    if (isKept (end.node) && isKept (node))
      addEdge (end.node, node);
  for (const CreaseJoins::Corner& corner : joins.corners) {
    index_t point = OrientedPoints::INVALID;
    for (const CreaseEnd& end : corner.ends) {
      if (!isKept (end.node))
        continue;
      const CreaseNode& node = chains.nodes[end.node];
      if (point == OrientedPoints::INVALID)
        point = net.addCorner (corner.position, node);
      if (point != OrientedPoints::INVALID)
        net.addEdge (node.point, point, node.type);
    }
  }
  return net.finish (graph);
}

} // namespace crest
} // namespace pcl
