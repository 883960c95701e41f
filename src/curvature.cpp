// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_crest/curvature.h>

#include <Eigen/Dense>

#include "large_arrays.h"
#include "parallel.h"

#include <cmath>
#include <limits>

namespace pcl {
namespace crest {

namespace {

const PrincipalCurvature UNDETERMINED{0.0F, 0.0F, Eigen::Vector3f::Zero(), false};

/** \brief Whether the projections of a star, of which these are the mean second moments
 * in the frame (x, y), lie on one line through the point as far as its coordinates can
 * tell.
 */
bool
isOnOneLine (const Eigen::Matrix2d& moments,
             const Eigen::Vector3d& x,
             const Eigen::Vector3d& y,
             const Eigen::Vector3f& position)
{
  constexpr double ROUNDING = 1.5 * std::numeric_limits<float>::epsilon();
  // Hardly ever more than this is needed to tell: the smaller eigenvalue is at least
  // determinant / trace, and rounding moves a point by no more in any direction.
  const Eigen::Vector3d size = position.cast<double>().cwiseAbs();
  if (moments.determinant() >
      ROUNDING * ROUNDING * size.squaredNorm() * moments.trace())
    return false;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes (moments);
  const Eigen::Vector2d across = axes.eigenvectors().col (0);
  const Eigen::Vector3d direction = across.x() * x + across.y() * y;
  // Rounding to floats moves a point by up to a third of this in that direction.
  const double rounding = ROUNDING * direction.cwiseAbs().dot (size);
  return axes.eigenvalues()[0] <= rounding * rounding;
}

/** \brief Principal curvatures of the quadric with the shape matrix [a b; b c] in the
 * tangent frame (x, y).
 */
PrincipalCurvature
principalCurvature (
    double a, double b, double c, const Eigen::Vector3d& x, const Eigen::Vector3d& y)
{
  const double mean = 0.5 * (a + c);
  const double difference = 0.5 * (a - c);
  const double radius = std::hypot (difference, b);
  const double k1 = mean >= 0.0 ? mean + radius : mean - radius;
  const double k2 = mean >= 0.0 ? mean - radius : mean + radius;
  // Of the two rows of (shape matrix - k1) the longer gives the direction safely.
  Eigen::Vector2d t (b, k1 - a);
  if (std::abs (k1 - c) > std::abs (k1 - a))
    t = {k1 - c, b};
  if (t.squaredNorm() == 0.0)
    t = Eigen::Vector2d::UnitX(); // umbilic: any direction is principal
  t.normalize();
  return {static_cast<float> (k1),
          static_cast<float> (k2),
          (t.x() * x + t.y() * y).cast<float>(),
          true};
}

} // namespace

PrincipalCurvature
fitQuadric (const OrientedPoints& points, index_t point, const Star& star)
{
  if (star.size() < 3)
    return UNDETERMINED;
  const Eigen::Vector3d n = points.normals[point].cast<double>();
  const Eigen::Vector3d x = n.unitOrthogonal();
  const Eigen::Vector3d y = n.cross (x);

  // Sums of u^i v^j, and of those times the height.
  double uuuu = 0.0;
  double uuuv = 0.0;
  double uuvv = 0.0;
  double uvvv = 0.0;
  double vvvv = 0.0;
  Eigen::Vector3d right_side = Eigen::Vector3d::Zero();
  Eigen::Vector3d moments = Eigen::Vector3d::Zero();
  double squared = 0.0;
  for (const index_t q : star) {
    const Eigen::Vector3d e = points.edge (point, q);
    const double u = e.dot (x);
    const double v = e.dot (y);
    const double height = e.dot (n);
    const Eigen::Vector3d row (u * u, u * v, v * v);
    uuuu += row[0] * row[0];
    uuuv += row[0] * row[1];
    uuvv += row[0] * row[2];
    uvvv += row[1] * row[2];
    vvvv += row[2] * row[2];
    right_side += height * row;
    moments += row;
    squared += row[0] + row[2] + height * height;
  }

  // Lengths in units of the star's size keep the normal equations well scaled.
  const double unit = std::sqrt (squared / static_cast<double> (star.size()));
  Eigen::Matrix3d normal_matrix;
  normal_matrix << 0.25 * uuuu, 0.5 * uuuv, 0.25 * uuvv, 0.5 * uuuv, uuvv, 0.5 * uvvv,
      0.25 * uuvv, 0.5 * uvvv, 0.25 * vvvv;
  normal_matrix /= unit * unit * unit * unit;
  right_side =
      right_side.cwiseProduct (Eigen::Vector3d (0.5, 1.0, 0.5)) / (unit * unit * unit);
  moments /= static_cast<double> (star.size());

  // Near zero, directions as good as on two lines: errors of the heights would come out
  // some thousand times as large.
  constexpr double DEPENDENT = 1e-6;
  const double scale = normal_matrix.diagonal().prod();
  if (!(normal_matrix.determinant() > DEPENDENT * scale) ||
      isOnOneLine ((Eigen::Matrix2d() << moments[0], moments[1], moments[1], moments[2])
                       .finished(),
                   x,
                   y,
                   points.positions[point]))
    return UNDETERMINED;
  const Eigen::Vector3d shape = normal_matrix.inverse() * right_side / unit;
  // The height falls where the surface is convex: hence the signs.
  const PrincipalCurvature curvature =
      principalCurvature (-shape[0], -shape[1], -shape[2], x, y);
  return std::isfinite (curvature.k1) ? curvature : UNDETERMINED;
}

std::vector<PrincipalCurvature>
estimateCurvature (const OrientedPoints& points,
                   const SurfaceGraph& graph,
                   const Workers& workers)
{
  std::vector<PrincipalCurvature> curvature = makeLarge (points.size(), UNDETERMINED);
  forEachBlock (
      points.size(), workers, [&] (std::size_t, std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
          const auto point = static_cast<index_t> (i);
          curvature[i] = fitQuadric (points, point, graph.star (point));
        }
      });
  return curvature;
}

} // namespace crest
} // namespace pcl
