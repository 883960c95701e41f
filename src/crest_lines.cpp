// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_crest/crest_lines.h>

#include "forest.h"

#include <algorithm>
#include <optional>
#include <unordered_map>

namespace pcl {
namespace crest {

namespace {

/** \brief The points that hang together with `start`, which it marks as seen. */
std::vector<int>
component (const Forest& forest, int start, std::vector<bool>& seen)
{
  std::vector<int> found{start};
  seen[start] = true;
  for (std::size_t i = 0; i < found.size(); ++i)
    for (const int w : forest.neighbors (found[i]))
      if (!seen[w]) {
        seen[w] = true;
        found.push_back (w);
      }
  std::sort (found.begin(), found.end());
  return found;
}

/** \brief The branches of a tree, each from the lower of its two end points. */
std::vector<std::vector<int>>
branchesOf (const Forest& forest, const std::vector<int>& tree)
{
  std::vector<std::vector<int>> branches;
  for (const int v : tree)
    if (forest.degree (v) != 2)
      for (const int w : forest.neighbors (v)) {
        std::vector<int> path = forest.walk (v, w, tree.size());
        if (path.back() > v)
          branches.push_back (std::move (path));
      }
  return branches;
}

/** \brief The shortest way back from the last point of a line to the first, through
 * members that are not on it: the points in between, if `most` of them are enough.
 */
std::optional<std::vector<index_t>>
wayBack (const SurfaceGraph& graph,
         const std::vector<Membership>& membership,
         const std::vector<index_t>& line,
         std::size_t most)
{
  std::unordered_map<index_t, index_t> reached_from;
  for (const index_t p : line)
    reached_from[p] = p;
  reached_from.erase (line.back());
  std::vector<index_t> front{line.front()};
  for (std::size_t between = 0; between <= most && !front.empty(); ++between) {
    std::vector<index_t> next;
    for (const index_t p : front)
      for (const index_t q : graph.star (p))
        if (membership[q] != Membership::OUTSIDE && reached_from.emplace (q, p).second)
          next.push_back (q);
    front.swap (next);
    if (reached_from.count (line.back()) == 0)
      continue;
    std::vector<index_t> way;
    for (index_t p = reached_from[line.back()]; p != line.front(); p = reached_from[p])
      way.push_back (p);
    return way;
  }
  return std::nullopt;
}

/** \brief Closes a line without junction if the spanning tree has cut a loop there. */
void
closeLoop (const SurfaceGraph& graph,
           const std::vector<Membership>& membership,
           std::size_t largest_branch,
           CrestLine& line)
{
  if (line.polylines.size() != 1 ||
      line.size <= std::max<std::size_t> (2, largest_branch))
    return;
  // A straight line, too, has a way back beside itself, but not with a quarter of its
  // points.
  std::vector<index_t>& points = line.polylines.front();
  const auto way =
      wayBack (graph, membership, points, std::min (largest_branch, line.size / 4));
  if (!way)
    return;
  line.closed = true;
  line.size += way->size();
  points.insert (points.end(), way->begin(), way->end());
  points.push_back (points.front());
}

} // namespace

std::vector<CrestLine>
traceLines (const OrientedPoints& points,
            const SurfaceGraph& graph,
            const std::vector<Membership>& membership,
            const std::vector<CrestEdge>& forest,
            CrestType type,
            std::size_t largest_branch)
{
  const Forest trees (forest);
  std::vector<CrestLine> lines;
  std::vector<bool> seen (static_cast<std::size_t> (trees.size()), false);
  for (int v = 0; v < trees.size(); ++v) {
    if (seen[v])
      continue;
    const std::vector<int> tree = component (trees, v, seen);
    CrestLine line;
    line.type = type;
    line.size = tree.size();
    for (const std::vector<int>& branch : branchesOf (trees, tree))
      line.polylines.push_back (trees.packed (branch));
    closeLoop (graph, membership, largest_branch, line);
    for (const std::vector<index_t>& polyline : line.polylines)
      line.length += polylineLength (points, polyline);
    lines.push_back (std::move (line));
  }
  std::stable_sort (
      lines.begin(), lines.end(), [] (const CrestLine& a, const CrestLine& b) {
        return a.size > b.size;
      });
  return lines;
}

LineSizes
lineSizes (const std::vector<CrestLine>& lines)
{
  LineSizes sizes;
  for (const CrestLine& line : lines)
    ++sizes[line.size];
  return sizes;
}

std::vector<CrestLine>
removeSmallLines (std::vector<CrestLine> lines, std::size_t min_size)
{
  lines.erase (
      std::remove_if (lines.begin(),
                      lines.end(),
                      [&] (const CrestLine& line) { return line.size < min_size; }),
      lines.end());
  return lines;
}

} // namespace crest
} // namespace pcl
