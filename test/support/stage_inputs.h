// SPDX-License-Identifier: BSD-3-Clause
// Inputs of single stages, made without PCL's search and without the stages before.
#pragma once

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include "surface/surface_graph.h"

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

namespace oracle {

inline pcl::crest::PointView
viewOf (const pcl::PointCloud<pcl::PointNormal>& cloud)
{
  return {&cloud[0].x,
          &cloud[0].normal_x,
          sizeof (pcl::PointNormal) / sizeof (float),
          cloud.size()};
}

inline pcl::crest::OrientedPoints
pack (const pcl::PointCloud<pcl::PointNormal>& cloud)
{
  return pcl::crest::packOrientedPoints (viewOf (cloud));
}

/** \brief The k closest points by looking at all of them, the query point and those as
 * far away as the k-th included.
 */
inline pcl::crest::NeighborSearch
bruteForceSearch (const pcl::crest::OrientedPoints& points, std::size_t k)
{
  return [&points, k] (pcl::crest::index_t query,
                       std::vector<pcl::crest::index_t>& found) {
    std::vector<std::pair<double, pcl::crest::index_t>> all;
    for (std::size_t i = 0; i < points.size(); ++i)
      all.emplace_back (
          (points.positions[i] - points.positions[query]).cast<double>().squaredNorm(),
          static_cast<pcl::crest::index_t> (i));
    std::sort (all.begin(), all.end());
    const double limit =
        all[std::min (k, all.size()) - 1].first * (1.0 + pcl::crest::EQUIDISTANT);
    found.clear();
    for (const auto& [squared_distance, point] : all)
      if (squared_distance <= limit)
        found.push_back (point);
  };
}

/** \brief Samples in the order given, not packed: for graphs made by hand. */
inline pcl::crest::OrientedPoints
pointsAt (const std::vector<Eigen::Vector3f>& positions)
{
  pcl::crest::OrientedPoints points;
  points.positions = positions;
  points.normals.assign (positions.size(), Eigen::Vector3f::UnitZ());
  points.cloud_index.resize (positions.size());
  std::iota (points.cloud_index.begin(), points.cloud_index.end(), 0);
  points.packed_index = points.cloud_index;
  return points;
}

/** \brief The graph with exactly these edges. */
inline pcl::crest::SurfaceGraph
graphOf (std::size_t size, const std::vector<std::pair<int, int>>& edges)
{
  std::vector<std::vector<pcl::crest::index_t>> stars (size);
  for (const auto& [a, b] : edges) {
    stars[a].push_back (b);
    stars[b].push_back (a);
  }
  pcl::crest::SurfaceGraph graph;
  graph.offsets.push_back (0);
  for (auto& star : stars) {
    std::sort (star.begin(), star.end());
    graph.neighbors.insert (graph.neighbors.end(), star.begin(), star.end());
    graph.offsets.push_back (graph.neighbors.size());
  }
  graph.boundary.assign (size, 0);
  graph.spacing.assign (size, 1.0F);
  return graph;
}

} // namespace oracle
