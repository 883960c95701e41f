// SPDX-License-Identifier: BSD-3-Clause
#include "curvature/scale_kernels.h"

#include "curvature/monomial_sums.h"

#include <cmath>

namespace pcl {
namespace crest {

namespace {

constexpr int DEGREE = 3;
constexpr int TERMS = monomials (DEGREE);

/** The frame is tilted again where its slope is above a twentieth (3 degrees). */
constexpr float LARGEST_SQUARED_SLOPE = 0.05F * 0.05F;
constexpr int MOST_FITS = 3;

/** \brief The weights of the fit are no inverse variances, as they fall off to the rim.
 * With kappa the mean of the kernel g under the weights, kappa A^-1 is near to the true
 * covariance A^-1 (sum g w x x^T) A^-1, but not near enough for a test; these are the
 * ratios of the true values to it for a cubic under (1 - r^2)^2 on a disc: of the
 * degrees of freedom that the fit takes, and of the variance of a second derivative. By
 * numerical integration; on 28 to 70 scattered nodes they differ by less than .02.
 */
constexpr float TAKEN_FREEDOM = 0.60F;
constexpr float CURVATURE_VARIANCE = 0.615F;

/** \brief The fit of some lanes. */
template <int WIDTH>
struct Fitter {
  using Registers = FloatRegisters<WIDTH>;
  using Numbers = typename Registers::Numbers;
  using Mask = typename Registers::Mask;
  using Matrix = LaneCholesky<TERMS, Registers>;

  /** the first of the lanes */
  int first;
  Vectors<Numbers> x, y, n;
  /** sums over the neighbours of the kernel g, and of kernel squared times samples */
  Numbers kernel, kernel_weight;
  Matrix matrix;
  Numbers cubic[TERMS];
  Numbers weight, residual;
  /** where the neighbours are not on a line */
  Mask is_surface;

  /** \brief Two axes across the normals (Duff et al. 2017). Those of the opposite
   * vector are their exact mirror image.
   */
  PCL_CREST_INLINE void
  findAxes ()
  {
    const Numbers one = Numbers{} + 1.0F;
    const Mask sign_bit = Mask{} + std::int32_t (1U << 31U);
    const Numbers sign = (Numbers)(((Mask)n.z & sign_bit) | (Mask)one);
    const Numbers a = -1.0F / (sign + n.z);
    const Numbers b = n.x * n.y * a;
    x = {1.0F + sign * n.x * n.x * a, sign * b, -sign * n.x};
    y = {b, sign + n.y * n.y * a, -n.y};
  }

  PCL_CREST_INLINE void
  takeSamples (const NodeRow* nodes, int count, FrameRow* samples)
  {
    kernel = kernel_weight = Numbers{};
    for (int i = 0; i < count; ++i) {
      Vectors<Numbers> e;
      Numbers node_weight;
      load (nodes[i].edge, first, e);
      load (nodes[i].weight, first, node_weight);
      const Numbers g = 1.0F - (e.x * e.x + e.y * e.y + e.z * e.z);
      const Numbers squared = node_weight > 0.0F ? g * g : Numbers{};
      const Numbers w = squared * node_weight;
      kernel += squared;
      kernel_weight += w * squared;
      store (e.x * x.x + e.y * x.y + e.z * x.z, first, samples[i].u);
      store (e.x * y.x + e.y * y.y + e.z * y.z, first, samples[i].v);
      store (e.x * n.x + e.y * n.y + e.z * n.z, first, samples[i].value);
      store (w, first, samples[i].weight);
    }
  }

  /** \brief Least squares by the normal equations. Samples on few lines leave some
   * terms open: these become small.
   */
  PCL_CREST_INLINE void
  solve (const FrameRow* samples, int count)
  {
    constexpr float OPEN = 1e-6F;
    constexpr float ROUNDING = 1e-5F;
    constexpr int SECOND = monomials (1);
    Numbers powers[monomials (2 * DEGREE)];
    sumMonomials<5, 6, false> (samples, count, first, powers);
    sumMonomials<3, 4, false> (samples, count, first, powers);
    sumMonomials<0, 2, false> (samples, count, first, powers);
    sumMonomials<0, DEGREE, true> (samples, count, first, cubic);
    weight = powers[0];
    const Numbers uu = powers[SECOND];
    const Numbers uv = powers[SECOND + 1];
    const Numbers vv = powers[SECOND + 2];
    is_surface = uu * vv - uv * uv > ROUNDING * (uu + vv) * (uu + vv);
#pragma GCC unroll 10
    for (int i = 0; i < TERMS; ++i) {
#pragma GCC unroll 10
      for (int j = 0; j <= i; ++j)
        matrix.factor[Matrix::at (i, j)] = powers[placeOf (
            CUBIC_TERMS[i].a + CUBIC_TERMS[j].a, CUBIC_TERMS[i].b + CUBIC_TERMS[j].b)];
      matrix.factor[Matrix::at (i, i)] += OPEN * powers[0];
    }
    matrix.decompose();
    matrix.solveLower (cubic);
    matrix.solveUpper (cubic);
    refine (samples, count);
  }

