// SPDX-License-Identifier: BSD-3-Clause
// What the spacing of samples tells of how they were taken.
#pragma once

#include "base/progress.h"
#include "normals/plane_fits.h"

namespace pcl {
namespace crest {

/** \brief Whether samples are spaced as the pixels or pulses of a sensor are: evenly in
 * the directions from its place, and the farther away the wider in space.
 * \param[in] place in the unit of the fits
 */
bool
areSpacedAsSeenFrom (const PlaneFits& fits,
                     const Eigen::Vector3f& place,
                     const Workers& workers);

/** \brief Whether samples are spaced as on a map: along x and y as evenly as in space,
 * whatever their heights.
 */
bool
areSpacedAsOnMap (const PlaneFits& fits, const Workers& workers);

/** \brief Whether seen from above, along z, they are a grid: rows and columns of
 * heights, and not an image, whose pixels lie further apart the farther they are.
 */
bool
areGridOfMap (const PlaneFits& fits, const Workers& workers);

} // namespace crest
} // namespace pcl
