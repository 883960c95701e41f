// SPDX-License-Identifier: BSD-3-Clause
// Room crests: paper, section 4.3, crest point classification.
//
// Curvatures go in, ridge and valley points come out: here by the threshold M, as in
// the paper; for the auto preset by profiles of the curvature (crest_profile.h,
// profile_points.h), with how far a crest stands out (crest_prominence.h) and where it
// runs between the samples (crest_feet.h). It knows nothing of lines.
#pragma once

#include <pcl_crest/parameters.h>

#include "curvature/quadric.h"

namespace pcl {
namespace crest {

/** \brief Finds how far k1 of each point is a maximum in its direction: with i and j
 * the neighbours whose directions are closest to t1 and to -t1, by how much k1^2
 * exceeds the larger of those of i and j. Nowhere a maximum, it is 0.
 *
 * Choices where the paper leaves them open:
 * - Closest is by angle in the tangent plane, of equals the lower index, and less than
 *   90 degrees off: where the surface ends there is no maximum.
 * - Where |k1| = |k2| with opposite signs no curvature is the largest (section 3), and
 *   the point is no crest point.
 *
 * \param[in] points, graph, curvature the results of the stages before
 * \param[in] workers a number of threads, 0 for all processors
 * \return in 1 / (the cloud's unit)^2
 */
std::vector<double>
measureMaximality (const OrientedPoints& points,
                   const SurfaceGraph& graph,
                   const std::vector<PrincipalCurvature>& curvature,
                   const Workers& workers);

/** \brief Finds the points that are a maximum by more than M. The sign of k1 tells
 * ridge from valley.
 *
 * \param[in] curvature of the points
 * \param[in] maximality of as many points
 * \param[in] threshold M for ridges and for valleys, in 1 / (the cloud's unit)^2
 */
std::vector<CrestType>
classifyCrestPoints (const std::vector<PrincipalCurvature>& curvature,
                     const std::vector<double>& maximality,
                     const PerType<double>& threshold);

} // namespace crest
} // namespace pcl
