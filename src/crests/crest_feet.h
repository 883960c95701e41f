// SPDX-License-Identifier: BSD-3-Clause
// Where crests are between the samples, for the auto preset.
#pragma once

#include "crests/crest_profile.h"

namespace pcl {
namespace crest {

/** \brief The points moved to where their profiles have the maximum of |k1|: onto the
 * fitted surface, and along its parabola to the foot if that is within two spacings.
 * Lines through them are smooth, and points to the left and right of a crest come
 * together.
 */
OrientedPoints
moveToCrests (const OrientedPoints& points,
              const SurfaceGraph& graph,
              const std::vector<CrestProfile>& profiles);

} // namespace crest
} // namespace pcl
