// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_crest/crest_graph.h>

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

/** \brief A forest whose edges can be walked along and removed. Points are numbered
 * locally, in the order of their packed indices.
 */
class Forest {
public:
  explicit Forest (const std::vector<CrestEdge>& edges)
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

  std::vector<index_t>
  packed (const std::vector<int>& path) const
  {
    std::vector<index_t> result;
    for (const int v : path)
      result.push_back (vertices_[v]);
    return result;
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

  std::vector<index_t> vertices_;
  std::vector<std::vector<int>> adjacency_;
};

} // namespace crest
} // namespace pcl
