// SPDX-License-Identifier: BSD-3-Clause
// Least squares, four fits at a time.
#pragma once

#include <Eigen/Core>

#include "curvature/lanes.h"
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

/** \brief The number of monomials u^a v^b of up to a degree. They are ordered by degree
 * and then by b: 1, u, v, u^2, u v, v^2, u^3...
 */
constexpr int
monomials (int degree)
{
  return (degree + 1) * (degree + 2) / 2;
}

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
  /** of the normal equations' matrix */
  LaneCholesky<CubicSums::TERMS> factor;
};

/** \brief Polynomials with the terms 1, u, u^2, v, u v, v^2, u v^2. */
struct ProfileFit {
  static constexpr int TERMS = 7;

  Lanes coefficients[TERMS];
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

  /** \brief The variance of x^2 r + 2 x y s + y^2 t, in units of that of a sample of
   * weight 1 under weights that are inverse variances; r, s, t are the second
   * derivatives of the cubics at the origin.
   */
  void (*bendVariance) (const CubicFit& fit,
                        const Lanes& x,
                        const Lanes& y,
                        Lanes& variance);

  /** \brief Fits values.
   * \param[in] bent whether there is a term u v^2; its coefficient is 0 if not
   */
  void (*fitProfiles) (const LaneSample* samples,
                       int count,
                       bool bent,
                       ProfileFit& fit);
};

/** \brief The portable ones where others are not available; SSE2 is as portable. */
const FitKernels&
fitKernels (Simd simd = bestSimd());

} // namespace crest
} // namespace pcl
