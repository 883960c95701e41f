// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include <cmath>

namespace pcl {
namespace crest {

/** \brief The Cholesky factor L of a positive definite matrix of a fixed size of about
 * ten. Eigen's, which is made for large ones too, calls kernels for parts of a few
 * numbers: with it the solver took as long as summing up the matrix.
 */
template <int N>
class SmallCholesky {
public:
  using Vector = Eigen::Matrix<double, N, 1>;
  using Matrix = Eigen::Matrix<double, N, N>;

  /** \param[in] matrix only its lower triangle is read */
  explicit SmallCholesky (const Matrix& matrix) : factor_ (matrix)
  {
    for (int k = 0; k < N; ++k) {
      const double pivot = factor_ (k, k);
      positive_definite_ = positive_definite_ && pivot > 0.0;
      inverse_diagonal_[k] = 1.0 / std::sqrt (pivot);
      for (int i = k + 1; i < N; ++i)
        factor_ (i, k) *= inverse_diagonal_[k];
      for (int j = k + 1; j < N; ++j)
        for (int i = j; i < N; ++i)
          factor_ (i, j) -= factor_ (j, k) * factor_ (i, k);
    }
  }

  /** \brief Whether the matrix was; else solutions are not finite. */
  bool
  isPositiveDefinite () const
  {
    return positive_definite_;
  }

  /** \brief L^-1 b. */
  Vector
  solveLower (Vector b) const
  {
    for (int k = 0; k < N; ++k) {
      b[k] *= inverse_diagonal_[k];
      for (int i = k + 1; i < N; ++i)
        b[i] -= b[k] * factor_ (i, k);
    }
    return b;
  }

  /** \brief The solution x of L L^T x = b. */
  Vector
  solve (const Vector& b) const
  {
    Vector x = solveLower (b);
    for (int k = N - 1; k >= 0; --k) {
      x[k] *= inverse_diagonal_[k];
      for (int i = 0; i < k; ++i)
        x[i] -= factor_ (k, i) * x[k];
    }
    return x;
  }

private:
  Matrix factor_;
  Vector inverse_diagonal_;
  bool positive_definite_ = true;
};

} // namespace crest
} // namespace pcl
