// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_crest/crest_loops.h>

#include "forest.h"

#include <functional>
#include <queue>
#include <tuple>
#include <utility>

namespace pcl {
namespace crest {

namespace {

/** \brief Tells whether two points are near each other along a graph (Dijkstra's
 * algorithm, up to a distance).
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
      if (distance_[v] == UNKNOWN)
        reached_.push_back (v);
      distance_[v] = distance;
      fronts.emplace (distance, v);
    };
    reach (from, 0.0);
    bool found = false;
    while (!found && !fronts.empty()) {
      const auto [distance, v] = fronts.top();
      fronts.pop();
      found = v == to;
      if (distance > distance_[v])
        continue;
      for (const int w : graph_.neighbors (v)) {
        const double next = distance + length (v, w);
        if (next < limit)
          reach (w, next);
      }
    }
    for (const int v : reached_)
      distance_[v] = UNKNOWN;
    reached_.clear();
    return found;
  }

private:
  static constexpr double UNKNOWN = -1.0;
  using Front = std::pair<double, int>;

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
    return std::tie (e.type, e.squared_length, e.a, e.b) <
           std::tie (f.type, f.squared_length, f.a, f.b);
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
