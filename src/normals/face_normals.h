// SPDX-License-Identifier: BSD-3-Clause
// Normals of the vertices of meshes.
#pragma once

#include <pcl_crest/input.h>

#include "meshes/faces.h"

namespace pcl {
namespace crest {

/** \brief For each point the mean of the normals of its faces, weighted by their areas,
 * on the side from which the corners run counter-clockwise; zero for a point of no face
 * that has an area.
 *
 * pcl::features::computeApproximateNormals will not do: it turns normals toward the
 * origin, whatever the faces say.
 *
 * \param[in] cloud only its positions are used
 * \param[in] faces whose corners are points of the cloud
 */
PCL_CREST_EXPORT std::vector<Eigen::Vector3f>
faceNormals (const PointView& cloud, const Faces& faces);

} // namespace crest
} // namespace pcl
