// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>

#include "curvature/fit_kernels.h"

#include <algorithm>
#include <cmath>

namespace pcl {
namespace crest {

/** \brief A cubic height function where the node is, lengths in units of the radius. */
struct LocalCubic {
  double offset = 0.0;
  /** first and second derivatives */
  double p = 0.0, q = 0.0, r = 0.0, s = 0.0, t = 0.0;
  double residual = 0.0;
  double weight = 0.0;
  bool valid = false;

  LocalCubic() = default;

  LocalCubic (const CubicSums& sums, const CubicFit& fit, int lane)
  : offset (fit.coefficients[0][lane])
  , p (fit.coefficients[1][lane])
  , q (fit.coefficients[2][lane])
  , r (2.0 * fit.coefficients[3][lane])
  , s (fit.coefficients[4][lane])
  , t (2.0 * fit.coefficients[5][lane])
  , residual (std::max (0.0, fit.residual[lane]))
  , weight (sums.powers[0][lane])
  {
    // On a line but for rounding there is no surface.
    constexpr double ROUNDING = 1e-6;
    constexpr int SECOND = monomials (1);
    const double uu = sums.powers[SECOND][lane];
    const double uv = sums.powers[SECOND + 1][lane];
    const double vv = sums.powers[SECOND + 2][lane];
    valid = uu * vv - uv * uv > ROUNDING * (uu + vv) * (uu + vv);
    for (const Lanes& coefficient : fit.coefficients)
      valid = valid && std::isfinite (coefficient[lane]);
  }
};

/** \brief Axes of a tangent plane, and its normal. */
struct Frame {
  Eigen::Vector3d x, y, n;

  Frame() = default;

  explicit Frame (const Eigen::Vector3d& normal)
  : x (normal.unitOrthogonal()), y (normal.cross (x)), n (normal)
  {}
};

/** \brief The curvatures and direction (in the frame's x and y) of a height function.
 */
struct Principal {
  double k1, k2, x, y;

  Principal() = default;

  explicit Principal (const LocalCubic& cubic)
  {
    const double p = cubic.p;
    const double q = cubic.q;
    const double norm = std::sqrt (1.0 + p * p + q * q);
    // The height falls where the surface is convex: hence the signs.
    const double L = -cubic.r / norm;
    const double M = -cubic.s / norm;
    const double N = -cubic.t / norm;
    const double E = 1.0 + p * p;
    const double F = p * q;
    const double G = 1.0 + q * q;
    const double area = E * G - F * F;
    const double mean = (L * G - 2.0 * M * F + N * E) / (2.0 * area);
    const double gauss = (L * N - M * M) / area;
    const double half = std::sqrt (std::max (0.0, mean * mean - gauss));
    k1 = mean >= 0.0 ? mean + half : mean - half;
    k2 = mean >= 0.0 ? mean - half : mean + half;
    // Of the two rows of II - k1 I the longer gives the direction safely.
    x = M - k1 * F;
    y = k1 * E - L;
    const double other_x = N - k1 * G;
    const double other_y = k1 * F - M;
    if (other_x * other_x + other_y * other_y > x * x + y * y) {
      x = other_x;
      y = other_y;
    }
    const double length = std::hypot (x, y);
    x = length > 0.0 ? x / length : 1.0; // umbilic: any direction is principal
    y = length > 0.0 ? y / length : 0.0;
  }
};

} // namespace crest
} // namespace pcl
