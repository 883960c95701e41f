// SPDX-License-Identifier: BSD-3-Clause
// Faces that share the corners at which they meet.
#pragma once

#include <pcl_crest/input.h>

#include "meshes/faces.h"

namespace pcl {
namespace crest {

/** \brief The faces with the first of the points at each place as their corners, where
 * places are the same up to the rounding of single precision: files repeat points for
 * each face, and compute those on a seam once for either side. Faces of less than three
 * corners, or of some that are not finite, are left out.
 *
 * \param[in] cloud only its positions are used
 * \param[in] faces whose corners are points of the cloud
 */
PCL_CREST_EXPORT Faces
shareCorners (const PointView& cloud, const Faces& faces);

} // namespace crest
} // namespace pcl
