// SPDX-License-Identifier: BSD-3-Clause
// Room curvature: paper, section 4.2, curvature approximation.
//
// Samples and their graph go in, principal curvatures come out: here from the quadric
// of each star (Hamann 1993), as in the paper; in scale_fit.h from cubics at a scale,
// with their errors, over the averaged samples of pyramid.h. It knows nothing of
// crests.
#pragma once

#include <pcl_crest/types.h>

#include "search/simd.h"
#include "surface/surface_graph.h"

namespace pcl {
namespace crest {

/** \brief Fits the quadric z = 1/2 (a u^2 + 2 b u v + c v^2) to the star of a point by
 * least squares, in the frame of its normal (Hamann 1993), and returns its curvatures
 * and directions at the point.
 *
 * The quadric has no linear terms: it is tangent to the plane of the given normal, as
 * the paper has it. A star of fewer than three points, or whose projections lie on one
 * or two lines through the point, does not determine it.
 */
PrincipalCurvature
fitQuadric (const OrientedPoints& points, index_t point, const Star& star);

/** \brief The principal curvatures at every point of the graph.
 * \param[in] simd instructions to use, which change nothing but time
 */
std::vector<PrincipalCurvature>
estimateCurvature (const OrientedPoints& points,
                   const SurfaceGraph& graph,
                   const Workers& workers,
                   Simd simd = bestSimd());

} // namespace crest
} // namespace pcl
