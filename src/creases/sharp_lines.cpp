// SPDX-License-Identifier: BSD-3-Clause
#include "creases/sharp_lines.h"

#include "search/position_tree.h"
#include "surface/flat_places.h"
#include "surface/surface_nodes.h"

#include <algorithm>
#include <tuple>

namespace pcl {
namespace crest {

namespace {

/** \brief Lines on nodes as lines on the samples that were gathered to them. */
SharpLines
onSamples (const OrientedPoints& nodes, SharpLines lines)
{
  for (SharpNode& node : lines.nodes)
    node.point = nodes.cloud_index[node.point];
  std::sort (lines.nodes.begin(),
             lines.nodes.end(),
             [] (const SharpNode& a, const SharpNode& b) { return a.point < b.point; });
  for (const CrestType type : CREST_TYPES) {
    for (CrestEdge& edge : lines.edges[type])
      std::tie (edge.a, edge.b) =
          std::minmax (nodes.cloud_index[edge.a], nodes.cloud_index[edge.b]);
    std::sort (lines.edges[type].begin(), lines.edges[type].end(), comesFirst);
  }
  std::vector<std::uint8_t> blocked;
  blocked.reserve (nodes.packed_index.size());
  for (const index_t node : nodes.packed_index)
    blocked.push_back (lines.blocked[node]);
  lines.blocked = std::move (blocked);
  return lines;
}

/** In spacings: where there is more, edges are as uncertain as those of nodes. */
constexpr double HIGH_NOISE = 0.27;

/** \brief What two planes may leave, by the noise of samples; all in spacings. Where
 * there is little, more would be curved faces, or lines that belong to a third one.
 * What was gathered is rounded at edges whatever its noise.
 */
double
largestResidual (double noise, bool gathered)
{
  constexpr double LOW_NOISE = 0.22;
  constexpr double IN_LOW_NOISE = 0.35;
  constexpr double IN_HIGH_NOISE = 0.55;
  if (gathered)
    return IN_HIGH_NOISE;
  const double high =
      std::clamp ((noise - LOW_NOISE) / (HIGH_NOISE - LOW_NOISE), 0.0, 1.0);
  return IN_LOW_NOISE + high * (IN_HIGH_NOISE - IN_LOW_NOISE);
}

SharpLines
linesOn (const OrientedPoints& points,
         const SurfaceGraph& graph,
         const NeighborSearch& search,
         double noise,
         const Workers& workers)
{
  return traceCreases (
      points,
      graph,
      search,
      findCreases (
          points, graph, search, largestResidual (noise, points.gathered), workers),
      noise < HIGH_NOISE && !points.gathered,
      workers);
}

} // namespace

SharpLines
findSharpLines (const OrientedPoints& points,
                const SurfaceGraph& graph,
                const std::shared_ptr<const PointTree>& tree,
                const Workers& workers)
{
  // In spacings: more hides the lesser edges.
  constexpr double LEAST_NOISE = 0.52;
  constexpr double NOISE_OF_NODES = 0.28;
  const NeighborSearch search = batchedSearch (tree, CREASE_NEIGHBORS);
  const double noise = typicalNoise (points, search);
  if (noise < LEAST_NOISE)
    return linesOn (points, graph, search, noise, workers);
  const OrientedPoints nodes = gatherOnSurface (points, NOISE_OF_NODES, workers);
  const std::shared_ptr<const PointTree> node_tree =
      treeOver (nodes.positions, workers.threads);
  Parameters parameters;
  parameters.threads = workers.threads;
  return onSamples (nodes,
                    linesOn (nodes,
                             buildSurfaceGraph (nodes, node_tree, parameters),
                             batchedSearch (node_tree, CREASE_NEIGHBORS),
                             NOISE_OF_NODES,
                             workers));
}

} // namespace crest
} // namespace pcl