  /** \brief What is left of the heights, from these themselves, and once more the same
   * for what that adds up to: it takes away most of what floats have rounded.
   */
  PCL_CREST_INLINE void
  refine (const FrameRow* samples, int count)
  {
    const Numbers (&c)[TERMS] = cubic;
    Numbers rest[TERMS] = {};
    residual = Numbers{};
    for (int i = 0; i < count; ++i) {
      Numbers u;
      Numbers v;
      Numbers height;
      Numbers w;
      load (samples[i].u, first, u);
      load (samples[i].v, first, v);
      load (samples[i].value, first, height);
      load (samples[i].weight, first, w);
      const Numbers left =
          height - (c[0] + u * (c[1] + u * (c[3] + u * c[6]) + v * (c[4] + u * c[7])) +
                    v * (c[2] + v * (c[5] + u * c[8] + v * c[9])));
      const Numbers factor = w * left;
      residual += factor * left;
      addMonomials<0, DEGREE> (u, v, factor, rest);
    }
    matrix.solveLower (rest);
    for (const Numbers& r : rest)
      residual -= r * r;
    residual = residual > 0.0F ? residual : Numbers{};
    matrix.solveUpper (rest);
#pragma GCC unroll 10
    for (int i = 0; i < TERMS; ++i)
      cubic[i] += rest[i];
  }

  /** \brief Tilts the frames whose tangent plane is another; returns whether any is. */
  PCL_CREST_INLINE bool
  tilt ()
  {
    const Numbers slope = cubic[1] * cubic[1] + cubic[2] * cubic[2];
    const Mask tilted = is_surface & (slope > LARGEST_SQUARED_SLOPE);
    Numbers length = 1.0F + slope;
    takeRoots (length);
    const Numbers per_length = 1.0F / length;
    const auto& c = cubic;
    n.x = tilted ? (n.x - c[1] * x.x - c[2] * y.x) * per_length : n.x;
    n.y = tilted ? (n.y - c[1] * x.y - c[2] * y.y) * per_length : n.y;
    n.z = tilted ? (n.z - c[1] * x.z - c[2] * y.z) * per_length : n.z;
    std::int32_t any = 0;
    for (int lane = 0; lane < WIDTH; ++lane)
      any |= tilted[lane];
    return any != 0;
  }

