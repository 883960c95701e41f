// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_crest/crest_graph.h>

#include <boost/container/small_vector.hpp>

#include <algorithm>
#include <iterator>

namespace pcl {
namespace crest {

inline double
polylineLength (const OrientedPoints& points, const std::vector<index_t>& polyline)
{
  double sum = 0.0;
  for (std::size_t i = 1; i < polyline.size(); ++i)
    sum += points.edge (polyline[i - 1], polyline[i]).norm();
  return sum;
}

/** \brief A forest, or with closed loops a graph, whose edges can be walked along,
 * added and removed. Points are numbered locally, in the order of their packed indices.
 */
class Forest {
public:
  /** Few have more. */
  using Neighbors = boost::container::small_vector<int, 4>;

  explicit Forest (const std::vector<CrestEdge>& edges)
  {
    index_t highest = -1;
    for (const CrestEdge& edge : edges)
      highest = std::max ({highest, edge.a, edge.b});
    local_.assign (static_cast<std::size_t> (highest) + 1, -1);
    for (const CrestEdge& edge : edges)
      local_[edge.a] = local_[edge.b] = 0;
    for (index_t p = 0; p <= highest; ++p)
      if (local_[p] == 0) {
        local_[p] = static_cast<int> (vertices_.size());
        vertices_.push_back (p);
      }
    adjacency_.resize (vertices_.size());
    for (const CrestEdge& edge : edges) {
      adjacency_[local_[edge.a]].push_back (local_[edge.b]);
      adjacency_[local_[edge.b]].push_back (local_[edge.a]);
    }
    for (Neighbors& neighbors : adjacency_)
      std::sort (neighbors.begin(), neighbors.end());
  }

  int
  size () const
  {
    return static_cast<int> (vertices_.size());
  }
  const Neighbors&
  neighbors (int v) const
  {
    return adjacency_[v];
  }
  std::size_t
  degree (int v) const
  {
    return adjacency_[v].size();
  }
  void
  removeEdge (int v, int w)
  {
    detach (v, w);
    detach (w, v);
  }

  void
  addEdge (index_t a, index_t b)
  {
    attach (local (a), local (b));
    attach (local (b), local (a));
  }

  /** \brief The place here of a point that has, or had, edges. */
  int
  local (index_t packed) const
  {
    return local_[packed];
  }

  index_t
  packed (int v) const
  {
    return vertices_[v];
  }

  /** \brief Walks from v over w to the next point that does not simply go on, back to
   * v, or until the path has `limit` points.
   */
  std::vector<int>
  walk (int v, int w, std::size_t limit) const
  {
    std::vector<int> path{v, w};
    while (degree (path.back()) == 2 && path.back() != v && path.size() < limit) {
      const Neighbors& next = adjacency_[path.back()];
      path.push_back (next[0] == path[path.size() - 2] ? next[1] : next[0]);
    }
    return path;
  }

  /** \brief The points that hang together with `start`, ascending; marks them seen. */
  std::vector<int>
  component (int start, std::vector<bool>& seen) const
  {
    std::vector<int> found{start};
    seen[start] = true;
    for (std::size_t i = 0; i < found.size(); ++i)
      for (const int w : adjacency_[found[i]])
        if (!seen[w]) {
          seen[w] = true;
          found.push_back (w);
        }
    std::sort (found.begin(), found.end());
    return found;
  }

  /** \brief The branches of a component between junctions and ends, each from the lower
   * of its two end points. A loop without junction is one branch whose first point is
   * repeated at its end.
   */
  std::vector<std::vector<int>>
  branches (const std::vector<int>& component) const
  {
    std::vector<std::vector<int>> found;
    for (const int v : component)
      if (degree (v) != 2)
        for (const int w : adjacency_[v]) {
          std::vector<int> path = walk (v, w, component.size() + 1);
          // A loop from a junction to itself is walked in both directions.
          if (path.back() > v || (path.back() == v && w < path[path.size() - 2]))
            found.push_back (std::move (path));
        }
    if (found.empty() && degree (component.front()) == 2)
      found.push_back (walk (
          component.front(), adjacency_[component.front()][0], component.size() + 1));
    return found;
  }

  std::vector<index_t>
  packed (const std::vector<int>& path) const
  {
    std::vector<index_t> result;
    result.reserve (path.size());
    for (const int v : path)
      result.push_back (vertices_[v]);
    return result;
  }

  /** \brief Of the edges that the forest was made of those not removed. */
  std::vector<CrestEdge>
  remaining (const std::vector<CrestEdge>& edges) const
  {
    std::vector<CrestEdge> kept;
    std::copy_if (
        edges.begin(), edges.end(), std::back_inserter (kept), [this] (const auto& e) {
          const Neighbors& stays = neighbors (local (e.a));
          return std::binary_search (stays.begin(), stays.end(), local (e.b));
        });
    return kept;
  }

private:
  void
  attach (int v, int w)
  {
    Neighbors& neighbors = adjacency_[v];
    neighbors.insert (std::upper_bound (neighbors.begin(), neighbors.end(), w), w);
  }

  void
  detach (int v, int w)
  {
    Neighbors& neighbors = adjacency_[v];
    neighbors.erase (std::find (neighbors.begin(), neighbors.end(), w));
  }

  std::vector<index_t> vertices_;
  /** of each packed point up to the highest its place here, or -1 */
  std::vector<int> local_;
  std::vector<Neighbors> adjacency_;
};

} // namespace crest
} // namespace pcl
