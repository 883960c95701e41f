// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "lines/spanning_forest.h"

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
  /** \brief The neighbours of a point, ascending, until an edge is added. */
  struct Neighbors {
    const int* first;
    const int* last;

    const int*
    begin () const
    {
      return first;
    }
    const int*
    end () const
    {
      return last;
    }
    std::size_t
    size () const
    {
      return static_cast<std::size_t> (last - first);
    }
    int
    operator[] (std::size_t i) const
    {
      return first[i];
    }
  };

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
    rows_.assign (vertices_.size(), Row{0, 0, 0});
    for (const CrestEdge& edge : edges) {
      ++rows_[local_[edge.a]].room;
      ++rows_[local_[edge.b]].room;
    }
    std::size_t begin = 0;
    for (Row& row : rows_) {
      row.begin = begin;
      begin += row.room;
    }
    adjacency_.resize (begin);
    for (const CrestEdge& edge : edges) {
      append (rows_[local_[edge.a]], local_[edge.b]);
      append (rows_[local_[edge.b]], local_[edge.a]);
    }
    for (const Row& row : rows_)
      std::sort (beginOf (row), beginOf (row) + row.size);
  }

  int
  size () const
  {
    return static_cast<int> (vertices_.size());
  }
  Neighbors
  neighbors (int v) const
  {
    const int* const first = adjacency_.data() + rows_[v].begin;
    return {first, first + rows_[v].size};
  }
  std::size_t
  degree (int v) const
  {
    return rows_[v].size;
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
      const Neighbors next = neighbors (path.back());
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
      for (const int w : neighbors (found[i]))
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
        for (const int w : neighbors (v)) {
          std::vector<int> path = walk (v, w, component.size() + 1);
          // A loop from a junction to itself is walked in both directions.
          if (path.back() > v || (path.back() == v && w < path[path.size() - 2]))
            found.push_back (std::move (path));
        }
    if (found.empty() && degree (component.front()) == 2)
      found.push_back (walk (
          component.front(), neighbors (component.front())[0], component.size() + 1));
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
          const Neighbors stays = neighbors (local (e.a));
          return std::binary_search (stays.begin(), stays.end(), local (e.b));
        });
    return kept;
  }

private:
  /** \brief The neighbours of a point: `size` of them, with room for more. */
  struct Row {
    std::size_t begin;
    std::size_t size;
    std::size_t room;
  };

  int*
  beginOf (const Row& row)
  {
    return adjacency_.data() + row.begin;
  }

  void
  append (Row& row, int w)
  {
    beginOf (row)[row.size++] = w;
  }

  void
  attach (int v, int w)
  {
    Row& row = rows_[v];
    if (row.size == row.room) {
      // It moves to where there is room; what it leaves behind is little, as few edges
      // are added.
      const std::size_t begin = adjacency_.size();
      row.room = 2 * row.size + 1;
      adjacency_.resize (begin + row.room);
      std::copy_n (beginOf (row), row.size, adjacency_.data() + begin);
      row.begin = begin;
    }
    append (row, w);
    int* const end = beginOf (row) + row.size;
    std::rotate (std::upper_bound (beginOf (row), end - 1, w), end - 1, end);
  }

  void
  detach (int v, int w)
  {
    Row& row = rows_[v];
    int* const end = beginOf (row) + row.size;
    int* const removed = std::find (beginOf (row), end, w);
    std::copy (removed + 1, end, removed);
    --row.size;
  }

  std::vector<index_t> vertices_;
  /** of each packed point up to the highest its place here, or -1 */
  std::vector<int> local_;
  std::vector<Row> rows_;
  /** the neighbours of all points, row by row */
  std::vector<int> adjacency_;
};

} // namespace crest
} // namespace pcl
