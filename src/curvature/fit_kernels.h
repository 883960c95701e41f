// SPDX-License-Identifier: BSD-3-Clause
// Least squares, four fits at a time.
#pragma once

#include <Eigen/Core>

#include "curvature/lanes.h"
#include "curvature/monomials.h"
#include "search/simd.h"

namespace pcl {
namespace crest {

/** \brief A sample of each fit: a value, as its height, at (u, v), with a weight. */
struct LaneSample {
  Lanes u, v, value, weight;

  /** \brief Makes it none of one of the fits. */
  void
  clear (int lane)
  {
    u[lane] = v[lane] = value[lane] = weight[lane] = 0.0;
  }
};

/** \brief A vector of each fit. */
struct LaneVector {
  Lanes x, y, z;

  /** \brief That of one of them. */
  Eigen::Vector3d
  operator[] (int lane) const
  {
    return {x[lane], y[lane], z[lane]};
  }

  void
  set (int lane, const Eigen::Vector3d& vector)
  {
    x[lane] = vector.x();
    y[lane] = vector.y();
    z[lane] = vector.z();
  }
};

/** \brief Quadrics z = 1/2 (a u^2 + 2 b u v + c v^2), in frames of the tangent plane.
 */
struct QuadricFit {
  /** unit vectors of the directions of u and v */
  LaneVector x, y;
  /** sums of u^2, u v, v^2 */
  Lanes uu, uv, vv;
  /** how far the three terms are from being dependent: 0 where they are, at most 1 */
  Lanes independence;
  /** principal curvatures and the direction of k1, positive where the surface is convex
   * seen from the side of the normal */
  Lanes k1, k2;
  LaneVector t1;
};

/** \brief Weighted sums over samples that the normal equations of a cubic height
 * function are made of.
 */
struct CubicSums {
  static constexpr int DEGREE = 3;
  static constexpr int TERMS = monomials (DEGREE);

  /** of the monomials, those of degree 0 being the weights */
  Lanes powers[monomials (2 * DEGREE)] = {};
  /** of z times the monomials */
  Lanes heights[TERMS] = {};
  Lanes squared_heights = {};
};

/** \brief Cubic height functions. */
struct CubicFit {
  /** of each monomial */
  Lanes coefficients[CubicSums::TERMS];
  /** weighted sum of squares that the cubic leaves; not finite where heights are no
   * function of the place, as seen along a face */
  Lanes residual;
};

/** \brief The inner loops, for some instructions: all give the same results. */
struct FitKernels {
  /** \brief Fits quadrics to the edges from points; zero edges count for nothing. */
  void (*fitQuadrics) (const LaneVector& normals,
                       const LaneVector* edges,
                       int count,
                       QuadricFit& fit);

  /** \brief Adds samples to sums. */
  void (*addHeights) (const LaneSample* samples, int count, CubicSums& sums);

  /** \brief Solves the normal equations. Samples on few lines leave some terms open:
   * these become zero.
   */
  void (*fitCubics) (const CubicSums& sums, CubicFit& fit);
};

/** \brief The portable ones where others are not available; SSE2 is as portable. */
const FitKernels&
fitKernels (Simd simd = bestSimd());

} // namespace crest
} // namespace pcl
