// SPDX-License-Identifier: BSD-3-Clause
// What the normal equations of a cubic height function are made of.
#pragma once

namespace pcl {
namespace crest {

/** \brief Weighted sums over samples at (u, v) of the height z. */
struct CubicMoments {
  static constexpr int DEGREE = 3;
  static constexpr int TERMS = 10;
  /** the monomials u^A v^B of a cubic */
  static constexpr int A[TERMS] = {0, 1, 0, 2, 1, 0, 3, 2, 1, 0};
  static constexpr int B[TERMS] = {0, 0, 1, 0, 1, 2, 0, 1, 2, 3};

  /** of w u^a v^b, a + b up to twice the degree; each row is filled up to an even
   * number of sums, two of which are added at once, and not beyond */
  double powers[2 * DEGREE + 1][2 * DEGREE + 2] = {};
  /** of w z u^a v^b */
  double heights[DEGREE + 1][DEGREE + 1] = {};
  double squared_heights = 0.0;
  double weight = 0.0;

  void
  add (double u, double v, double z, double w)
  {
    constexpr int WIDTH = 2 * DEGREE + 2;
    double v_powers[WIDTH];
    v_powers[0] = 1.0;
    for (int b = 1; b < WIDTH; ++b)
      v_powers[b] = v_powers[b - 1] * v;
    double wu = w;
    for (int a = 0; a <= 2 * DEGREE; ++a, wu *= u)
      for (int b = 0; b < WIDTH - a / 2 * 2; ++b)
        powers[a][b] += wu * v_powers[b];
    double wzu = w * z;
    for (int a = 0; a <= DEGREE; ++a, wzu *= u)
      for (int b = 0; b <= DEGREE; ++b)
        heights[a][b] += wzu * v_powers[b];
    squared_heights += w * z * z;
    weight += w;
  }

  /** \brief The sum of w times the i-th and the j-th term. */
  double
  product (int i, int j) const
  {
    return powers[A[i] + A[j]][B[i] + B[j]];
  }

  /** \brief The sum of w z times the i-th term. */
  double
  height (int i) const
  {
    return heights[A[i]][B[i]];
  }
};

} // namespace crest
} // namespace pcl
