// SPDX-License-Identifier: BSD-3-Clause
// Samples that cannot be anywhere.
#pragma once

#include <Eigen/Core>

#include <vector>

namespace pcl {
namespace crest {

/** \brief Whether positions are those of a grid along the axes: so few different
 * coordinates on each that these are half a spacing apart or more, as vertices of
 * segmented volumes, centres of voxels and roundly written coordinates are.
 * \param[in] positions distinct and finite
 * \param[in] spacing of them
 */
bool
lieOnGrid (const std::vector<Eigen::Vector3f>& positions, double spacing);

} // namespace crest
} // namespace pcl
