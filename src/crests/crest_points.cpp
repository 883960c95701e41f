// SPDX-License-Identifier: BSD-3-Clause
#include "crests/crest_points.h"

#include "base/large_arrays.h"
#include "base/parallel.h"

#include <algorithm>
#include <cmath>

namespace pcl {
namespace crest {

namespace {

/** \brief The neighbours of a point closest to the direction t1 and to -t1. */
struct Across {
  index_t ahead = OrientedPoints::INVALID;
  index_t behind = OrientedPoints::INVALID;
};

Across
neighborsAcross (const OrientedPoints& points,
                 index_t point,
                 const Star& star,
                 const Eigen::Vector3f& direction)
{
  const Eigen::Vector3d n = points.normals[point].cast<double>();
  const Eigen::Vector3d t = direction.cast<double>();
  Across across;
  // Regular samples lie in pairs beside t1: rounding must not choose between them.
  constexpr double EQUAL_COSINE = 1e-6;
  double most_ahead = 0.0;
  double most_behind = 0.0;
  for (const index_t q : star) {
    const Eigen::Vector3d e = points.edge (point, q);
    const double height = e.dot (n);
    const double squared = e.squaredNorm();
    const double in_plane = squared - height * height;
    // Straight above or below the point there is no direction.
    if (in_plane <= 1e-12 * squared)
      continue;
    const double cosine = e.dot (t) / std::sqrt (in_plane);
    if (cosine > most_ahead + EQUAL_COSINE) {
      most_ahead = cosine;
      across.ahead = q;
    }
    if (cosine < most_behind - EQUAL_COSINE) {
      most_behind = cosine;
      across.behind = q;
    }
  }
  return across;
}

double
maximalityAt (const OrientedPoints& points,
              index_t point,
              const Star& star,
              const std::vector<PrincipalCurvature>& curvature)
{
  const PrincipalCurvature& own = curvature[point];
  if (!own.valid || own.k1 == 0.0F || own.k1 == -own.k2)
    return 0.0;
  const Across across = neighborsAcross (points, point, star, own.t1);
  if (across.ahead == OrientedPoints::INVALID ||
      across.behind == OrientedPoints::INVALID)
    return 0.0;
  const PrincipalCurvature& ahead = curvature[across.ahead];
  const PrincipalCurvature& behind = curvature[across.behind];
  if (!ahead.valid || !behind.valid)
    return 0.0;
  const auto squared = [] (float k) { return static_cast<double> (k) * k; };
  return std::max (
      0.0, squared (own.k1) - std::max (squared (ahead.k1), squared (behind.k1)));
}

} // namespace

std::vector<double>
measureMaximality (const OrientedPoints& points,
                   const SurfaceGraph& graph,
                   const std::vector<PrincipalCurvature>& curvature,
                   const Workers& workers)
{
  std::vector<double> maximality = makeLarge (points.size(), 0.0);
  forEachBlock (
      points.size(), workers, [&] (std::size_t, std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
          const auto point = static_cast<index_t> (i);
          maximality[i] = maximalityAt (points, point, graph.star (point), curvature);
        }
      });
  return maximality;
}

std::vector<CrestType>
classifyCrestPoints (const std::vector<PrincipalCurvature>& curvature,
                     const std::vector<double>& maximality,
                     const PerType<double>& threshold)
{
  std::vector<CrestType> types (curvature.size(), CrestType::NONE);
  for (std::size_t i = 0; i < types.size(); ++i) {
    const CrestType type =
        curvature[i].k1 > 0.0F ? CrestType::RIDGE : CrestType::VALLEY;
    if (maximality[i] > threshold[type])
      types[i] = type;
  }
  return types;
}

} // namespace crest
} // namespace pcl
