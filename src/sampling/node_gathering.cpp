// SPDX-License-Identifier: BSD-3-Clause
#include "sampling/node_gathering.h"

#include "base/scrambled.h"
#include "search/ball_search.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace pcl {
namespace crest {

GatheredSamples
gatherSamples (const PointTree& tree,
               const std::vector<Eigen::Vector3f>& positions,
               const std::vector<float>& spacings,
               const Workers& workers,
               const std::vector<Eigen::Vector3f>* normals)
{
  constexpr float ONE_SHEET = 0.5F;
  const auto mayJoin = [&] (index_t sample, index_t middle) {
    return spacings[sample] > 0.0F &&
           (normals == nullptr ||
            (*normals)[sample].dot ((*normals)[middle]) > ONE_SHEET);
  };
  const std::size_t size = positions.size();
  std::vector<index_t> order (size);
  std::iota (order.begin(), order.end(), 0);
  std::sort (order.begin(), order.end(), [] (index_t a, index_t b) {
    return scrambled (static_cast<std::uint32_t> (a)) <
           scrambled (static_cast<std::uint32_t> (b));
  });
  std::vector<float> nearest (size, std::numeric_limits<float>::max());
  std::vector<index_t> centre (size, -1);
  std::vector<std::int32_t> found;
  for (const index_t i : order) {
    if (centre[i] >= 0)
      continue;
    centre[i] = i;
    nearest[i] = 0.0F;
    if (!(spacings[i] > 0.0F))
      continue;
    if (workers.progress != nullptr)
      workers.progress->check();
    findWithin (tree, positions[i].data(), spacings[i], found);
    for (const std::int32_t j : found) {
      const float squared = (positions[j] - positions[i]).squaredNorm();
      if (squared < nearest[j] && centre[j] != j && mayJoin (j, i)) {
        nearest[j] = squared;
        centre[j] = i;
      }
    }
  }
  GatheredSamples gathered;
  gathered.node_of.assign (size, -1);
  for (std::size_t i = 0; i < size; ++i)
    if (centre[i] == static_cast<index_t> (i))
      gathered.node_of[i] = static_cast<index_t> (gathered.nodes++);
  for (std::size_t i = 0; i < size; ++i)
    gathered.node_of[i] = gathered.node_of[centre[i]];
  return gathered;
}

} // namespace crest
} // namespace pcl
