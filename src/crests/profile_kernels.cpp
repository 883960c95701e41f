// SPDX-License-Identifier: BSD-3-Clause
#include "crests/profile_kernels.h"

#include <cmath>

namespace pcl {
namespace crest {

namespace {

constexpr int TERMS = ProfileRow::TERMS;
/** The terms of a quadric, which come first. */
constexpr int ROUND_TERMS = monomials (2);

/** The terms, in their order. */
constexpr Monomial PROFILE_TERMS[TERMS] = {
    {0, 0}, {1, 0}, {0, 1}, {2, 0}, {1, 1}, {0, 2}, {1, 2}};

/** \brief The profiles of some lanes. */
template <int WIDTH>
struct Profiler {
  using Registers = FloatRegisters<WIDTH>;
  using Numbers = typename Registers::Numbers;
  using Mask = typename Registers::Mask;

  /** the first of the lanes */
  int first;

  PCL_CREST_INLINE void
  takeSamples (const NearFitRow* nodes,
               int count,
               const FloatVectorRow& normals,
               const FloatVectorRow& directions,
               float elongation,
               FrameRow* samples,
               ProfileRow& profiles) const
  {
    Vectors<Numbers> n;
    Vectors<Numbers> t1;
    load (normals, first, n);
    load (directions, first, t1);
    const Vectors<Numbers> t2{
        n.y * t1.z - n.z * t1.y, n.z * t1.x - n.x * t1.z, n.x * t1.y - n.y * t1.x};
    const float shortening = 1.0F / (elongation * elongation);
    const Numbers one = Numbers{} + 1.0F;
    Numbers weight = {};
    Numbers variance = {};
    Mask inside = {};
    Numbers lowest = one;
    Numbers highest = -one;
    Numbers first_u = one;
    Numbers last_u = -one;
    for (int i = 0; i < count; ++i) {
      Vectors<Numbers> e;
      Numbers squared_error;
      load (nodes[i].edge, first, e);
      load (nodes[i].squared_error, first, squared_error);
      const Numbers u = e.x * t1.x + e.y * t1.y + e.z * t1.z;
      const Numbers v = e.x * t2.x + e.y * t2.y + e.z * t2.z;
      const Numbers along = u * u;
      const Numbers across = e.x * e.x + e.y * e.y + e.z * e.z - along;
      const Numbers g = 1.0F - along - across * shortening;
      const Mask is_inside = g > 0.0F;
      const Numbers w = is_inside ? g * g : Numbers{};
      inside += is_inside;
      weight += w;
      variance += w * squared_error;
      const Numbers low = is_inside ? u : one;
      const Numbers next_low = low > lowest ? low : lowest;
      first_u = next_low < first_u ? next_low : first_u;
      lowest = low < lowest ? low : lowest;
      const Numbers high = is_inside ? u : -one;
      const Numbers next_high = high < highest ? high : highest;
      last_u = next_high > last_u ? next_high : last_u;
      highest = high > highest ? high : highest;
      store (is_inside ? u : Numbers{}, first, samples[i].u);
      store (is_inside ? v : Numbers{}, first, samples[i].v);
      store (w, first, samples[i].weight);
      samples[i].value = nodes[i].value;
    }
    store (first_u, first, profiles.first_u);
    store (last_u, first, profiles.last_u);
    store (variance / weight, first, profiles.squared_error);
    for (int lane = 0; lane < WIDTH; ++lane)
      profiles.count[first + lane] = static_cast<float> (-inside[lane]);
  }

