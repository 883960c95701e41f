// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_crest/branch_pruning.h>

#include "forest.h"

#include <algorithm>
#include <functional>
#include <queue>
#include <tuple>

namespace pcl {
namespace crest {

namespace {

/** \brief A branch as it was when it was measured; pruning elsewhere may have made it
 * longer since, never shorter.
 */
struct Branch {
  /** of what decides, points or a part of the limit */
  double size;
  double length;
  int end;

  bool
  operator> (const Branch& o) const
  {
    return std::tie (size, length, end) > std::tie (o.size, o.length, o.end);
  }
};

/** \brief Prunes the branches of up to the largest size, smallest first.
 * \param[in] size the size of a branch, from its points with the junction's at the end
 * \param[in] most points that a branch of the largest size can have without it
 */
template <typename Size>
void
prune (const OrientedPoints& points,
       double largest,
       std::size_t most,
       const Size& size,
       Forest& forest)
{
  // The path of a branch ends with its junction, and has one point more if too long.
  std::vector<int> path;
  const auto isShortBranch = [&] (int end) {
    forest.walk (end, forest.neighbors (end)[0], most + 2, path);
    return forest.isJunction (path.back()) && size (path) <= largest;
  };
  std::priority_queue<Branch, std::vector<Branch>, std::greater<>> branches;
  const auto push = [&] (int end) {
    branches.push ({size (path), forest.length (points, path), end});
  };

  for (int v = 0; v < forest.size(); ++v)
    if (forest.degree (v) == 1 && isShortBranch (v))
      push (v);
  while (!branches.empty()) {
    const Branch shortest = branches.top();
    branches.pop();
    if (!isShortBranch (shortest.end))
      continue;
    if (size (path) > shortest.size) {
      push (shortest.end);
      continue;
    }
    for (std::size_t i = 1; i < path.size(); ++i)
      forest.removeEdge (path[i - 1], path[i]);
  }
}

} // namespace

std::vector<CrestEdge>
pruneBranches (const OrientedPoints& points,
               const std::vector<CrestEdge>& forest,
               std::size_t largest)
{
  Forest trees (forest);
  const auto count = [] (const std::vector<int>& path) {
    return static_cast<double> (path.size() - 1);
  };
  const std::size_t most = std::max<std::size_t> (1, largest);
  prune (points, static_cast<double> (most), most, count, trees);
  return trees.remaining (forest);
}

std::vector<CrestEdge>
pruneShortBranches (const OrientedPoints& points,
                    const std::vector<CrestEdge>& edges,
                    const std::vector<float>& limits)
{
  Forest graph (edges);
  const auto part_of_limit = [&] (const std::vector<int>& path) {
    return graph.length (points, path) / limits[graph.packed (path.back())];
  };
  prune (points, 1.0, points.size(), part_of_limit, graph);
  return graph.remaining (edges);
}

} // namespace crest
} // namespace pcl
