// SPDX-License-Identifier: BSD-3-Clause
// How far points are from a smooth surface.
#pragma once

#include <Eigen/Geometry>

#include "cubic_moments.h"
#include "small_cholesky.h"

#include <algorithm>

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
    moments_.add (p.dot (x_), p.dot (y_), p.dot (normal_), 1.0);
  }

  /** \brief Mean squared distance of the points from the cubic, for its degrees of
   * freedom; there have to be more points than its ten terms.
   */
  double
  meanSquare () const
  {
    constexpr int TERMS = CubicMoments::TERMS;
    Eigen::Matrix<double, TERMS, TERMS> matrix;
    Eigen::Matrix<double, TERMS, 1> right_side;
    for (int i = 0; i < TERMS; ++i) {
      right_side[i] = moments_.height (i);
      for (int j = 0; j <= i; ++j)
        matrix (i, j) = moments_.product (i, j);
      matrix (i, i) += 1e-9 * moments_.weight;
    }
    const double squares = moments_.squared_heights;
    const double freedom = moments_.weight - TERMS;
    const SmallCholesky<TERMS> solver (matrix);
    // Seen along a face, heights are no function of the place.
    if (!solver.isPositiveDefinite())
      return squares / freedom;
    // The squares that the cubic takes up: |L^-1 b|^2.
    return std::max (0.0, squares - solver.solveLower (right_side).squaredNorm()) /
           freedom;
  }

private:
  Eigen::Vector3d normal_;
  Eigen::Vector3d x_;
  Eigen::Vector3d y_;
  CubicMoments moments_;
};

} // namespace crest
} // namespace pcl
