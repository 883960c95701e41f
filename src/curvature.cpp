// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_crest/curvature.h>

#include <Eigen/Dense>

#include "parallel.h"

#include <cmath>

namespace pcl {
namespace crest {

namespace {

const PrincipalCurvature UNDETERMINED{0.0F, 0.0F, Eigen::Vector3f::Zero(), false};

double
meanSquaredDistance (const OrientedPoints& points, index_t point, const Star& star)
{
  double sum = 0.0;
  for (const index_t q : star)
    sum += (points.positions[q] - points.positions[point]).cast<double>().squaredNorm();
  return sum / static_cast<double> (star.size());
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
  const Eigen::Vector3d p = points.positions[point].cast<double>();
  const Eigen::Vector3d n = points.normals[point].cast<double>();
  const Eigen::Vector3d x = n.unitOrthogonal();
  const Eigen::Vector3d y = n.cross (x);

  // Lengths in units of the star's size keep the normal equations well scaled.
  const double unit = std::sqrt (meanSquaredDistance (points, point, star));
  Eigen::Matrix3d normal_matrix = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right_side = Eigen::Vector3d::Zero();
  for (const index_t q : star) {
    const Eigen::Vector3d e = (points.positions[q].cast<double>() - p) / unit;
    const double u = e.dot (x);
    const double v = e.dot (y);
    const Eigen::Vector3d row (0.5 * u * u, u * v, 0.5 * v * v);
    normal_matrix += row * row.transpose();
    right_side += row * e.dot (n);
  }

  const double scale = normal_matrix.diagonal().prod();
  if (!(normal_matrix.determinant() > 1e-9 * scale))
    return UNDETERMINED;
  const Eigen::Vector3d shape = normal_matrix.ldlt().solve (right_side) / unit;
  // The height falls where the surface is convex: hence the signs.
  return principalCurvature (-shape[0], -shape[1], -shape[2], x, y);
}

std::vector<PrincipalCurvature>
estimateCurvature (const OrientedPoints& points,
                   const SurfaceGraph& graph,
                   unsigned threads)
{
  std::vector<PrincipalCurvature> curvature (points.size(), UNDETERMINED);
  forEachBlock (
      points.size(), threads, [&] (std::size_t, std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
          const auto point = static_cast<index_t> (i);
          curvature[i] = fitQuadric (points, point, graph.star (point));
        }
      });
  return curvature;
}

} // namespace crest
} // namespace pcl
