// SPDX-License-Identifier: BSD-3-Clause
#include "creases/two_planes.h"

#include <algorithm>
#include <cmath>

namespace pcl {
namespace crest {

bool
TwoPlanes::split (const Coordinates& normals, std::size_t count, const Scatter& scatter)
{
  // Variance: that of normals two degrees to each side.
  constexpr double LEAST_VARIANCE = 1e-3;
  const Eigen::Vector3d mean = scatter.center();
  // The sum of the variances along all axes.
  if (1.0 - mean.squaredNorm() < LEAST_VARIANCE)
    return false;
  double variance = 0.0;
  const Eigen::Vector3d axis = scatter.longestAxis (variance);
  if (variance < LEAST_VARIANCE * static_cast<double> (count))
    return false;
  side_.resize (count);
  const double* nx = normals.x.data();
  const double* ny = normals.y.data();
  const double* nz = normals.z.data();
  double* sides = side_.data();
  const double middle = mean.dot (axis);
  double x = 0.0;
  double y = 0.0;
  double z = 0.0;
#pragma omp simd reduction(+ : x, y, z)
  for (std::size_t i = 0; i < count; ++i) {
    const double side = std::copysign (
        1.0, nx[i] * axis[0] + ny[i] * axis[1] + nz[i] * axis[2] - middle);
    sides[i] = side;
    x += side * nx[i];
    y += side * ny[i];
    z += side * nz[i];
  }
  // Of either part twice the sum.
  const Eigen::Vector3d difference (x, y, z);
  planes_[0].normal = scatter.sum() + difference;
  planes_[1].normal = scatter.sum() - difference;
  return true;
}

bool
TwoPlanes::fit (const Coordinates& positions,
                std::size_t count,
                const Scatter& scatter,
                double largest)
{
  constexpr int ROUNDS = 8;
  constexpr double LEAST_PART = 0.18;
  constexpr std::size_t LEAST_COUNT = 5;
  for (int round = 0; round < ROUNDS; ++round) {
    Scatter differences;
    differences.add (positions, 0, count, [sides = side_.data()] (std::size_t i) {
      return sides[i];
    });
    const std::array<Scatter, 2> parts{scatter.part (differences, 1.0),
                                       scatter.part (differences, -1.0)};
    if (round == 0 &&
        parts[0].leastPlaneResidual() + parts[1].leastPlaneResidual() > largest)
      return false;
    if (!parts[0].fitPlane (planes_[0]) || !parts[1].fitPlane (planes_[1]))
      return false;
    if (round == 0 && planes_[0].residual + planes_[1].residual > largest)
      return false;
    const Eigen::Vector3d apart = planes_[0].center - planes_[1].center;
    convex_ = apart.dot (planes_[0].normal - planes_[1].normal) > 0.0;
    if (!takeSides (positions, count))
      break;
  }
  const auto first =
      static_cast<std::size_t> (std::count (side_.begin(), side_.end(), 1.0));
  const auto least = std::max (
      LEAST_COUNT, static_cast<std::size_t> (LEAST_PART * static_cast<double> (count)));
  return std::min (first, count - first) >= least;
}

bool
TwoPlanes::takeSides (const Coordinates& positions, std::size_t count)
{
  // Of the solid's surface is the higher plane if it is convex. On the edge itself
  // either is right, but flipped normals must not choose the other.
  const double sign = convex_ ? 1.0 : -1.0;
  const Eigen::Vector3d slope = sign * (planes_[0].normal - planes_[1].normal);
  const double offset = sign * (planes_[0].offset() - planes_[1].offset());
  const double* x = positions.x.data();
  const double* y = positions.y.data();
  const double* z = positions.z.data();
  double* sides = side_.data();
  double changes = 0.0;
#pragma omp simd reduction(+ : changes)
  for (std::size_t i = 0; i < count; ++i) {
    const double first = x[i] * slope[0] + y[i] * slope[1] + z[i] * slope[2] + offset;
    const double side = first > 0.0 ? 1.0 : first < 0.0 ? -1.0 : sides[i];
    changes += std::abs (side - sides[i]);
    sides[i] = side;
  }
  return changes > 0.0;
}

double
TwoPlanes::squaredDistances (const Coordinates& positions, std::size_t count) const
{
  // Half the sum and half the difference of the heights over both.
  const Eigen::Vector3d mean = 0.5 * (planes_[0].normal + planes_[1].normal);
  const Eigen::Vector3d half = 0.5 * (planes_[0].normal - planes_[1].normal);
  const double mean_offset = 0.5 * (planes_[0].offset() + planes_[1].offset());
  const double half_offset = 0.5 * (planes_[0].offset() - planes_[1].offset());
  const double* x = positions.x.data();
  const double* y = positions.y.data();
  const double* z = positions.z.data();
  const double* sides = side_.data();
  double sum = 0.0;
#pragma omp simd reduction(+ : sum)
  for (std::size_t i = 0; i < count; ++i) {
    const double height =
        x[i] * mean[0] + y[i] * mean[1] + z[i] * mean[2] + mean_offset +
        sides[i] * (x[i] * half[0] + y[i] * half[1] + z[i] * half[2] + half_offset);
    sum += height * height;
  }
  return sum;
}

} // namespace crest
} // namespace pcl
