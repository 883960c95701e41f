// SPDX-License-Identifier: BSD-3-Clause
// The terms of polynomials of u and v.
#pragma once

namespace pcl {
namespace crest {

/** \brief The number of monomials u^a v^b of up to a degree. They are ordered by degree
 * and then by b: 1, u, v, u^2, u v, v^2, u^3...
 */
constexpr int
monomials (int degree)
{
  return (degree + 1) * (degree + 2) / 2;
}

/** \brief The place of u^a v^b among the monomials. */
constexpr int
placeOf (int a, int b)
{
  return monomials (a + b - 1) + b;
}

struct Monomial {
  int a, b;
};

/** The terms of a cubic, in the order of the monomials. */
constexpr Monomial CUBIC_TERMS[monomials (3)] = {
    {0, 0}, {1, 0}, {0, 1}, {2, 0}, {1, 1}, {0, 2}, {3, 0}, {2, 1}, {1, 2}, {0, 3}};

} // namespace crest
} // namespace pcl
