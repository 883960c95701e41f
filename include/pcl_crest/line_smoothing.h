// SPDX-License-Identifier: BSD-3-Clause
// Lines without the noise of their points, for the auto preset.
#pragma once

#include <pcl_crest/crest_lines.h>

namespace pcl {
namespace crest {

/** \brief Replaces the points of each polyline by what quadratics in the arc length,
 * fitted to the points within one radius to both sides, say of their places.
 *
 * Each point stands where its own profile has its maximum, give or take the error of
 * that; within the radius that a curvature was fitted over a crest cannot turn any
 * faster than a quadratic. Ends of polylines stay where they are, so that lines still
 * meet, and so do the points of sharp edges, which may bend at once; no point moves by
 * more than two spacings. Each polyline is smoothed by itself, whichever others there
 * are.
 *
 * \param[in] lines whose polylines run through the points
 * \param[in] profiles for the radii
 * \param[in] graph for the spacing
 * \param[in] threads how many, 0 for all processors
 * \param[in,out] points where the lines run
 */
void
smoothLines (const std::vector<CrestLine>& lines,
             const std::vector<CrestProfile>& profiles,
             const SurfaceGraph& graph,
             unsigned threads,
             OrientedPoints& points);

} // namespace crest
} // namespace pcl
