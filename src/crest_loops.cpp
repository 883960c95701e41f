// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_crest/crest_loops.h>

#include "forest.h"

#include <functional>
#include <queue>
#include <tuple>

namespace pcl {
namespace crest {

namespace {

/** \brief Tells whether two points are near each other along a graph: A* up to a
 * distance, which ends at the first way that is short enough.
 */
class Reach {
public:
  Reach (const OrientedPoints& points, const Forest& graph)
  : points_ (points)
  , graph_ (graph)
  , distance_ (static_cast<std::size_t> (graph.size()), UNKNOWN)
  {}

  bool
  within (int from, int to, double limit)
  {
    std::priority_queue<Front, std::vector<Front>, std::greater<>> fronts;
    const auto reach = [&] (int v, double distance) {
      if (distance_[v] != UNKNOWN && distance_[v] <= distance)
        return;
      const double whole = distance + length (v, to);
      if (whole >= limit)
        return;
      if (distance_[v] == UNKNOWN)
        reached_.push_back (v);
      distance_[v] = distance;
      fronts.push ({whole, distance, v});
    };
    reach (from, 0.0);
    while (!fronts.empty() && distance_[to] == UNKNOWN) {
      const Front front = fronts.top();
      fronts.pop();
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

private:
  static constexpr double UNKNOWN = -1.0;
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

  double
  length (int v, int w) const
  {
    return points_.edge (graph_.packed (v), graph_.packed (w)).norm();
  }

  const OrientedPoints& points_;
  const Forest& graph_;
  std::vector<double> distance_;
  std::vector<int> reached_;
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
