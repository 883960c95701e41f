// SPDX-License-Identifier: BSD-3-Clause
#include "marching_cubes.h"

#include <cmath>
#include <map>

namespace oracle {

namespace {

using Eigen::Vector3d;

/** \brief Where a line of the grid crosses the surface, by how far it is from a place.
 */
std::vector<double>
crossings (const RayCaster& cast,
           const Vector3d& begin,
           const Vector3d& along,
           double length)
{
  std::vector<double> found;
  constexpr double BEYOND = 1e-6;
  for (double at = 0.0; at < length;) {
    at += cast (begin + at * along, along).distance;
    if (at < length)
      found.push_back (at);
    at += BEYOND * length;
  }
  return found;
}

} // namespace

pcl::PointCloud<pcl::PointXYZ>
marchingCubesVertices (const Scene& scene, double step, GridValues values)
{
  // No plane of the scene lies in one of the grid.
  const Vector3d low = scene.low - Vector3d (0.91, 0.73, 0.57) * step;
  const Eigen::Vector3i cells =
      ((scene.high - low) / step).array().ceil().cast<int>() + 1;
  pcl::PointCloud<pcl::PointXYZ> cloud;
  for (int axis = 0; axis < 3; ++axis) {
    const int first = (axis + 1) % 3;
    const int second = (axis + 2) % 3;
    const Vector3d along = Vector3d::Unit (axis);
    for (int i = 0; i < cells[first]; ++i)
      for (int j = 0; j < cells[second]; ++j) {
        const Vector3d begin =
            low + step * (i * Vector3d::Unit (first) + j * Vector3d::Unit (second));
        std::map<int, std::vector<double>> of_edge;
        for (const double at : crossings (scene.cast, begin, along, step * cells[axis]))
          of_edge[static_cast<int> (at / step)].push_back (at);
        for (const auto& [edge, places] : of_edge)
          if (places.size() % 2 == 1) {
            const double at =
                values == GridValues::SIDES ? step * (edge + 0.5) : places.front();
            const Eigen::Vector3f p = (begin + at * along).cast<float>();
            cloud.push_back ({p.x(), p.y(), p.z()});
          }
      }
  }
  return cloud;
}

} // namespace oracle
