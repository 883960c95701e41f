// SPDX-License-Identifier: BSD-3-Clause
#include "normals/normal_edges.h"

#include "base/parallel.h"

#include <algorithm>
#include <cmath>

namespace pcl {
namespace crest {

NormalEdges::NormalEdges (const std::vector<Eigen::Vector3f>& points,
                          const NearestMaker& nearest)
: points_ (points), nearest_ (nearest (points, NEIGHBORS + 1))
{}

std::vector<NormalEdge>
NormalEdges::find (const std::vector<Eigen::Vector3f>& normals,
                   const std::vector<index_t>& from,
                   unsigned threads,
                   std::vector<double>& areas) const
{
  areas.assign (from.size(), 0.0);
  std::vector<std::vector<NormalEdge>> blocks (blockCount (from.size()));
  forEachBlock (
      from.size(), threads, [&] (std::size_t block, std::size_t i, std::size_t end) {
        std::vector<index_t> found;
        std::vector<float> distances;
        for (; i < end; ++i) {
          const index_t a = from[i];
          nearest_ (a, found, distances);
          areas[i] = distances.empty() ? 0.0 : distances.back();
          for (const index_t b : found) {
            const Eigen::Vector3f& n = normals[a];
            const Eigen::Vector3f& m = normals[b];
            if (a == b || n.isZero (0.0F) || m.isZero (0.0F))
              continue;
            const Eigen::Vector3f e = (points_[b] - points_[a]).stableNormalized();
            const float agreement = n.dot (m) - 2.0F * n.dot (e) * m.dot (e);
            blocks[block].push_back ({1.0F - std::abs (agreement),
                                      std::min (a, b),
                                      std::max (a, b),
                                      agreement < 0.0F});
          }
        }
      });
  std::vector<NormalEdge> edges;
  for (const std::vector<NormalEdge>& block : blocks)
    edges.insert (edges.end(), block.begin(), block.end());
  std::sort (edges.begin(), edges.end());
  return edges;
}

} // namespace crest
} // namespace pcl
