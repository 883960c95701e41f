// SPDX-License-Identifier: BSD-3-Clause
// Cubic height functions over the nodes around a node, of eight nodes at a time.
#pragma once

#include "curvature/monomial_sums.h"
#include "search/simd.h"

#include <vector>

namespace pcl {
namespace crest {

/** \brief A neighbour of each of the eight: from the node to it, in units of the radius
 * of the fit, and the number of samples that it stands for, 0 where it is none.
 */
struct NodeRow {
  FloatVectorRow edge;
  FloatRow weight;
};

/** \brief What the fits tell, in units of their radii. */
struct ScaleFitRow {
  /** principal curvatures, positive where the surface is convex seen from the side of
   * the normal, and the direction of k1 */
  FloatRow k1, k2;
  FloatVectorRow t1;
  FloatVectorRow normal;
  /** height of the surface over the node, along the normal */
  FloatRow offset;
  /** of a sample from the surface, and of k1 because of it */
  FloatRow variance, k1_variance;
  /** 1 where there is a fit, else 0 */
  FloatRow valid;
};

/** \brief The inner loops, for some instructions: all give the same results. */
struct ScaleKernels {
  /** \brief Fits cubics, weighted by (1 - r^2)^2 and the weights, in frames that are
   * tilted to the tangent plane that was fitted as long as that changes.
   * \param[in] nodes, count the neighbours, of each node itself among them
   * \param[in] normals of unit length
   * \param room for as many
   */
  void (*fit) (const NodeRow* nodes,
               int count,
               const FloatVectorRow& normals,
               FrameRow* room,
               ScaleFitRow& fits);
};

/** \brief The portable ones where others are not available; SSE2 is as portable. */
const ScaleKernels&
scaleKernels (Simd simd = bestSimd());

} // namespace crest
} // namespace pcl
