// SPDX-License-Identifier: BSD-3-Clause
// How far points are from a surface that is smooth at their own scale.
#pragma once

#include "base/scatter.h"

namespace pcl {
namespace crest {

/** Points that a quartic is fitted to: nine more than it has terms, and not many more,
 * as they have to be within a wave of what is narrow. */
constexpr std::size_t QUARTIC_POINTS = 24;

/** \brief Mean squared distance of the first points from a quartic height function that
 * is fitted to them by least squares, for its degrees of freedom, in the points' unit.
 *
 * A quartic follows a round crest down to the valleys on both sides, which a cubic does
 * not, and no sharp edge.
 *
 * \param[in] positions at least QUARTIC_POINTS, the nearest to the origin first
 * \param[in] normal the direction of heights
 */
double
quarticResidual (const Coordinates& positions, const Eigen::Vector3d& normal);

} // namespace crest
} // namespace pcl
