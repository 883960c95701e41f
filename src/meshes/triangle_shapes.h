// SPDX-License-Identifier: BSD-3-Clause
// Areas and normals of triangles.
#pragma once

#include <pcl_crest/input.h>

#include "meshes/face_edges.h"

namespace pcl {
namespace crest {

/** \brief What triangles are by themselves. */
struct TriangleShapes {
  std::vector<double> areas;
  /** unit vectors, on the side from which the corners run counter-clockwise. A needle
   * so narrow that rounding decides where it looks has that of the triangle across its
   * longest side, and zero if that has none. */
  std::vector<Eigen::Vector3d> normals;
};

/** \param[in] cloud only its positions are used
 *
 * \param[in] triangles whose corners are finite points of the cloud
 * \param[in] edges of these
 */
PCL_CREST_EXPORT TriangleShapes
measureTriangles (const PointView& cloud,
                  const Faces& triangles,
                  const EdgeTable& edges);

/** \brief The longest side of a triangle. */
double
longestSide (const PointView& cloud, const Faces& triangles, std::size_t triangle);

/** \brief The diagonal of the box around the corners of all triangles. */
double
extentOf (const PointView& cloud, const Faces& triangles);

} // namespace crest
} // namespace pcl
