// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "file_content.h"

namespace pcl {
namespace crest {

/** \brief Gives each point the mean of the normals of its faces, weighted by their
 * areas, on the side from which the corners run counter-clockwise.
 *
 * pcl::features::computeApproximateNormals will not do: it turns normals toward the
 * origin, whatever the faces say. A point of no face gets a zero normal.
 *
 * \return how many points have got a normal
 */
std::size_t
computeMeshNormals (FileContent& content);

} // namespace crest
} // namespace pcl