  /** \brief The curvatures where the node is, from both fundamental forms. */
  PCL_CREST_INLINE void
  describe (ScaleFitRow& fits) const
  {
    const Numbers& p = cubic[1];
    const Numbers& q = cubic[2];
    Numbers norm = 1.0F + p * p + q * q;
    takeRoots (norm);
    // The height falls where the surface is convex: hence the signs.
    const Numbers L = -2.0F * cubic[3] / norm;
    const Numbers M = -cubic[4] / norm;
    const Numbers N = -2.0F * cubic[5] / norm;
    const Numbers E = 1.0F + p * p;
    const Numbers F = p * q;
    const Numbers G = 1.0F + q * q;
    const Numbers per_area = 1.0F / (E * G - F * F);
    const Numbers uu = (G * L - F * M) * per_area;
    const Numbers uv = (G * M - F * N) * per_area;
    const Numbers vu = (E * M - F * L) * per_area;
    const Numbers vv = (E * N - F * M) * per_area;
    const Numbers mean = 0.5F * (uu + vv);
    const Numbers apart = 0.5F * (uu - vv);
    Numbers half = apart * apart + uv * vu;
    half = half > 0.0F ? half : Numbers{};
    takeRoots (half);
    const Numbers away = mean >= 0.0F ? half : -half;
    const Numbers k1 = mean + away;
    // Of the two rows of II - k1 I the longer gives the direction safely.
    Numbers a = M - k1 * F;
    Numbers b = k1 * E - L;
    const Numbers other_a = N - k1 * G;
    const Numbers other_b = k1 * F - M;
    const Mask other = other_a * other_a + other_b * other_b > a * a + b * b;
    a = other ? other_a : a;
    b = other ? other_b : b;
    Numbers length = a * a + b * b;
    takeRoots (length);
    const Mask umbilic = length == 0.0F; // any direction is principal
    a = umbilic ? Numbers{} + 1.0F : a / length;
    b = umbilic ? Numbers{} : b / length;

    const Numbers kappa = kernel_weight / weight;
    const Numbers left = kernel - TAKEN_FREEDOM * TERMS * kappa;
    const Numbers least = 0.1F * kernel;
    const Numbers variance = residual / (left > least ? left : least);
    // The second derivatives, of which two are twice the coefficients.
    constexpr int SECOND = monomials (1);
    Numbers bend[TERMS] = {};
    bend[SECOND] = 2.0F * a * a;
    bend[SECOND + 1] = 2.0F * a * b;
    bend[SECOND + 2] = 2.0F * b * b;
    matrix.solveLower (bend, SECOND);
    Numbers bend_variance = bend[SECOND] * bend[SECOND];
    for (int i = SECOND + 1; i < TERMS; ++i)
      bend_variance += bend[i] * bend[i];

    const Numbers rise = p * a + q * b;
    Vectors<Numbers> t1{a * x.x + b * y.x + rise * n.x,
                        a * x.y + b * y.y + rise * n.y,
                        a * x.z + b * y.z + rise * n.z};
    Numbers t1_length = t1.x * t1.x + t1.y * t1.y + t1.z * t1.z;
    takeRoots (t1_length);
    t1 = {t1.x / t1_length, t1.y / t1_length, t1.z / t1_length};
    Numbers sum = residual + bend_variance;
    for (const Numbers& c : cubic)
      sum += c;
    // Nothing but finite numbers are equal to themselves less themselves and zero.
    const Mask valid = is_surface & (sum - sum == 0.0F);
    store (k1, first, fits.k1);
    store (mean - away, first, fits.k2);
    store (t1, first, fits.t1);
    store (Vectors<Numbers>{(n.x - p * x.x - q * y.x) / norm,
                            (n.y - p * x.y - q * y.y) / norm,
                            (n.z - p * x.z - q * y.z) / norm},
           first,
           fits.normal);
    store (cubic[0] / norm, first, fits.offset);
    store (variance, first, fits.variance);
    store (
        CURVATURE_VARIANCE * kappa * variance * bend_variance, first, fits.k1_variance);
    store (valid ? Numbers{} + 1.0F : Numbers{}, first, fits.valid);
  }
};

template <int WIDTH>
PCL_CREST_INLINE void
fit (const NodeRow* nodes,
     int count,
     const FloatVectorRow& normals,
     FrameRow* room,
     ScaleFitRow& fits)
{
  for (int first = 0; first < FLOAT_LANES; first += WIDTH) {
    Fitter<WIDTH> fitter;
    fitter.first = first;
    load (normals, first, fitter.n);
    for (int round = 1;; ++round) {
      fitter.findAxes();
      fitter.takeSamples (nodes, count, room);
      fitter.solve (room, count);
      if (round == MOST_FITS || !fitter.tilt())
        break;
    }
    fitter.describe (fits);
  }
}

// The same once for each set of instructions: what is inline becomes part of functions
// for it.
namespace portable {
void
fit (const NodeRow* nodes,
     int count,
     const FloatVectorRow& normals,
     FrameRow* room,
     ScaleFitRow& fits)
{
  crest::fit<4> (nodes, count, normals, room, fits);
}
constexpr ScaleKernels KERNELS{fit};
} // namespace portable

#if defined(__x86_64__)
namespace avx2 {
__attribute__ ((target ("avx2"))) void
fit (const NodeRow* nodes,
     int count,
     const FloatVectorRow& normals,
     FrameRow* room,
     ScaleFitRow& fits)
{
  crest::fit<8> (nodes, count, normals, room, fits);
}
constexpr ScaleKernels KERNELS{fit};
} // namespace avx2
#endif

} // namespace

const ScaleKernels&
scaleKernels (Simd simd)
{
#if defined(__x86_64__)
  if (simd == Simd::AVX2 && isAvailable (simd))
    return avx2::KERNELS;
#endif
  return portable::KERNELS;
}

} // namespace crest
} // namespace pcl
