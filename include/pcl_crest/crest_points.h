// SPDX-License-Identifier: BSD-3-Clause
// Paper, section 4.3: crest point classification.
#pragma once

#include <pcl_crest/crest_profile.h>

namespace pcl {
namespace crest {

/** \brief The threshold M in 1 / (the cloud's unit)^2.
 *
 * M compares squared curvatures, so that a bare number means something only with its
 * unit of length. The paper names none; its figure 8 comes out with the cloud scaled to
 * a largest bounding box side of 10, which is therefore the unit unless
 * absolute_maximality: the labels are then the same in metres and in millimetres.
 */
PerType<double>
absoluteMaximality (const OrientedPoints& points, const Parameters& parameters);

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
