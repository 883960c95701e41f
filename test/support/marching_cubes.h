// SPDX-License-Identifier: BSD-3-Clause
// The vertices that marching cubes give a surface (Lorensen and Cline 1987).
#pragma once

#include "scene.h"

namespace oracle {

/** \brief What the grid knows of the surface. */
enum class GridValues {
  /** distances: a vertex is where the surface crosses an edge of the grid */
  DISTANCES,
  /** only which side is which, as of a segmented volume: a vertex is in the middle of
   * the edge, and the surface has the steps of the grid */
  SIDES
};

/** \brief A vertex for every edge of a grid that the surface crosses once, or an odd
 * number of times.
 * \param[in] step of the grid, in the unit of the scene; along its axes
 */
pcl::PointCloud<pcl::PointXYZ>
marchingCubesVertices (const Scene& scene, double step, GridValues values);

} // namespace oracle
