// SPDX-License-Identifier: BSD-3-Clause
// Several small systems of equations at once, one in each lane of a register.
#pragma once

#include <cmath>

namespace pcl {
namespace crest {

constexpr int LANES = 4;

/** \brief A number of each of some fits that are done together (GCC's and Clang's
 * vector extension: registers of whatever width the instructions have). Aligned by
 * itself, as otherwise alignment, too, is that of the instructions.
 */
using Lanes = double __attribute__ ((vector_size (LANES * sizeof (double)),
                                     aligned (LANES * sizeof (double))));

/** \brief These, as a parameter of templates. */
struct DoubleRegisters {
  using Number = double;
  using Numbers = Lanes;
};

/** \brief What comparing lanes gives: all bits of a lane, or none. */
using LaneMask = long long __attribute__ ((vector_size (LANES * sizeof (long long)),
                                           aligned (LANES * sizeof (long long))));

/** \brief What is to be part of a function for certain instructions. Loops of fixed
 * length in it are unrolled, at most so many times as pragmas say: what they index then
 * stays in registers, or has a fixed place, which makes sums and solvers up to twice as
 * fast.
 */
#define PCL_CREST_INLINE inline __attribute__ ((always_inline))

template <typename Numbers>
PCL_CREST_INLINE void
takeRoots (Numbers& squares)
{
  constexpr int SIZE = sizeof (Numbers) / sizeof (squares[0]);
  for (int lane = 0; lane < SIZE; ++lane)
    squares[lane] = std::sqrt (squares[lane]);
}

/** \brief What is fitted together: as soon as all lanes are taken, or when nothing more
 * comes. A Fitter puts something into the lane queued_, calls push, and has a function
 * run for what is queued.
 */
template <typename Fitter, int SIZE = LANES>
class LaneBatch {
public:
  /** \brief To be called after the last. */
  void
  finish ()
  {
    if (queued_ > 0)
      static_cast<Fitter*> (this)->run();
    queued_ = 0;
  }

protected:
  void
  push ()
  {
    if (++queued_ == SIZE)
      finish();
  }

  int queued_ = 0;
};

/** \brief The Cholesky factor L of positive definite matrices of a fixed size of about
 * ten. Eigen's, which is made for large ones too, calls kernels for parts of a few
 * numbers.
 */
template <int N, typename Registers = DoubleRegisters>
struct LaneCholesky {
  using Number = typename Registers::Number;
  using Numbers = typename Registers::Numbers;

  /** the lower triangle, row by row; the diagonal is inverse */
  Numbers factor[N * (N + 1) / 2];

  static constexpr int
  at (int row, int column)
  {
    return row * (row + 1) / 2 + column;
  }

  /** \brief Replaces the lower triangle of a matrix; where a lane's is not positive
   * definite, the factor is not finite.
   */
  PCL_CREST_INLINE void
  decompose ()
  {
#pragma GCC unroll 10
    for (int k = 0; k < N; ++k) {
      Numbers& pivot = factor[at (k, k)];
      takeRoots (pivot);
      pivot = Number{1} / pivot;
#pragma GCC unroll 10
      for (int i = k + 1; i < N; ++i)
        factor[at (i, k)] *= pivot;
#pragma GCC unroll 10
      for (int i = k + 1; i < N; ++i)
#pragma GCC unroll 10
        for (int j = k + 1; j <= i; ++j)
          factor[at (i, j)] -= factor[at (i, k)] * factor[at (j, k)];
    }
  }

  /** \brief Replaces b by L^-1 b; its entries before the first are zero. */
  PCL_CREST_INLINE void
  solveLower (Numbers (&b)[N], int first = 0) const
  {
#pragma GCC unroll 10
    for (int i = first; i < N; ++i) {
#pragma GCC unroll 10
      for (int j = first; j < i; ++j)
        b[i] -= factor[at (i, j)] * b[j];
      b[i] *= factor[at (i, i)];
    }
  }

  /** \brief Replaces y by L^-T y. */
  PCL_CREST_INLINE void
  solveUpper (Numbers (&y)[N]) const
  {
#pragma GCC unroll 10
    for (int i = N - 1; i >= 0; --i) {
      y[i] *= factor[at (i, i)];
#pragma GCC unroll 10
      for (int j = 0; j < i; ++j)
        y[j] -= factor[at (i, j)] * y[i];
    }
  }
};

} // namespace crest
} // namespace pcl
