// SPDX-License-Identifier: BSD-3-Clause
// How far points are from a smooth surface.
#pragma once

#include <Eigen/Dense>

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
    std::array<double, DEGREE + 1> pu{1.0, u};
    std::array<double, DEGREE + 1> pv{1.0, v};
    for (int i = 2; i <= DEGREE; ++i) {
      pu[i] = pu[i - 1] * u;
      pv[i] = pv[i - 1] * v;
    }
    for (int i = 0, m = 0; i <= DEGREE; ++i)
      for (int j = 0; j <= DEGREE - i; ++j, ++m)
        moments_[m] += pu[i] * pv[j];
    for (int i = 0, m = 0; i <= 3; ++i)
      for (int j = 0; j <= 3 - i; ++j, ++m)
        right_side_[m] += pu[i] * pv[j] * z;
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
            moments_[place (POWERS[a][0] + POWERS[b][0], POWERS[a][1] + POWERS[b][1])];
    matrix.diagonal().array() += 1e-9 * count_;
    const Eigen::LLT<Eigen::Matrix<double, TERMS, TERMS>, Eigen::Lower> solver (matrix);
    // Seen along a face, heights are no function of the place.
    if (solver.info() != Eigen::Success)
      return squares_ / (count_ - TERMS);
    // The squares that the cubic takes up: |L^-1 b|^2.
    const Coefficients taken = solver.matrixL().solve (right_side_);
    return std::max (0.0, squares_ - taken.squaredNorm()) / (count_ - TERMS);
  }

private:
  static constexpr int TERMS = 10;
  /** of the moments: of products of two terms */
  static constexpr int DEGREE = 6;
  using Coefficients = Eigen::Matrix<double, TERMS, 1>;
  /** the powers of u and v in each term */
  static constexpr int POWERS[TERMS][2] = {
      {0, 0}, {0, 1}, {0, 2}, {0, 3}, {1, 0}, {1, 1}, {1, 2}, {2, 0}, {2, 1}, {3, 0}};

  /** \brief The place of the moment of u^i v^j. */
  static constexpr int
  place (int i, int j)
  {
    return i * (DEGREE + 1) - i * (i - 1) / 2 + j;
  }

  Eigen::Vector3d normal_;
  Eigen::Vector3d x_;
  Eigen::Vector3d y_;
  std::array<double, (DEGREE + 1) * (DEGREE + 2) / 2> moments_{};
  Coefficients right_side_ = Coefficients::Zero();
  double squares_ = 0.0;
  double count_ = 0.0;
};

} // namespace crest
} // namespace pcl
