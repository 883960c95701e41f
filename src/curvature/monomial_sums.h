// SPDX-License-Identifier: BSD-3-Clause
// What the normal equations of polynomials of u and v are made of, in registers.
#pragma once

#include "curvature/float_lanes.h"
#include "curvature/monomials.h"

namespace pcl {
namespace crest {

/** \brief A sample of each of the eight in the frame of its fit. */
struct FrameRow {
  FloatRow u, v, value, weight;
};

/** \brief What each monomial is the product of: one of the degree below, and u, or
 * where it has none v.
 */
struct MonomialFactors {
  static constexpr int SIZE = monomials (6);

  int places[SIZE] = {};
  bool has_u[SIZE] = {};

  constexpr MonomialFactors()
  {
    for (int degree = 1; placeOf (0, degree) < SIZE; ++degree)
      for (int b = 0; b <= degree; ++b) {
        const int i = placeOf (degree - b, b);
        has_u[i] = b < degree;
        places[i] = has_u[i] ? placeOf (degree - 1 - b, b) : placeOf (0, degree - 1);
      }
  }
};
constexpr MonomialFactors FACTORS;

/** \brief The terms 1, u, v, u^2... from a degree to another, times a factor. */
template <int LOW, int HIGH, typename Numbers>
PCL_CREST_INLINE void
addMonomials (const Numbers& u,
              const Numbers& v,
              const Numbers& factor,
              Numbers (&sums)[monomials (HIGH) - monomials (LOW - 1)])
{
  constexpr int BEGIN = monomials (LOW - 1);
  constexpr int END = monomials (HIGH);
  Numbers terms[END];
  terms[0] = factor;
#pragma GCC unroll 28
  for (int i = 1; i < END; ++i)
    terms[i] = terms[FACTORS.places[i]] * (FACTORS.has_u[i] ? u : v);
#pragma GCC unroll 28
  for (int i = BEGIN; i < END; ++i)
    sums[i - BEGIN] += terms[i];
}

/** \brief Sums over the samples of the weighted terms, of values times them if that is
 * asked for. So many degrees at a time as registers take.
 */
template <int LOW, int HIGH, bool VALUES, typename Numbers>
PCL_CREST_INLINE void
sumMonomials (const FrameRow* samples, int count, int first, Numbers* sums)
{
  constexpr int BEGIN = monomials (LOW - 1);
  constexpr int SIZE = monomials (HIGH) - BEGIN;
  Numbers partial[SIZE] = {};
  for (int i = 0; i < count; ++i) {
    Numbers u;
    Numbers v;
    Numbers factor;
    load (samples[i].u, first, u);
    load (samples[i].v, first, v);
    load (samples[i].weight, first, factor);
    if (VALUES) {
      Numbers value;
      load (samples[i].value, first, value);
      factor *= value;
    }
    addMonomials<LOW, HIGH> (u, v, factor, partial);
  }
#pragma GCC unroll 28
  for (int i = 0; i < SIZE; ++i)
    sums[BEGIN + i] = partial[i];
}

} // namespace crest
} // namespace pcl