  /** \brief What the term u v^2 adds to the sums. */
  PCL_CREST_INLINE void
  addBentTerm (const FrameRow* samples,
               int count,
               Numbers (&powers)[monomials (6)],
               Numbers& values) const
  {
    Numbers uuuvv = {};
    Numbers uuvvv = {};
    Numbers uvvvv = {};
    Numbers uuvvvv = {};
    values = Numbers{};
    for (int i = 0; i < count; ++i) {
      Numbers u;
      Numbers v;
      Numbers value;
      Numbers w;
      load (samples[i].u, first, u);
      load (samples[i].v, first, v);
      load (samples[i].value, first, value);
      load (samples[i].weight, first, w);
      const Numbers uvv = w * u * v * v;
      const Numbers uuvv = uvv * u;
      const Numbers uvvv = uvv * v;
      values += uvv * value;
      uuuvv += uuvv * u;
      uuvvv += uuvv * v;
      uvvvv += uvvv * v;
      uuvvvv += uvvv * v * u;
    }
    powers[placeOf (3, 2)] = uuuvv;
    powers[placeOf (2, 3)] = uuvvv;
    powers[placeOf (1, 4)] = uvvvv;
    powers[placeOf (2, 4)] = uuvvvv;
  }

  /** \brief Least squares by the normal equations; terms that samples leave open are
   * damped a little.
   */
  template <bool BENT>
  PCL_CREST_INLINE void
  solve (const FrameRow* samples, int count, ProfileRow& profiles) const
  {
    constexpr float OPEN = 1e-5F;
    constexpr int N = BENT ? TERMS : ROUND_TERMS;
    using Matrix = LaneCholesky<N, Registers>;
    Numbers powers[monomials (6)];
    Numbers x[N];
    sumMonomials<3, 4, false> (samples, count, first, powers);
    sumMonomials<0, 2, false> (samples, count, first, powers);
    sumMonomials<0, 2, true> (samples, count, first, x);
    if (BENT)
      addBentTerm (samples, count, powers, x[N - 1]);
    Matrix matrix;
#pragma GCC unroll 7
    for (int i = 0; i < N; ++i) {
#pragma GCC unroll 7
      for (int j = 0; j <= i; ++j)
        matrix.factor[Matrix::at (i, j)] =
            powers[placeOf (PROFILE_TERMS[i].a + PROFILE_TERMS[j].a,
                            PROFILE_TERMS[i].b + PROFILE_TERMS[j].b)];
      matrix.factor[Matrix::at (i, i)] += OPEN * powers[0];
    }
    matrix.decompose();
    matrix.solveLower (x);
    matrix.solveUpper (x);
#pragma GCC unroll 7
    for (int i = 0; i < TERMS; ++i)
      store (i < N ? x[i] : Numbers{}, first, profiles.coefficients[i]);
  }
};

template <int WIDTH>
PCL_CREST_INLINE void
fit (const NearFitRow* nodes,
     int count,
     const FloatVectorRow& normals,
     const FloatVectorRow& t1,
     float elongation,
     FrameRow* room,
     ProfileRow& profiles)
{
  for (int first = 0; first < FLOAT_LANES; first += WIDTH) {
    const Profiler<WIDTH> profiler{first};
    profiler.takeSamples (nodes, count, normals, t1, elongation, room, profiles);
    if (elongation == 1.0F)
      profiler.template solve<false> (room, count, profiles);
    else
      profiler.template solve<true> (room, count, profiles);
  }
}

// The same once for each set of instructions: what is inline becomes part of functions
// for it.
namespace portable {
void
fit (const NearFitRow* nodes,
     int count,
     const FloatVectorRow& normals,
     const FloatVectorRow& t1,
     float elongation,
     FrameRow* room,
     ProfileRow& profiles)
{
  crest::fit<4> (nodes, count, normals, t1, elongation, room, profiles);
}
constexpr ProfileKernels KERNELS{fit};
} // namespace portable

#if defined(__x86_64__)
namespace avx2 {
__attribute__ ((target ("avx2"))) void
fit (const NearFitRow* nodes,
     int count,
     const FloatVectorRow& normals,
     const FloatVectorRow& t1,
     float elongation,
     FrameRow* room,
     ProfileRow& profiles)
{
  crest::fit<8> (nodes, count, normals, t1, elongation, room, profiles);
}
constexpr ProfileKernels KERNELS{fit};
} // namespace avx2
#endif

} // namespace

const ProfileKernels&
profileKernels (Simd simd)
{
#if defined(__x86_64__)
  if (simd == Simd::AVX2 && isAvailable (simd))
    return avx2::KERNELS;
#endif
  return portable::KERNELS;
}

} // namespace crest
} // namespace pcl
