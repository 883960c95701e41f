// SPDX-License-Identifier: BSD-3-Clause
#include "creases/quartic_residual.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

#include "curvature/fit_kernels.h"

#include <algorithm>

namespace pcl {
namespace crest {

double
quarticResidual (const Coordinates& positions, const Eigen::Vector3d& normal)
{
  constexpr int DEGREE = 4;
  constexpr int TERMS = monomials (DEGREE);
  constexpr auto COUNT = static_cast<int> (QUARTIC_POINTS);
  const double size = positions[QUARTIC_POINTS - 1].norm();
  const Eigen::Vector3d x = normal.unitOrthogonal() / size;
  const Eigen::Vector3d y = normal.cross (x);
  Eigen::Matrix<double, TERMS, COUNT> terms;
  Eigen::Matrix<double, COUNT, 1> heights;
  for (int i = 0; i < COUNT; ++i) {
    const Eigen::Vector3d p = positions[static_cast<std::size_t> (i)];
    const double u = p.dot (x);
    const double v = p.dot (y);
    heights[i] = p.dot (normal);
    terms (0, i) = 1.0;
    for (int degree = 1; degree <= DEGREE; ++degree) {
      const int before = monomials (degree - 2);
      const int first = monomials (degree - 1);
      for (int j = 0; j < degree; ++j)
        terms (first + j, i) = u * terms (before + j, i);
      terms (first + degree, i) = v * terms (first - 1, i);
    }
  }
  const Eigen::Matrix<double, TERMS, TERMS> products = terms * terms.transpose();
  const Eigen::Matrix<double, TERMS, 1> quartic =
      products.ldlt().solve (terms * heights);
  return (heights - terms.transpose() * quartic).squaredNorm() / (COUNT - TERMS);
}

} // namespace crest
} // namespace pcl
