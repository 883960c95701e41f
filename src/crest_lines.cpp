// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_crest/crest_lines.h>

#include <algorithm>
#include <iterator>
#include <optional>
#include <queue>
#include <tuple>
#include <unordered_map>

namespace pcl {
namespace crest {

namespace {

double
distance (const OrientedPoints& points, index_t a, index_t b)
{
  return (points.positions[b] - points.positions[a]).cast<double>().norm();
}

double
polylineLength (const OrientedPoints& points, const std::vector<index_t>& polyline)
{
  double sum = 0.0;
  for (std::size_t i = 1; i < polyline.size(); ++i)
    sum += distance (points, polyline[i - 1], polyline[i]);
  return sum;
}

/** \brief A forest whose edges can be walked along and removed. Points are numbered
 * locally, in the order of their packed indices.
 */
class Forest {
public:
  Forest (const OrientedPoints& points, const std::vector<CrestEdge>& edges)
  : points_ (points)
  {
    vertices_.reserve (2 * edges.size());
    for (const CrestEdge& edge : edges) {
      vertices_.push_back (edge.a);
      vertices_.push_back (edge.b);
    }
    std::sort (vertices_.begin(), vertices_.end());
    vertices_.erase (std::unique (vertices_.begin(), vertices_.end()), vertices_.end());
    adjacency_.resize (vertices_.size());
    for (const CrestEdge& edge : edges) {
      const int a = local (edge.a);
      const int b = local (edge.b);
      adjacency_[a].push_back (b);
      adjacency_[b].push_back (a);
    }
    for (std::vector<int>& neighbors : adjacency_)
      std::sort (neighbors.begin(), neighbors.end());
  }

  int
  size () const
  {
    return static_cast<int> (vertices_.size());
  }
  index_t
  packed (int v) const
  {
    return vertices_[v];
  }
  const std::vector<int>&
  neighbors (int v) const
  {
    return adjacency_[v];
  }
  std::size_t
  degree (int v) const
  {
    return adjacency_[v].size();
  }
  bool
  isJunction (int v) const
  {
    return degree (v) > 2;
  }
  void
  removeEdge (int v, int w)
  {
    detach (v, w);
    detach (w, v);
  }

  /** \brief Walks from v over w to the next point that does not simply go on, or until
   * the path has `limit` points.
   */
  std::vector<int>
  walk (int v, int w, std::size_t limit) const
  {
    std::vector<int> path{v, w};
    while (degree (path.back()) == 2 && path.size() < limit) {
      const std::vector<int>& next = adjacency_[path.back()];
      path.push_back (next[0] == path[path.size() - 2] ? next[1] : next[0]);
    }
    return path;
  }

  double
  length (const std::vector<int>& path) const
  {
    double sum = 0.0;
    for (std::size_t i = 1; i < path.size(); ++i)
      sum += distance (points_, packed (path[i - 1]), packed (path[i]));
    return sum;
  }

  /** \brief Of the edges that the forest was made of those not removed: a removed
   * branch leaves its points without edges.
   */
  std::vector<CrestEdge>
  remaining (const std::vector<CrestEdge>& edges) const
  {
    std::vector<CrestEdge> kept;
    std::copy_if (
        edges.begin(), edges.end(), std::back_inserter (kept), [this] (const auto& e) {
          return degree (local (e.a)) > 0 && degree (local (e.b)) > 0;
        });
    return kept;
  }

private:
  int
  local (index_t packed) const
  {
    return static_cast<int> (
        std::lower_bound (vertices_.begin(), vertices_.end(), packed) -
        vertices_.begin());
  }

  void
  detach (int v, int w)
  {
    std::vector<int>& neighbors = adjacency_[v];
    neighbors.erase (std::find (neighbors.begin(), neighbors.end(), w));
  }

  const OrientedPoints& points_;
  std::vector<index_t> vertices_;
  std::vector<std::vector<int>> adjacency_;
};

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
prune (Forest& forest, std::size_t largest)
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
    branches.push ({path.size() - 1, forest.length (path), end});
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

std::vector<CrestEdge>
pruneBranches (const OrientedPoints& points,
               const std::vector<CrestEdge>& forest,
               std::size_t largest)
{
  Forest trees (points, forest);
  prune (trees, 1);
  prune (trees, largest);
  return trees.remaining (forest);
}

std::vector<CrestLine>
traceLines (const OrientedPoints& points,
            const SurfaceGraph& graph,
            const std::vector<Membership>& membership,
            const std::vector<CrestEdge>& forest,
            CrestType type,
            std::size_t largest_branch)
{
  const Forest trees (points, forest);
  std::vector<CrestLine> lines;
  std::vector<bool> seen (static_cast<std::size_t> (trees.size()), false);
  for (int v = 0; v < trees.size(); ++v) {
    if (seen[v])
      continue;
    const std::vector<int> tree = component (trees, v, seen);
    CrestLine line;
    line.type = type;
    line.size = tree.size();
    for (const std::vector<int>& branch : branchesOf (trees, tree)) {
      std::vector<index_t>& polyline = line.polylines.emplace_back();
      for (const int w : branch)
        polyline.push_back (trees.packed (w));
    }
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
