// SPDX-License-Identifier: BSD-3-Clause
// Lines without the noise of their points, for the auto preset.
#pragma once

#include "lines/crest_lines.h"

namespace pcl {
namespace crest {

/** \brief Where each polyline of a line runs, point by point. */
using LinePlaces = std::vector<std::vector<Eigen::Vector3f>>;

/** \brief Where lines run: the places that quadratics in the arc length, fitted to the
 * points within one radius to both sides, give the points of each polyline.
 *
 * Each point stands where its own profile has its maximum, give or take the error of
 * that; within the radius that a curvature was fitted over a crest cannot turn any
 * faster than a quadratic. Where that leaves points out of order, so that the line
 * turns back, they go to the middle of their neighbours. Ends of polylines stay where
 * they are, so that lines still meet, and so do the points of sharp edges, which may
 * bend at once; no point moves by more than two spacings. Each polyline is smoothed by
 * itself, whichever others there are.
 *
 * \param[in] lines whose polylines run through the points
 * \param[in] profiles for the radii
 * \param[in] graph for the spacing
 * \param[in] positions where each point's own profile has its crest
 * \param[in] threads how many, 0 for all processors
 */
std::vector<LinePlaces>
smoothLines (const std::vector<CrestLine>& lines,
             const std::vector<CrestProfile>& profiles,
             const SurfaceGraph& graph,
             const std::vector<Eigen::Vector3f>& positions,
             unsigned threads = 1);

/** \brief Enters where a line runs.
 * \param[in,out] positions those of all points
 */
void
movePoints (const CrestLine& line,
            const LinePlaces& places,
            std::vector<Eigen::Vector3f>& positions);

} // namespace crest
} // namespace pcl
