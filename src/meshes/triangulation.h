// SPDX-License-Identifier: BSD-3-Clause
// Polygons as triangles.
#pragma once

#include <pcl_crest/input.h>

#include "meshes/faces.h"

namespace pcl {
namespace crest {

/** \brief The triangles of all faces, each once, whichever way the others run. A
 * polygon, which need not be convex, is cut ear by ear (Meisters 1975) as it looks
 * along its normal; where it crosses itself, some of the cuts are as good as any.
 *
 * \param[in] cloud only its positions are used
 * \param[in] faces whose corners are finite points of the cloud
 */
PCL_CREST_EXPORT Faces
triangulate (const PointView& cloud, const Faces& faces);

} // namespace crest
} // namespace pcl
