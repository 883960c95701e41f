// SPDX-License-Identifier: BSD-3-Clause
// Crest points told by their profiles: section 4.3 for the auto preset.
#pragma once

#include "crests/crest_profile.h"

namespace pcl {
namespace crest {

/** \brief Finds the points whose profile tells that they are on a crest, for the auto
 * preset: |k1| falls off to both sides by more than `confidence` standard errors, has
 * its maximum within the point's own part of the line, and is the larger curvature; and
 * the crest is sharper than a round rod but not narrower than samples can tell.
 */
std::vector<CrestType>
classifyCrestPoints (const SurfaceGraph& graph,
                     const std::vector<CrestProfile>& profiles,
                     double confidence);

/** \brief The points that may be crest points, at half the confidence and wherever
 * curvature cannot be told to be constant: too many to believe them by themselves, but
 * they are good where they continue what is certain.
 */
std::vector<CrestType>
likelyCrestPoints (const SurfaceGraph& graph,
                   const std::vector<CrestProfile>& profiles,
                   double confidence);

} // namespace crest
} // namespace pcl
