// SPDX-License-Identifier: BSD-3-Clause
// How far points are from a smooth surface.
#pragma once

#include "small_cholesky.h"

#include <algorithm>
#include <array>

namespace pcl {
namespace crest {

/** \brief The residual of a cubic height function that is fitted to points, which can
 * be asked for while more points come.
 */
class CubicResidual {
public:
  /** \param[in] normal the direction of heights
   * \param[in] size about the largest distance of a point from the origin
   */
  CubicResidual (const Eigen::Vector3d& normal, double size)
  : normal_ (normal), x_ (normal.unitOrthogonal() / size), y_ (normal.cross (x_))
  {}

  void
  add (const Eigen::Vector3d& p)
  {
    const double u = p.dot (x_);
    const double v = p.dot (y_);
    const double z = p.dot (normal_);
    Row powers;
    powers[0] = 1.0;
    for (int j = 1; j < WIDTH; ++j)
      powers[j] = powers[j - 1] * v;
    double pu = 1.0;
    for (int i = 0; i <= DEGREE; ++i, pu *= u)
      for (int j = 0; j < WIDTH - i / 2 * 2; ++j)
        moments_[i][j] += pu * powers[j];
    double zu = z;
    for (int i = 0; i <= 3; ++i, zu *= u)
      for (int j = 0; j <= 3; ++j)
        heights_[i][j] += zu * powers[j];
    squares_ += z * z;
    ++count_;
  }

  /** \brief Mean squared distance of the points from the cubic, for its degrees of
   * freedom; there have to be more points than its ten terms.
   */
  double
  meanSquare () const
  {
    Eigen::Matrix<double, TERMS, TERMS> matrix;
    for (int a = 0; a < TERMS; ++a)
      for (int b = 0; b <= a; ++b)
        matrix (a, b) =
            moments_[POWERS[a][0] + POWERS[b][0]][POWERS[a][1] + POWERS[b][1]];
    matrix.diagonal().array() += 1e-9 * count_;
    const SmallCholesky<TERMS> solver (matrix);
    // Seen along a face, heights are no function of the place.
    if (!solver.isPositiveDefinite())
      return squares_ / (count_ - TERMS);
    Eigen::Matrix<double, TERMS, 1> right_side;
    for (int a = 0; a < TERMS; ++a)
      right_side[a] = heights_[POWERS[a][0]][POWERS[a][1]];
    // The squares that the cubic takes up: |L^-1 b|^2.
    const double taken = solver.solveLower (right_side).squaredNorm();
    return std::max (0.0, squares_ - taken) / (count_ - TERMS);
  }

private:
  static constexpr int TERMS = 10;
  /** of the moments: of products of two terms */
  static constexpr int DEGREE = 6;
  /** Rows are longer than is needed, so that several moments are added at once. */
  static constexpr int WIDTH = DEGREE + 2;
  using Row = std::array<double, WIDTH>;
  /** the powers of u and v in each term */
  static constexpr int POWERS[TERMS][2] = {
      {0, 0}, {0, 1}, {0, 2}, {0, 3}, {1, 0}, {1, 1}, {1, 2}, {2, 0}, {2, 1}, {3, 0}};

  Eigen::Vector3d normal_;
  Eigen::Vector3d x_;
  Eigen::Vector3d y_;
  /** sums of u^i v^j, and of heights times these */
  std::array<Row, DEGREE + 1> moments_{};
  std::array<std::array<double, 4>, 4> heights_{};
  double squares_ = 0.0;
  double count_ = 0.0;
};

} // namespace crest
} // namespace pcl
