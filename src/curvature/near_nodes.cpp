// SPDX-License-Identifier: BSD-3-Clause
#include "curvature/near_nodes.h"

#include "base/large_arrays.h"
#include "base/parallel.h"

namespace pcl {
namespace crest {

std::vector<SeenNode>
nodesInTreeOrder (const PyramidLevel& level, const Workers& workers)
{
  std::vector<SeenNode> nodes = makeLarge (level.size(), SeenNode());
  forEachBlock (
      nodes.size(), workers, [&] (std::size_t, std::size_t first, std::size_t last) {
        for (std::size_t place = first; place < last; ++place) {
          const index_t q = level.tree->index (static_cast<std::int32_t> (place));
          nodes[place] = {level.positions[q],
                          level.weights[q],
                          level.normals[q],
                          level.graph.star (q).size() == 0};
        }
      });
  return nodes;
}

} // namespace crest
} // namespace pcl
