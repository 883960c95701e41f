// SPDX-License-Identifier: BSD-3-Clause
#include "curvature/fit_kernels.h"

#include <cmath>

namespace pcl {
namespace crest {

namespace {

PCL_CREST_INLINE void
dot (const LaneVector& a, const LaneVector& b, Lanes& result)
{
  result = a.x * b.x + a.y * b.y + a.z * b.z;
}

/** \brief Two axes across unit vectors (Duff et al. 2017). Those of the opposite vector
 * are their exact mirror image.
 */
PCL_CREST_INLINE void
findAxes (const LaneVector& n, LaneVector& x, LaneVector& y)
{
  Lanes sign;
  for (int lane = 0; lane < LANES; ++lane)
    sign[lane] = std::copysign (1.0, n.z[lane]);
  const Lanes a = -1.0 / (sign + n.z);
  const Lanes b = n.x * n.y * a;
  x = {1.0 + sign * n.x * n.x * a, sign * b, -sign * n.x};
  y = {b, sign + n.y * n.y * a, -n.y};
}

/** \brief Principal curvatures of the quadrics with the shape matrices [a b; b c]. */
PCL_CREST_INLINE void
findPrincipal (const Lanes& a, const Lanes& b, const Lanes& c, QuadricFit& fit)
{
  const Lanes mean = 0.5 * (a + c);
  const Lanes difference = 0.5 * (a - c);
  Lanes radius = difference * difference + b * b;
  takeRoots (radius);
  const Lanes away = mean >= 0.0 ? radius : -radius;
  fit.k1 = mean + away;
  fit.k2 = mean - away;
  // Of the two rows of (shape matrix - k1) the longer gives the direction safely.
  const Lanes to_a = fit.k1 - a;
  const Lanes to_c = fit.k1 - c;
  const LaneMask second = to_c * to_c > to_a * to_a;
  Lanes u = second ? to_c : b;
  Lanes v = second ? b : to_a;
  Lanes length = u * u + v * v;
  takeRoots (length);
  const LaneMask umbilic = length == 0.0; // any direction is principal
  u = umbilic ? Lanes{} + 1.0 : u / length;
  v = umbilic ? Lanes{} : v / length;
  fit.t1 = {
      u * fit.x.x + v * fit.y.x, u * fit.x.y + v * fit.y.y, u * fit.x.z + v * fit.y.z};
}

PCL_CREST_INLINE void
fitQuadrics (const LaneVector& normals,
             const LaneVector* edges,
             int count,
             QuadricFit& fit)
{
  findAxes (normals, fit.x, fit.y);
  Lanes uu = {};
  Lanes uv = {};
  Lanes vv = {};
  Lanes zz = {};
  Lanes uuuu = {};
  Lanes uuuv = {};
  Lanes uuvv = {};
  Lanes uvvv = {};
  Lanes vvvv = {};
  Lanes zuu = {};
  Lanes zuv = {};
  Lanes zvv = {};
  for (int i = 0; i < count; ++i) {
    Lanes u;
    Lanes v;
    Lanes z;
    dot (edges[i], fit.x, u);
    dot (edges[i], fit.y, v);
    dot (edges[i], normals, z);
    const Lanes a = u * u;
    const Lanes b = u * v;
    const Lanes c = v * v;
    uu += a;
    uv += b;
    vv += c;
    zz += z * z;
    uuuu += a * a;
    uuuv += a * b;
    uuvv += a * c;
    uvvv += b * c;
    vvvv += c * c;
    zuu += z * a;
    zuv += z * b;
    zvv += z * c;
  }
  fit.uu = uu;
  fit.uv = uv;
  fit.vv = vv;
  // In units of the star's size no product is too large or too small for a number.
  const Lanes squared_unit = uu + vv + zz;
  Lanes unit = squared_unit;
  takeRoots (unit);
  // Normal equations of (a, b, c) with the terms u^2 / 2, u v, v^2 / 2.
  const Lanes products = 1.0 / (squared_unit * squared_unit);
  const Lanes aa = 0.25 * products * uuuu;
  const Lanes ab = 0.5 * products * uuuv;
  const Lanes ac = 0.25 * products * uuvv;
  const Lanes bb = products * uuvv;
  const Lanes bc = 0.5 * products * uvvv;
  const Lanes cc = 0.25 * products * vvvv;
  const Lanes heights = products * unit;
  const Lanes za = 0.5 * heights * zuu;
  const Lanes zb = heights * zuv;
  const Lanes zc = 0.5 * heights * zvv;
  const Lanes minor_aa = bb * cc - bc * bc;
  const Lanes minor_ab = ac * bc - ab * cc;
  const Lanes minor_ac = ab * bc - ac * bb;
  const Lanes minor_bb = aa * cc - ac * ac;
  const Lanes minor_bc = ab * ac - aa * bc;
  const Lanes minor_cc = aa * bb - ab * ab;
  const Lanes determinant = aa * minor_aa + ab * minor_ab + ac * minor_ac;
  fit.independence = determinant / (aa * bb * cc);
  // The height falls where the surface is convex: hence the signs.
  const Lanes inverse = -1.0 / (determinant * unit);
  findPrincipal (inverse * (minor_aa * za + minor_ab * zb + minor_ac * zc),
                 inverse * (minor_ab * za + minor_bb * zb + minor_bc * zc),
                 inverse * (minor_ac * za + minor_bc * zb + minor_cc * zc),
                 fit);
}

constexpr int DEGREE = CubicSums::DEGREE;

/** \brief The sum of the product of two terms. */
template <int N>
PCL_CREST_INLINE const Lanes&
product (const Lanes (&powers)[N], const Monomial& s, const Monomial& t)
{
  return powers[placeOf (s.a + t.a, s.b + t.b)];
}

PCL_CREST_INLINE void
addHeights (const LaneSample* samples, int count, CubicSums& sums)
{
  constexpr int POWERS = monomials (2 * DEGREE);
  CubicSums s = sums;
  for (int i = 0; i < count; ++i) {
    const LaneSample& sample = samples[i];
    Lanes powers[POWERS];
    powers[0] = sample.weight;
#pragma GCC unroll 6
    for (int degree = 1; degree <= 2 * DEGREE; ++degree) {
#pragma GCC unroll 6
      for (int b = 0; b < degree; ++b)
        powers[placeOf (degree - b, b)] =
            powers[placeOf (degree - 1 - b, b)] * sample.u;
      powers[placeOf (0, degree)] = powers[placeOf (0, degree - 1)] * sample.v;
    }
#pragma GCC unroll 10
    for (int j = 0; j < CubicSums::TERMS; ++j)
      s.heights[j] += sample.value * powers[j];
    s.squared_heights += sample.value * sample.value * sample.weight;
#pragma GCC unroll 28
    for (int j = 0; j < POWERS; ++j)
      s.powers[j] += powers[j];
  }
  sums = s;
}

PCL_CREST_INLINE void
fitCubics (const CubicSums& sums, CubicFit& fit)
{
  constexpr int N = CubicSums::TERMS;
  constexpr double OPEN = 1e-9;
  using Matrix = LaneCholesky<N>;
  Matrix matrix;
  Lanes x[N];
#pragma GCC unroll 10
  for (int i = 0; i < N; ++i) {
    x[i] = sums.heights[i];
#pragma GCC unroll 10
    for (int j = 0; j <= i; ++j)
      matrix.factor[Matrix::at (i, j)] =
          product (sums.powers, CUBIC_TERMS[i], CUBIC_TERMS[j]);
    matrix.factor[Matrix::at (i, i)] += OPEN * sums.powers[0];
  }
  matrix.decompose();
  matrix.solveLower (x);
  fit.residual = sums.squared_heights;
  for (int i = 0; i < N; ++i)
    fit.residual -= x[i] * x[i];
  matrix.solveUpper (x);
  for (int i = 0; i < N; ++i)
    fit.coefficients[i] = x[i];
}

// The same once for each set of instructions: what is inline becomes part of functions
// for it.
#define PCL_CREST_TARGET_portable
#define PCL_CREST_TARGET_avx2 __attribute__ ((target ("avx2")))
#define PCL_CREST_FIT_KERNELS(NAME)                                                    \
  namespace NAME {                                                                     \
  PCL_CREST_TARGET_##NAME void                                                         \
  fitQuadrics (const LaneVector& normals,                                              \
               const LaneVector* edges,                                                \
               int count,                                                              \
               QuadricFit& fit)                                                        \
  {                                                                                    \
    crest::fitQuadrics (normals, edges, count, fit);                                   \
  }                                                                                    \
  PCL_CREST_TARGET_##NAME void                                                         \
  addHeights (const LaneSample* samples, int count, CubicSums& sums)                   \
  {                                                                                    \
    crest::addHeights (samples, count, sums);                                          \
  }                                                                                    \
  PCL_CREST_TARGET_##NAME void                                                         \
  fitCubics (const CubicSums& sums, CubicFit& fit)                                     \
  {                                                                                    \
    crest::fitCubics (sums, fit);                                                      \
  }                                                                                    \
  constexpr FitKernels KERNELS{fitQuadrics, addHeights, fitCubics};                    \
  }

PCL_CREST_FIT_KERNELS (portable)
#if defined(__x86_64__)
PCL_CREST_FIT_KERNELS (avx2)
#endif

} // namespace

const FitKernels&
fitKernels (Simd simd)
{
#if defined(__x86_64__)
  if (simd == Simd::AVX2 && isAvailable (simd))
    return avx2::KERNELS;
#endif
  return portable::KERNELS;
}

} // namespace crest
} // namespace pcl
