// SPDX-License-Identifier: BSD-3-Clause
#include "lines/crest_loops.h"

#include "lines/forest.h"

#include <algorithm>
#include <functional>
#include <tuple>
#include <utility>

namespace pcl {
namespace crest {

namespace {

/** \brief Tells whether two points are near each other along a graph that grows: by the
 * way up and down a tree of what it was at first, which is short enough for most, else
 * by A* up to a distance, which ends at the first way that is.
 */
class Reach {
public:
  Reach (const OrientedPoints& points, const Forest& graph)
  : graph_ (graph), distance_ (static_cast<std::size_t> (graph.size()), UNKNOWN)
  {
    for (int v = 0; v < graph.size(); ++v)
      places_.push_back (points.positions[graph.packed (v)]);
    growTrees();
  }

  /** \brief Whether there is a way between two points that is shorter than a limit. */
  bool
  within (int from, int to, double limit)
  {
    return withinTwoEdges (from, to, limit) || withinTree (from, to, limit) ||
           search (from, to, limit);
  }

private:
  static constexpr double UNKNOWN = -1.0;
  static constexpr int NONE = -1;
  struct Front {
    /** the least that a way through the point can have */
    double whole;
    double distance;
    int point;

    bool
    operator> (const Front& o) const
    {
      return std::tie (whole, point) > std::tie (o.whole, o.point);
    }
  };

  /** \brief The same up to two edges, as most ways have, for a fraction of the time. */
  bool
  withinTwoEdges (int from, int to, double limit) const
  {
    const Forest::Neighbors ends = graph_.neighbors (to);
    const auto reaches = [&] (int v) {
      return std::binary_search (ends.begin(), ends.end(), v);
    };
    if (reaches (from))
      return length (from, to) < limit;
    const Forest::Neighbors steps = graph_.neighbors (from);
    return std::any_of (steps.begin(), steps.end(), [&] (int v) {
      return reaches (v) && length (from, v) + length (v, to) < limit;
    });
  }

  /** \brief Gives every point but the first of each part the one before it on the way
   * from there.
   */
  void
  growTrees ()
  {
    parents_.assign (places_.size(), NONE);
    depths_.assign (places_.size(), NONE);
    std::vector<int> reached;
    for (int root = 0; root < graph_.size(); ++root) {
      if (depths_[root] != NONE)
        continue;
      depths_[root] = 0;
      reached.assign (1, root);
      for (std::size_t i = 0; i < reached.size(); ++i)
        for (const int w : graph_.neighbors (reached[i]))
          if (depths_[w] == NONE) {
            depths_[w] = depths_[reached[i]] + 1;
            parents_[w] = reached[i];
            reached.push_back (w);
          }
    }
  }

  /** \brief The same along the trees. */
  bool
  withinTree (int from, int to, double limit) const
  {
    double way = 0.0;
    while (from != to && way < limit) {
      if (depths_[from] < depths_[to])
        std::swap (from, to);
      if (parents_[from] == NONE)
        return false;
      way += length (from, parents_[from]);
      from = parents_[from];
    }
    return way < limit;
  }

  bool
  search (int from, int to, double limit)
  {
    fronts_.clear();
    const auto reach = [&] (int v, double distance) {
      if (distance_[v] != UNKNOWN && distance_[v] <= distance)
        return;
      const double whole = distance + length (v, to);
      if (whole >= limit)
        return;
      if (distance_[v] == UNKNOWN)
        reached_.push_back (v);
      distance_[v] = distance;
      fronts_.push_back ({whole, distance, v});
      std::push_heap (fronts_.begin(), fronts_.end(), std::greater<>());
    };
    reach (from, 0.0);
    while (!fronts_.empty() && distance_[to] == UNKNOWN) {
      std::pop_heap (fronts_.begin(), fronts_.end(), std::greater<>());
      const Front front = fronts_.back();
      fronts_.pop_back();
      if (front.distance == distance_[front.point])
        for (const int w : graph_.neighbors (front.point))
          reach (w, front.distance + length (front.point, w));
    }
    const bool found = distance_[to] != UNKNOWN;
    for (const int v : reached_)
      distance_[v] = UNKNOWN;
    reached_.clear();
    return found;
  }

  double
  length (int v, int w) const
  {
    return (places_[v].cast<double>() - places_[w].cast<double>()).norm();
  }

  const Forest& graph_;
  /** side by side, which those of the cloud are not */
  std::vector<Eigen::Vector3f> places_;
  std::vector<int> parents_;
  std::vector<int> depths_;
  std::vector<double> distance_;
  std::vector<int> reached_;
  /** a heap, the nearest first */
  std::vector<Front> fronts_;
};

} // namespace

std::vector<CrestEdge>
closeLoops (const OrientedPoints& points,
            std::vector<CrestEdge> edges,
            const std::vector<float>& limits,
            std::vector<CrestEdge> forest)
{
  std::sort (edges.begin(), edges.end(), [] (const CrestEdge& e, const CrestEdge& f) {
    return std::tie (e.type, e.length, e.a, e.b) <
           std::tie (f.type, f.length, f.a, f.b);
  });
  Forest graph (forest);
  Reach reach (points, graph);
  // The ends of an edge of the forest are near each other along that edge.
  for (const CrestEdge& edge : edges) {
    const double limit = std::max (limits[edge.a], limits[edge.b]);
    if (reach.within (graph.local (edge.a), graph.local (edge.b), limit))
      continue;
    graph.addEdge (edge.a, edge.b);
    forest.push_back (edge);
  }
  return forest;
}

} // namespace crest
} // namespace pcl
