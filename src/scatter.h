// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Eigenvalues>

namespace pcl {
namespace crest {

struct Plane {
  Eigen::Vector3d center;
  Eigen::Vector3d normal;
  /** sum of the squared distances of the samples that it was fitted to */
  double residual = 0.0;

  double
  height (const Eigen::Vector3d& p) const
  {
    return (p - center).dot (normal);
  }
};

/** \brief How points, or normals, lie around their center. */
class Scatter {
public:
  void
  add (const Eigen::Vector3d& p)
  {
    sum_ += p;
    xx_ += p.x() * p.x();
    xy_ += p.x() * p.y();
    xz_ += p.x() * p.z();
    yy_ += p.y() * p.y();
    yz_ += p.y() * p.z();
    zz_ += p.z() * p.z();
    ++count_;
  }

  Eigen::Vector3d
  center () const
  {
    return sum_ / count_;
  }

  /** \brief The sum of the products of coordinates from the center. */
  Eigen::Matrix3d
  products () const
  {
    Eigen::Matrix3d squares;
    squares << xx_, xy_, xz_, xy_, yy_, yz_, xz_, yz_, zz_;
    return squares - sum_ / count_ * sum_.transpose();
  }

  /** \brief What the residual of the best plane is at least, for little time: of the
   * eigenvalues a <= b <= c it is a, and abc / (ab + ac + bc) is less by a part of
   * a / b + a / c.
   */
  double
  leastPlaneResidual () const
  {
    const Eigen::Matrix3d m = products();
    const double minors = m (0, 0) * m (1, 1) - m (0, 1) * m (0, 1) +
                          m (0, 0) * m (2, 2) - m (0, 2) * m (0, 2) +
                          m (1, 1) * m (2, 2) - m (1, 2) * m (1, 2);
    return minors > 0.0 ? m.determinant() / minors : 0.0;
  }

  /** \brief Fits the plane, its normal on the side of the one that it has; returns
   * whether there is one.
   */
  bool
  fitPlane (Plane& plane) const
  {
    // Part of the variance across of that along: a row of samples is no plane.
    constexpr double LEAST_WIDTH = 0.04;
    constexpr int LEAST_COUNT = 4;
    if (count_ < LEAST_COUNT)
      return false;
    plane.center = center();
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
    solver.computeDirect (products());
    if (solver.eigenvalues()[1] < LEAST_WIDTH * solver.eigenvalues()[2])
      return false;
    plane.residual = solver.eigenvalues()[0];
    const Eigen::Vector3d n = solver.eigenvectors().col (0);
    plane.normal = n.dot (plane.normal) < 0.0 ? Eigen::Vector3d (-n) : n;
    return true;
  }

private:
  Eigen::Vector3d sum_ = Eigen::Vector3d::Zero();
  double xx_ = 0.0, xy_ = 0.0, xz_ = 0.0, yy_ = 0.0, yz_ = 0.0, zz_ = 0.0;
  int count_ = 0;
};

} // namespace crest
} // namespace pcl
