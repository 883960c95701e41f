// SPDX-License-Identifier: BSD-3-Clause
// Profile polynomials over the fits around a node, of eight nodes at a time.
#pragma once

#include "curvature/monomial_sums.h"
#include "search/simd.h"

namespace pcl {
namespace crest {

/** \brief A fit near each of the eight: from surface to surface, in units of the
 * window, and how much more its largest curvature is than that of the node, with its
 * squared standard error, times the window.
 */
struct NearFitRow {
  FloatVectorRow edge;
  FloatRow value;
  FloatRow squared_error;

  /** \brief Makes it none of a lane: it is outside of every window. */
  void
  clear (int lane)
  {
    constexpr float OUTSIDE = 1e3F;
    edge.x[lane] = edge.y[lane] = edge.z[lane] = OUTSIDE;
    value[lane] = squared_error[lane] = 0.0F;
  }
};

/** \brief Polynomials of u along t1 and v across it. */
struct ProfileRow {
  static constexpr int TERMS = 7;

  /** of 1, u, v, u^2, u v, v^2 and u v^2; not finite where there is nothing */
  FloatRow coefficients[TERMS];
  /** the second lowest and the second highest u in the window */
  FloatRow first_u, last_u;
  /** weighted mean */
  FloatRow squared_error;
  /** how many fits are in the window */
  FloatRow count;
};

/** \brief The inner loops, for some instructions: all give the same results. */
struct ProfileKernels {
  /** \brief Fits the values in a window.
   * \param[in] nodes, count the fits near each, itself among them
   * \param[in] normals, t1 of unit length
   * \param[in] elongation of the window along v; if it is not 1 there is a term u v^2,
   * whose coefficient else is 0
   * \param room for as many
   */
  void (*fit) (const NearFitRow* nodes,
               int count,
               const FloatVectorRow& normals,
               const FloatVectorRow& t1,
               float elongation,
               FrameRow* room,
               ProfileRow& profiles);
};

/** \brief The portable ones where others are not available; SSE2 is as portable. */
const ProfileKernels&
profileKernels (Simd simd = bestSimd());

} // namespace crest
} // namespace pcl
