// SPDX-License-Identifier: BSD-3-Clause
#include "lines/crest_lines.h"

#include "lines/forest.h"

#include <algorithm>
#include <optional>
#include <unordered_map>

namespace pcl {
namespace crest {

namespace {

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

/** \brief Closes a line without junction if the spanning tree has cut a loop there;
 * returns whether it did.
 */
bool
closeLoop (const SurfaceGraph& graph,
           const std::vector<Membership>& membership,
           std::size_t largest_branch,
           CrestLine& line)
{
  if (line.polylines.size() != 1 ||
      line.size <= std::max<std::size_t> (2, largest_branch))
    return false;
  // A straight line, too, has a way back beside itself, but not with a quarter of its
  // points.
  std::vector<index_t>& points = line.polylines.front();
  const auto way =
      wayBack (graph, membership, points, std::min (largest_branch, line.size / 4));
  if (!way)
    return false;
  line.closed = true;
  line.size += way->size();
  points.insert (points.end(), way->begin(), way->end());
  points.push_back (points.front());
  return true;
}

/** \brief The lines in the order of their lowest points. */
std::vector<CrestLine>
followEdges (const OrientedPoints& points,
             const std::vector<CrestEdge>& edges,
             CrestType type)
{
  const Forest trees (edges);
  std::vector<CrestLine> lines;
  std::vector<bool> seen (static_cast<std::size_t> (trees.size()), false);
  for (int v = 0; v < trees.size(); ++v) {
    if (seen[v])
      continue;
    const std::vector<int> tree = trees.component (v, seen);
    CrestLine line;
    line.type = type;
    line.size = tree.size();
    for (const std::vector<int>& branch : trees.branches (tree)) {
      line.polylines.push_back (trees.packed (branch));
      line.length += polylineLength (points, line.polylines.back());
    }
    line.closed = line.polylines.size() == 1 &&
                  line.polylines[0].front() == line.polylines[0].back();
    lines.push_back (std::move (line));
  }
  return lines;
}

std::vector<CrestLine>
sortedBySize (std::vector<CrestLine> lines)
{
  std::stable_sort (
      lines.begin(), lines.end(), [] (const CrestLine& a, const CrestLine& b) {
        return a.size > b.size;
      });
  return lines;
}

} // namespace

std::vector<CrestLine>
traceLines (const OrientedPoints& points,
            const std::vector<CrestEdge>& edges,
            CrestType type)
{
  return sortedBySize (followEdges (points, edges, type));
}

std::vector<CrestLine>
traceLines (const OrientedPoints& points,
            const SurfaceGraph& graph,
            const std::vector<Membership>& membership,
            const std::vector<CrestEdge>& forest,
            CrestType type,
            std::size_t largest_branch)
{
  std::vector<CrestLine> lines = followEdges (points, forest, type);
  for (CrestLine& line : lines)
    if (closeLoop (graph, membership, largest_branch, line))
      line.length = polylineLength (points, line.polylines.front());
  return sortedBySize (std::move (lines));
}

LineSizes
lineSizes (const std::vector<CrestLine>& lines)
{
  LineSizes sizes;
  for (const CrestLine& line : lines)
    ++sizes[line.size];
  return sizes;
}

} // namespace crest
} // namespace pcl
