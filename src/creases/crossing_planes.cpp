// SPDX-License-Identifier: BSD-3-Clause
#include "creases/crossing_planes.h"

#include <utility>

namespace pcl {
namespace crest {

bool
CrossingPlanes::fit (const Coordinates& positions,
                     const Coordinates& normals,
                     std::size_t count,
                     const Eigen::Matrix3d& products,
                     double tolerance,
                     double most_astray)
{
  constexpr int ROUNDS = 6;
  constexpr double LEAST_PART = 0.12;
  // Normals next to the line may look anywhere between those of the two.
  constexpr double ALONG = 0.5;
  constexpr double MOST_BEYOND = 0.3;
  // The axes of the normals, whichever way they look. The eigenvalues add up to the
  // count: with least for the middle one the sum of their products is at least this.
  const auto whole = static_cast<double> (count);
  const double least = LEAST_PART * whole;
  if (0.5 * (whole * whole - products.squaredNorm()) < least * (whole - least))
    return false;
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect (products);
  if (solver.eigenvalues()[1] < least)
    return false;
  planes_[0].normal = solver.eigenvectors().col (2);
  planes_[1].normal = solver.eigenvectors().col (1);
  side_.resize (count);
  for (std::size_t i = 0; i < count; ++i)
    side_[i] = std::abs (normals[i].dot (planes_[0].normal)) >
                       std::abs (normals[i].dot (planes_[1].normal))
                   ? 1.0
                   : -1.0;
  for (int round = 0; round < ROUNDS; ++round) {
    for (const int plane : {0, 1}) {
      const double own = plane == 0 ? 1.0 : -1.0;
      Scatter scatter;
      scatter.add (positions, 0, count, [&] (std::size_t i) {
        return side_[i] == own ? 1.0 : 0.0;
      });
      if (!scatter.fitPlane (planes_[plane]))
        return false;
    }
    bool changed = false;
    for (std::size_t i = 0; i < count; ++i) {
      const auto distance = [&] (int plane) {
        return std::abs (planes_[plane].normal.dot (positions[i]) +
                         planes_[plane].offset());
      };
      const double side = distance (0) <= distance (1) ? 1.0 : -1.0;
      changed = changed || side != side_[i];
      side_[i] = side;
    }
    if (!changed)
      break;
  }

  std::array<double, 2> points{};
  std::array<double, 2> signs{};
  // Of the other plane's points how many are before each plane, and behind it.
  std::array<double, 2> before{};
  std::array<double, 2> behind{};
  double astray = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    const int own = side_[i] > 0.0 ? 0 : 1;
    const int other = 1 - own;
    const double cosine = normals[i].dot (planes_[own].normal);
    points[own] += 1.0;
    signs[own] += cosine > 0.0 ? 1.0 : -1.0;
    astray += std::abs (cosine) < ALONG ? 1.0 : 0.0;
    const double height =
        planes_[other].normal.dot (positions[i]) + planes_[other].offset();
    if (height > tolerance)
      before[other] += 1.0;
    else if (height < -tolerance)
      behind[other] += 1.0;
  }
  if (std::min (points[0], points[1]) < least || astray > most_astray * whole)
    return false;
  for (const int plane : {0, 1})
    if (signs[plane] < 0.0) {
      planes_[plane].normal = -planes_[plane].normal;
      std::swap (before[plane], behind[plane]);
    }
  const auto endsAt = [&] (int plane) {
    return std::min (before[plane], behind[plane]) <= MOST_BEYOND * points[1 - plane];
  };
  if (!endsAt (0)) {
    if (!endsAt (1))
      return false;
    std::swap (planes_[0], planes_[1]);
    std::swap (before[0], before[1]);
    std::swap (behind[0], behind[1]);
  }
  convex_ = behind[0] > before[0];
  return true;
}

} // namespace crest
} // namespace pcl
