// SPDX-License-Identifier: BSD-3-Clause
// How points of a window lie, and planes through them.
#pragma once

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace pcl {
namespace crest {

struct Plane {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  /** sum of the squared distances of the samples that it was fitted to */
  double residual = 0.0;

  /** \brief The height of the origin over it. */
  double
  offset () const
  {
    return -center.dot (normal);
  }
};

/** \brief Points, or normals, coordinate by coordinate, as vector instructions take
 * them.
 */
struct Coordinates {
  std::vector<double> x, y, z;

  void
  resize (std::size_t size)
  {
    x.resize (size);
    y.resize (size);
    z.resize (size);
  }

  std::size_t
  size () const
  {
    return x.size();
  }

  void
  set (std::size_t i, const Eigen::Vector3d& v)
  {
    x[i] = v.x();
    y[i] = v.y();
    z[i] = v.z();
  }

  Eigen::Vector3d
  operator[] (std::size_t i) const
  {
    return {x[i], y[i], z[i]};
  }
};

/** \brief How points, or normals, lie around their center. */
class Scatter {
public:
  /** \brief Adds some of them.
   * \param[in] first, last the places from and before which
   * \param[in] weight (i) that of each
   */
  template <typename Weight>
  void
  add (const Coordinates& points,
       std::size_t first,
       std::size_t last,
       const Weight& weight)
  {
    const double* px = points.x.data();
    const double* py = points.y.data();
    const double* pz = points.z.data();
    double n = 0.0, x = 0.0, y = 0.0, z = 0.0;
    double xx = 0.0, xy = 0.0, xz = 0.0, yy = 0.0, yz = 0.0, zz = 0.0;
#pragma omp simd reduction(+ : n, x, y, z, xx, xy, xz, yy, yz, zz)
    for (std::size_t i = first; i < last; ++i) {
      const double w = weight (i);
      const double wx = w * px[i];
      const double wy = w * py[i];
      const double wz = w * pz[i];
      n += w;
      x += wx;
      y += wy;
      z += wz;
      xx += wx * px[i];
      xy += wx * py[i];
      xz += wx * pz[i];
      yy += wy * py[i];
      yz += wy * pz[i];
      zz += wz * pz[i];
    }
    weight_ += n;
    sum_ += Eigen::Vector3d (x, y, z);
    Eigen::Matrix3d squares;
    squares << xx, xy, xz, xy, yy, yz, xz, yz, zz;
    squares_ += squares;
  }

  /** \brief Those of a sum that are on one side.
   * \param[in] differences what the same points add up to with weights of 1 on one side
   * and -1 on the other
   * \param[in] side 1 or -1
   */
  Scatter
  part (const Scatter& differences, double side) const
  {
    Scatter result;
    result.weight_ = 0.5 * (weight_ + side * differences.weight_);
    result.sum_ = 0.5 * (sum_ + side * differences.sum_);
    result.squares_ = 0.5 * (squares_ + side * differences.squares_);
    return result;
  }

  /** \brief The sum of weights. */
  double
  weight () const
  {
    return weight_;
  }

  Eigen::Vector3d
  center () const
  {
    return sum_ / weight_;
  }

  const Eigen::Vector3d&
  sum () const
  {
    return sum_;
  }

  /** \brief The sum of the products of coordinates from the center. */
  Eigen::Matrix3d
  products () const
  {
    return squares_ - sum_ / weight_ * sum_.transpose();
  }

  /** \brief What the residual of the best plane is at least, for little time: of the
   * eigenvalues a <= b <= c it is a, and abc / (ab + ac + bc) is less by a part of
   * a / b + a / c.
   */
  double
  leastPlaneResidual () const
  {
    const Invariants of (products());
    return of.minors > 0.0 ? of.determinant / of.minors : 0.0;
  }

  /** \brief The sums of squares from the center along the axes of the scatter,
   * ascending.
   */
  Eigen::Vector3d
  axes () const
  {
    return Invariants (products()).roots();
  }

  /** \brief The direction in which they differ most.
   * \param[out] square the sum of squares along it
   */
  Eigen::Vector3d
  longestAxis (double& square) const
  {
    const Eigen::Matrix3d m = products();
    const Invariants of (m);
    square = of.root (of.trace);
    return eigenvector (m, square, 2);
  }

  /** \brief The direction in which products, as of a scatter or the sum of several,
   * are the least.
   *
   * \param[in] products symmetric, none of its eigenvalues negative
   * \param[out] squares its eigenvalues, ascending
   */
  static Eigen::Vector3d
  shortestAxis (const Eigen::Matrix3d& products, Eigen::Vector3d& squares)
  {
    squares = Invariants (products).roots();
    return eigenvector (products, squares[0], 0);
  }

  /** \brief Fits the plane, its normal on the side of the one that it has; returns
   * whether there is one.
   */
  bool
  fitPlane (Plane& plane) const
  {
    // Part of the variance across of that along: a row of samples is no plane.
    constexpr double LEAST_WIDTH = 0.04;
    constexpr double LEAST_WEIGHT = 4.0;
    if (weight_ < LEAST_WEIGHT)
      return false;
    const Eigen::Matrix3d m = products();
    const Eigen::Vector3d squares = Invariants (m).roots();
    if (!(squares[1] >= LEAST_WIDTH * squares[2]) || squares[2] == 0.0)
      return false;
    plane.center = center();
    plane.residual = squares[0];
    const Eigen::Vector3d n = eigenvector (m, squares[0], 0);
    plane.normal = n.dot (plane.normal) < 0.0 ? Eigen::Vector3d (-n) : n;
    return true;
  }

private:
  /** \brief Of a matrix with the eigenvalues a, b and c: a + b + c, ab + ac + bc, abc.
   */
  struct Invariants {
    double trace;
    double minors;
    double determinant;

    explicit Invariants (const Eigen::Matrix3d& m)
    : trace (m.trace())
    , minors (m (0, 0) * m (1, 1) - m (0, 1) * m (0, 1) + m (0, 0) * m (2, 2) -
              m (0, 2) * m (0, 2) + m (1, 1) * m (2, 2) - m (1, 2) * m (1, 2))
    , determinant (m.determinant())
    {}

    /** \brief The eigenvalue next to a bound of all of them: from there, Newton's
     * method on the characteristic polynomial never goes too far. Where others are as
     * good as equal it is slow, and stops within a thousandth of the trace.
     */
    double
    root (double bound) const
    {
      constexpr int MOST_STEPS = 20;
      constexpr double ROUNDING = 1e-14;
      double at = bound;
      for (int i = 0; i < MOST_STEPS; ++i) {
        const double value = ((at - trace) * at + minors) * at - determinant;
        const double slope = (3.0 * at - 2.0 * trace) * at + minors;
        if (!(slope > 0.0))
          break;
        at -= value / slope;
        if (std::abs (value) <= ROUNDING * trace * slope)
          break;
      }
      return at;
    }

    /** \brief All eigenvalues, of which none is negative, ascending. */
    Eigen::Vector3d
    roots () const
    {
      // On a row there is nothing to divide by but rounding.
      constexpr double ROUNDING = 1e-12;
      if (!(minors > ROUNDING * trace * trace))
        return {0.0, 0.0, trace};
      const double least = std::max (0.0, root (0.0));
      const double middle = 0.5 * (trace - least);
      const double product = minors - 2.0 * least * middle;
      const double apart = std::sqrt (std::max (0.0, middle * middle - product));
      return {least, middle - apart, middle + apart};
    }
  };

  /** \param[in] value, place the eigenvalue, and its place among the three */
  static Eigen::Vector3d
  eigenvector (const Eigen::Matrix3d& m, double value, int place)
  {
    const Eigen::Matrix3d a = m - value * Eigen::Matrix3d::Identity();
    const Eigen::Vector3d across[] = {a.row (0).cross (a.row (1)),
                                      a.row (0).cross (a.row (2)),
                                      a.row (1).cross (a.row (2))};
    const Eigen::Vector3d* longest = std::max_element (
        std::begin (across), std::end (across), [] (const auto& p, const auto& q) {
          return p.squaredNorm() < q.squaredNorm();
        });
    // Where another eigenvalue is nearly equal, root has stopped too early for this.
    constexpr double CLEAR = 1e-5;
    const double trace = m.trace();
    if (longest->norm() > CLEAR * trace * trace)
      return longest->normalized();
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
    solver.computeDirect (m);
    return solver.eigenvectors().col (place);
  }

  double weight_ = 0.0;
  Eigen::Vector3d sum_ = Eigen::Vector3d::Zero();
  Eigen::Matrix3d squares_ = Eigen::Matrix3d::Zero();
};

} // namespace crest
} // namespace pcl
