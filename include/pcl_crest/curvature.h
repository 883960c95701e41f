// SPDX-License-Identifier: BSD-3-Clause
// Paper, section 4.2: curvature approximation.
#pragma once

#include <pcl_crest/search/simd.h>
#include <pcl_crest/surface_graph.h>

namespace pcl {
namespace crest {

/** \brief The principal curvatures at a point, in 1 / (the cloud's unit).
 *
 * k1 is the larger in absolute value (section 3). Curvature is positive where the
 * surface is convex seen from the side that the normal points to, so that ridges are
 * positive with outward normals. t1 is the unit direction of k1 in the tangent plane;
 * its sign means nothing.
 */
struct PrincipalCurvature {
  float k1;
  float k2;
  Eigen::Vector3f t1;
  /** false where the star does not determine a quadric; k1 and k2 are then 0 */
  bool valid;
};

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
