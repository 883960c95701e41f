// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "creases/creases.h"

#include <array>
#include <vector>

namespace pcl {
namespace crest {

/** \brief A crease of a sample, in double precision. */
struct CreaseNode {
  index_t point;
  CrestType type;
  Eigen::Vector3d foot;
  Eigen::Vector3d direction;
  Eigen::Vector3d normal;
  double angle;
  double ratio;
  double roundness;
  double spacing;
};

/** \brief Where nodes stand, as PlaceSearch takes it. */
inline std::vector<Eigen::Vector3d>
feet (const std::vector<CreaseNode>& nodes)
{
  std::vector<Eigen::Vector3d> places;
  places.reserve (nodes.size());
  for (const CreaseNode& node : nodes)
    places.push_back (node.foot);
  return places;
}

/** \brief Nodes in chains: next[0] against the direction of a node, next[1] along it;
 * NO_NODE at ends.
 */
struct CreaseChains {
  static constexpr int NO_NODE = -1;

  std::vector<CreaseNode> nodes;
  std::vector<std::array<int, 2>> next;
  /** for each node its chain */
  std::vector<int> chain_of;

  struct Chain {
    int nodes = 0;
    /** those with a fit beyond doubt */
    int strong = 0;
    /** sum over the nodes */
    double roundness = 0.0;
    /** in spacings */
    double length = 0.0;
    bool closed = true;
  };
  std::vector<Chain> chains;
};

/** \brief Consensus, thinning and linking (see traceCreases). */
CreaseChains
chainCreases (const OrientedPoints& points,
              const SurfaceGraph& graph,
              const std::vector<Crease>& creases,
              bool may_curve,
              const Workers& workers);

/** \brief How the ends of chains meet. An end is a node and the way out of its chain,
 * an index into next.
 */
struct CreaseEnd {
  int node;
  int way;
};
struct CreaseJoins {
  /** from an end to another, or to a node in the middle of another line */
  std::vector<std::pair<CreaseEnd, int>> bridges;
  struct Corner {
    Eigen::Vector3d position;
    std::vector<CreaseEnd> ends;
  };
  std::vector<Corner> corners;
};

/** \brief Joins the ends of chains (see traceCreases). */
CreaseJoins
joinEnds (const OrientedPoints& points, const CreaseChains& chains);

} // namespace crest
} // namespace pcl
