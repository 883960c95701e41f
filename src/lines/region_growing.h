// SPDX-License-Identifier: BSD-3-Clause
// Paper, section 4.4: region growing.
#pragma once

#include "crests/crest_profile.h"

namespace pcl {
namespace crest {

/** \brief What a point is to the crest graphs of one type. */
enum class Membership : std::uint8_t { OUTSIDE = 0, GROWN = 1, CREST = 2 };

/** \brief Grows the crest points of one type by the points that share an edge with
 * them and are not crest points of either type (section 4.4). Points without a
 * curvature are invalid and stay out.
 */
std::vector<Membership>
growRegions (const SurfaceGraph& graph,
             const std::vector<PrincipalCurvature>& curvature,
             const std::vector<CrestType>& crest_points,
             CrestType type);

/** \brief Grows crest points along the crests that they are on: by all likely crest
 * points that they are connected with through such (the hysteresis of Canny 1986), then
 * as in the paper by the neighbours of both, but only where these are near to a crest
 * of the type: with a foot within three spacings, and k1 of its sign.
 *
 * \param[in] likely_points of both types, as likelyCrestPoints finds them
 */
std::vector<Membership>
growAlongCrests (const SurfaceGraph& graph,
                 const std::vector<CrestProfile>& profiles,
                 const std::vector<CrestType>& crest_points,
                 const std::vector<CrestType>& likely_points,
                 CrestType type);

} // namespace crest
} // namespace pcl
