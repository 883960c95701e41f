// SPDX-License-Identifier: BSD-3-Clause
#include "creases/crease_chains.h"

#include <Eigen/Geometry>

#include "base/parallel.h"
#include "creases/place_search.h"

#include <cmath>
#include <tuple>

namespace pcl {
namespace crest {

namespace {

/** \brief The way from one place to another, along a direction and across it. */
struct Way {
  double along;
  double across;
};

Way
wayTo (const CreaseNode& from, const Eigen::Vector3d& place)
{
  const Eigen::Vector3d e = place - from.foot;
  const double along = e.dot (from.direction);
  return {along, (e - along * from.direction).norm()};
}

/** \brief Whether two nodes are tangents of one line, within 30 degrees.
 * \param[in] may_curve whether that may be a circle (Parent and Zucker 1989), of which
 * they are up to 60 degrees apart, as around holes of a few spacings
 */
bool
agree (const CreaseNode& a, const CreaseNode& b, bool may_curve)
{
  constexpr double LEAST_AGREEMENT = 0.87;
  constexpr double LEAST_COSINE_OF_CIRCLE = 0.5;
  // In spacings: of closer ones the way says nothing.
  constexpr double LEAST_DISTANCE = 0.3;
  const double cosine = std::abs (a.direction.dot (b.direction));
  if (cosine >= LEAST_AGREEMENT)
    return true;
  const Eigen::Vector3d way = b.foot - a.foot;
  if (!may_curve || cosine < LEAST_COSINE_OF_CIRCLE ||
      way.norm() < LEAST_DISTANCE * a.spacing)
    return false;
  const Eigen::Vector3d chord = way.normalized();
  const Eigen::Vector3d turned = 2.0 * a.direction.dot (chord) * chord - a.direction;
  return std::abs (turned.dot (b.direction)) >= LEAST_AGREEMENT;
}

/** \brief Moves nodes to the weighted mean of those around on the same line, and drops
 * those that are alone.
 */
std::vector<CreaseNode>
consensus (const OrientedPoints& points,
           const std::vector<CreaseNode>& nodes,
           bool may_curve,
           const Workers& workers)
{
  // In spacings.
  constexpr double REACH = 2.0;
  constexpr double FARTHEST_ACROSS = 0.7;
  constexpr int LEAST_MEMBERS = 3;
  // Weights fall to a tenth at the reach; no fit is believed to be perfect.
  constexpr double FALL = 0.9;
  constexpr double BEST_RATIO = 0.02;

  const PlaceSearch search (points, feet (nodes));
  std::vector<CreaseNode> moved = nodes;
  std::vector<std::uint8_t> agreed (nodes.size(), 0);
  forEachBlock (
      nodes.size(), workers, [&] (std::size_t, std::size_t first, std::size_t last) {
        std::vector<int> around;
        for (std::size_t i = first; i < last; ++i) {
          const CreaseNode& own = nodes[i];
          const double reach = REACH * own.spacing;
          search.within (own.foot, std::hypot (reach, own.spacing), around);
          Eigen::Vector3d foot = Eigen::Vector3d::Zero();
          Eigen::Vector3d direction = Eigen::Vector3d::Zero();
          Eigen::Vector3d normal = Eigen::Vector3d::Zero();
          double angle = 0.0;
          double sum = 0.0;
          int members = 0;
          for (const int j : around) {
            const CreaseNode& other = nodes[j];
            const double cosine = own.direction.dot (other.direction);
            const Way way = wayTo (own, other.foot);
            if (other.type != own.type || !agree (own, other, may_curve) ||
                std::abs (way.along) > reach ||
                way.across > FARTHEST_ACROSS * own.spacing)
              continue;
            const double part = way.along / reach;
            const double weight =
                (1.0 - FALL * part * part) / (BEST_RATIO + other.ratio);
            // Where the other's line passes the plane across one's own.
            foot += weight * (other.foot - way.along / cosine * other.direction);
            direction += (cosine > 0.0 ? weight : -weight) * other.direction;
            normal += weight * other.normal;
            angle += weight * other.angle;
            sum += weight;
            ++members;
          }
          if (members < LEAST_MEMBERS)
            continue;
          moved[i].foot = foot / sum;
          moved[i].direction = direction.normalized();
          moved[i].normal = normal.normalized();
          moved[i].angle = angle / sum;
          agreed[i] = 1;
        }
      });
  std::vector<CreaseNode> kept;
  for (std::size_t i = 0; i < moved.size(); ++i)
    if (agreed[i] != 0)
      kept.push_back (moved[i]);
  return kept;
}

/** \brief Keeps one node for each place on a line. */
std::vector<CreaseNode>
thin (const OrientedPoints& points, const std::vector<CreaseNode>& nodes)
{
  // In spacings.
  constexpr double LEAST_STEP = 0.8;
  constexpr double FARTHEST_ACROSS = 1.5;
  constexpr double LEAST_COSINE = 0.7;
  constexpr double SAME_EDGE = 0.5;

  const auto rank = [&] (std::size_t i) {
    const Eigen::Vector3d e =
        nodes[i].foot - points.positions[nodes[i].point].cast<double>();
    return e.norm() / nodes[i].spacing + nodes[i].ratio;
  };
  std::vector<std::pair<double, int>> order;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    order.emplace_back (rank (i), static_cast<int> (i));
  std::sort (order.begin(), order.end());

  const PlaceSearch search (points, feet (nodes));
  std::vector<std::uint8_t> kept (nodes.size(), 0);
  std::vector<int> around;
  for (const auto& [value, i] : order) {
    const CreaseNode& own = nodes[i];
    search.within (
        own.foot, std::hypot (LEAST_STEP, FARTHEST_ACROSS) * own.spacing, around);
    const bool is_double = std::any_of (around.begin(), around.end(), [&] (int j) {
      const Way way = wayTo (own, nodes[j].foot);
      return kept[j] != 0 && nodes[j].type == own.type &&
             std::abs (own.direction.dot (nodes[j].direction)) > LEAST_COSINE &&
             own.normal.dot (nodes[j].normal) > SAME_EDGE &&
             std::abs (way.along) < LEAST_STEP * own.spacing &&
             way.across < FARTHEST_ACROSS * own.spacing;
    });
    kept[i] = is_double ? 0 : 1;
  }
  std::vector<CreaseNode> thinned;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    if (kept[i] != 0)
      thinned.push_back (nodes[i]);
  return thinned;
}

/** \brief Gives each node at most one link to either side, shortest first. */
std::vector<std::array<int, 2>>
link (const OrientedPoints& points, const std::vector<CreaseNode>& nodes)
{
  // In spacings. Close nodes may be beside each other, distant ones have to follow.
  constexpr double LONGEST = 3.0;
  constexpr double NOT_BESIDE = 0.3;
  constexpr double LEAST_COSINE = 0.8;
  // Lines that turn more than that have a corner there.
  constexpr double STRAIGHT_COSINE = 0.7;

  struct Link {
    double cost;
    int a, b;
    int way_a, way_b;
  };
  const PlaceSearch search (points, feet (nodes));
  std::vector<Link> links;
  std::vector<int> around;
  for (int a = 0; a < static_cast<int> (nodes.size()); ++a) {
    search.within (nodes[a].foot, LONGEST * 1.5 * nodes[a].spacing, around);
    for (const int b : around) {
      if (b <= a || nodes[a].type != nodes[b].type)
        continue;
      const double spacing = 0.5 * (nodes[a].spacing + nodes[b].spacing);
      const Way from_a = wayTo (nodes[a], nodes[b].foot);
      const Way from_b = wayTo (nodes[b], nodes[a].foot);
      const double length = (nodes[b].foot - nodes[a].foot).norm();
      const double across = std::max (from_a.across, from_b.across);
      const double along = std::min (std::abs (from_a.along), std::abs (from_b.along));
      if (length > LONGEST * spacing ||
          std::abs (nodes[a].direction.dot (nodes[b].direction)) < STRAIGHT_COSINE ||
          (along < LEAST_COSINE * length && across > NOT_BESIDE * spacing))
        continue;
      links.push_back ({length + 2.0 * across,
                        a,
                        b,
                        from_a.along > 0.0 ? 1 : 0,
                        from_b.along > 0.0 ? 1 : 0});
    }
  }
  std::sort (links.begin(), links.end(), [] (const Link& x, const Link& y) {
    return std::tie (x.cost, x.a, x.b) < std::tie (y.cost, y.a, y.b);
  });
  constexpr int NONE = CreaseChains::NO_NODE;
  std::vector<std::array<int, 2>> next (nodes.size(), {NONE, NONE});
  for (const Link& l : links)
    if (next[l.a][l.way_a] == NONE && next[l.b][l.way_b] == NONE) {
      next[l.a][l.way_a] = l.b;
      next[l.b][l.way_b] = l.a;
    }
  return next;
}

/** \brief Numbers the chains and measures them. */
void
collectChains (CreaseChains& chains)
{
  constexpr double STRONG_RATIO = 0.5;
  constexpr int NONE = CreaseChains::NO_NODE;
  chains.chain_of.assign (chains.nodes.size(), NONE);
  for (int start = 0; start < static_cast<int> (chains.nodes.size()); ++start) {
    if (chains.chain_of[start] != NONE)
      continue;
    const auto number = static_cast<int> (chains.chains.size());
    CreaseChains::Chain chain;
    std::vector<int> found{start};
    chains.chain_of[start] = number;
    for (std::size_t i = 0; i < found.size(); ++i) {
      const CreaseNode& node = chains.nodes[found[i]];
      ++chain.nodes;
      chain.roundness += node.roundness;
      chain.strong += node.ratio < STRONG_RATIO ? 1 : 0;
      for (const int q : chains.next[found[i]]) {
        if (q == NONE) {
          chain.closed = false;
          continue;
        }
        chain.length += 0.5 * (chains.nodes[q].foot - node.foot).norm() / node.spacing;
        if (chains.chain_of[q] == NONE) {
          chains.chain_of[q] = number;
          found.push_back (q);
        }
      }
    }
    chains.chains.push_back (chain);
  }
}

} // namespace

CreaseChains
chainCreases (const OrientedPoints& points,
              const SurfaceGraph& graph,
              const std::vector<Crease>& creases,
              bool may_curve,
              const Workers& workers)
{
  std::vector<CreaseNode> nodes;
  for (std::size_t i = 0; i < creases.size(); ++i)
    if (creases[i].type != CrestType::NONE)
      nodes.push_back ({static_cast<index_t> (i),
                        creases[i].type,
                        creases[i].foot.cast<double>(),
                        creases[i].direction.cast<double>(),
                        creases[i].normal.cast<double>(),
                        creases[i].angle,
                        creases[i].ratio,
                        creases[i].roundness,
                        graph.spacing[i]});
  constexpr int PASSES = 2;
  for (int pass = 0; pass < PASSES; ++pass)
    nodes = consensus (points, nodes, may_curve, workers);
  CreaseChains chains;
  chains.nodes = thin (points, nodes);
  chains.next = link (points, chains.nodes);
  collectChains (chains);
  return chains;
}

} // namespace crest
} // namespace pcl
