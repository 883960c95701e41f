// SPDX-License-Identifier: BSD-3-Clause
#include "creases/plate_rim.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <numeric>

namespace pcl {
namespace crest {

namespace {

/** Between the normals of a sheet, and, but for the sign, of the two. */
constexpr double LEAST_COSINE = 0.7;

/** \brief One of the two sheets of a plate. */
struct Sheet {
  std::vector<std::size_t> points;
  Plane plane;

  /** \brief Takes the points whose normals are along one. */
  Sheet (const Coordinates& normals, const Eigen::Vector3d& normal)
  {
    plane.normal = normal;
    for (std::size_t i = 0; i < normals.size(); ++i)
      if (normals[i].dot (normal) > LEAST_COSINE)
        points.push_back (i);
  }

  /** \brief Fits the plane. Returns false if points are too few. */
  bool
  fit (const Coordinates& positions)
  {
    constexpr std::size_t LEAST_POINTS = 8;
    if (points.size() < LEAST_POINTS)
      return false;
    std::vector<double> weights (positions.size(), 0.0);
    for (const std::size_t i : points)
      weights[i] = 1.0;
    Scatter scatter;
    scatter.add (
        positions, 0, positions.size(), [&] (std::size_t i) { return weights[i]; });
    return scatter.fitPlane (plane);
  }

  /** \brief Mean squared distance of the points. */
  double
  meanSquare () const
  {
    return plane.residual / static_cast<double> (points.size());
  }
};

/** \brief Gives points to the sheet that they are nearer to. */
void
partByHeight (const Coordinates& positions, Sheet& near, Sheet& far)
{
  const auto distance = [&] (const Sheet& sheet, std::size_t i) {
    return std::abs (sheet.plane.normal.dot (positions[i] - sheet.plane.center));
  };
  std::vector<std::size_t> both = near.points;
  both.insert (both.end(), far.points.begin(), far.points.end());
  near.points.clear();
  far.points.clear();
  for (const std::size_t i : both)
    (distance (near, i) <= distance (far, i) ? near : far).points.push_back (i);
}

/** \brief The way out of a plate, and the one along its rim. */
struct RimFrame {
  Eigen::Vector3d outward;
  Eigen::Vector3d along;

  /** \brief How far out a sheet reaches: the mean of its outermost points, but for what
   * is far off to a side; minus infinity where there are too few.
   */
  double
  endOf (const Sheet& sheet, const Coordinates& positions) const
  {
    constexpr double ASIDE = 2.5;
    constexpr std::ptrdiff_t OUTERMOST = 3;
    std::vector<double> reached;
    for (const std::size_t i : sheet.points)
      if (std::abs (along.dot (positions[i])) < ASIDE)
        reached.push_back (outward.dot (positions[i]));
    if (static_cast<std::ptrdiff_t> (reached.size()) < OUTERMOST)
      return -std::numeric_limits<double>::infinity();
    std::partial_sort (
        reached.begin(), reached.begin() + OUTERMOST, reached.end(), std::greater<>());
    return std::accumulate (reached.begin(), reached.begin() + OUTERMOST, 0.0) /
           OUTERMOST;
  }

  /** \brief Whether more than a stray point is next to where the sheets end. */
  bool
  goesOn (const Coordinates& positions, double end) const
  {
    constexpr double BEYOND = 0.5;
    constexpr double FAR_BEYOND = 2.0;
    constexpr double ASIDE = 1.5;
    std::size_t beyond = 0;
    for (std::size_t i = 0; i < positions.size(); ++i) {
      const double past = outward.dot (positions[i]) - end;
      if (past > BEYOND && past < FAR_BEYOND &&
          std::abs (along.dot (positions[i])) < ASIDE)
        ++beyond;
    }
    return beyond > 1;
  }
};

} // namespace

std::optional<PlateRim>
fitPlateRim (const Coordinates& positions,
             const Coordinates& normals,
             const Eigen::Vector3d& own,
             double most)
{
  constexpr double THICKEST = 2.25;
  // A sample inside has its neighbours all around it.
  constexpr double LEAST_OFFSET = 0.5;
  constexpr double FARTHEST = 1.0;
  Sheet near (normals, own);
  Sheet far (normals, -own);
  // Most samples have no far one.
  if (!far.fit (positions) || !near.fit (positions))
    return std::nullopt;
  // Noise turns some normals over.
  partByHeight (positions, near, far);
  if (!far.fit (positions) || !near.fit (positions) || far.meanSquare() > most ||
      near.meanSquare() > most)
    return std::nullopt;
  const Eigen::Vector3d& n = near.plane.normal;
  const double thickness = n.dot (near.plane.center - far.plane.center);
  if (n.dot (far.plane.normal) > -LEAST_COSINE || thickness <= 0.0 ||
      thickness > THICKEST)
    return std::nullopt;
  // From where the points are to where the sample is.
  const Eigen::Vector3d middle = 0.5 * (near.plane.center + far.plane.center);
  const Eigen::Vector3d offset = n.dot (middle) * n - middle;
  if (offset.norm() < LEAST_OFFSET)
    return std::nullopt;
  const Eigen::Vector3d outward = offset.normalized();
  const RimFrame frame{outward, n.cross (outward)};
  const double end = frame.endOf (near, positions);
  const double far_end = frame.endOf (far, positions);
  if (!(std::abs (end) <= FARTHEST && std::abs (end - far_end) <= FARTHEST) ||
      frame.goesOn (positions, std::max (end, far_end)))
    return std::nullopt;
  PlateRim rim;
  rim.foot = end * outward + n.dot (near.plane.center) * n;
  rim.direction = frame.along;
  rim.normal = (n + outward).normalized();
  rim.of_sheets = (near.plane.residual + far.plane.residual) /
                  static_cast<double> (near.points.size() + far.points.size());
  rim.of_one_plane = rim.of_sheets + 0.25 * thickness * thickness;
  return rim;
}

} // namespace crest
} // namespace pcl
