// SPDX-License-Identifier: BSD-3-Clause
#include "creases/sharp_links.h"

#include "lines/forest.h"
#include "surface/node_walk.h"

namespace pcl {
namespace crest {

std::vector<CrestEdge>
linksFromSharpEnds (const OrientedPoints& points,
                    const SurfaceGraph& graph,
                    const std::vector<CrestEdge>& sharp,
                    const std::vector<Membership>& membership)
{
  constexpr double LONGEST = 3.0;
  constexpr double LEAST_COSINE = 0.5;
  // Samples stand up to two spacings from their crests.
  constexpr int RINGS = 5;

  std::vector<CrestEdge> links;
  const Forest lines (sharp);
  NodeWalk walk (graph, [&] (index_t q) { return membership[q]; });
  for (int v = 0; v < lines.size(); ++v) {
    if (lines.degree (v) != 1)
      continue;
    const index_t end = lines.packed (v);
    const Eigen::Vector3d out =
        points.edge (lines.packed (lines.neighbors (v)[0]), end);
    walk.start (end);
    for (int ring = 0; ring < RINGS; ++ring)
      walk.advance ([] (Membership) { return true; });
    for (std::size_t i = 0; i < walk.size(); ++i) {
      if (walk[i] != Membership::CREST)
        continue;
      const index_t q = walk.node (i);
      const Eigen::Vector3d e = points.edge (end, q);
      const double length = e.norm();
      if (length < LONGEST * graph.spacing[end] &&
          e.dot (out) > LEAST_COSINE * length * out.norm())
        links.push_back ({std::min (end, q),
                          std::max (end, q),
                          EdgeType::A,
                          static_cast<float> (length)});
    }
  }
  return links;
}

} // namespace crest
} // namespace pcl
