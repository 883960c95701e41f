// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_crest/branch_pruning.h>

#include "forest.h"

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
  std::size_t size;
  double length;
  int end;

  bool
  operator> (const Branch& o) const
  {
    return std::tie (size, length, end) > std::tie (o.size, o.length, o.end);
  }
};

/** \brief Prunes the branches of up to `largest` points, shortest first. */
void
prune (const OrientedPoints& points, std::size_t largest, Forest& forest)
{
  // The path of a branch ends with its junction, and has one point more if too long.
  const auto pathOf = [&] (int end) {
    return forest.walk (end, forest.neighbors (end)[0], largest + 2);
  };
  const auto isShortBranch = [&] (const std::vector<int>& path) {
    return forest.isJunction (path.back()) && path.size() <= largest + 1;
  };
  std::priority_queue<Branch, std::vector<Branch>, std::greater<>> branches;
  const auto push = [&] (int end, const std::vector<int>& path) {
    branches.push (
        {path.size() - 1, polylineLength (points, forest.packed (path)), end});
  };

  for (int v = 0; v < forest.size(); ++v)
    if (forest.degree (v) == 1) {
      const std::vector<int> path = pathOf (v);
      if (isShortBranch (path))
        push (v, path);
    }
  while (!branches.empty()) {
    const Branch shortest = branches.top();
    branches.pop();
    const std::vector<int> path = pathOf (shortest.end);
    if (!isShortBranch (path))
      continue;
    if (path.size() - 1 > shortest.size) {
      push (shortest.end, path);
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
  prune (points, std::max<std::size_t> (1, largest), trees);
  return trees.remaining (forest);
}

} // namespace crest
} // namespace pcl
