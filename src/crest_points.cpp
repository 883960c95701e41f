// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_crest/crest_points.h>

#include "large_arrays.h"
#include "parallel.h"

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

CrestType
classify (const CrestProfile& profile, double spacing, bool resolved, double confidence)
{
  // A half spacing is what a sample stands for; the rest is the error of the foot.
  constexpr double LARGEST_FOOT = 0.6;
  // An ellipse with axes 1 : .95 has .3 at its vertices. Sharp edges are rounded off to
  // arcs whose sharpness is lower than that, but then k1 falls by a lot.
  constexpr double LEAST_SHARPNESS = 0.3;
  constexpr double LEAST_FALL = 0.25;
  // Turns by less than 10 degrees (turningAngle).
  constexpr double LARGEST_SHARPNESS = 115.0;

  const PrincipalCurvature& k = profile.curvature;
  if (profile.sharp)
    return k.k1 > 0.0F ? CrestType::RIDGE : CrestType::VALLEY;
  const bool peak = resolved && profile.peak_z > confidence &&
                    std::abs (profile.foot) < LARGEST_FOOT * spacing;
  const bool distinct =
      profile.sharpness < LARGEST_SHARPNESS &&
      (profile.sharpness > LEAST_SHARPNESS || profile.fall > LEAST_FALL);
  if (!peak || !distinct || std::abs (k.k1) < std::abs (k.k2))
    return CrestType::NONE;
  return k.k1 > 0.0F ? CrestType::RIDGE : CrestType::VALLEY;
}

template <typename IsResolved>
std::vector<CrestType>
classifyEach (const SurfaceGraph& graph,
              const std::vector<CrestProfile>& profiles,
              double confidence,
              const IsResolved& is_resolved)
{
  std::vector<CrestType> types;
  types.reserve (profiles.size());
  for (std::size_t i = 0; i < profiles.size(); ++i)
    types.push_back (classify (
        profiles[i], graph.spacing[i], is_resolved (profiles[i]), confidence));
  return types;
}

} // namespace

PerType<double>
absoluteMaximality (const OrientedPoints& points, const Parameters& parameters)
{
  if (parameters.absolute_maximality || points.extent == 0.0)
    return parameters.maximality;
  constexpr double PAPER_EXTENT = 10.0;
  const double unit = points.extent / PAPER_EXTENT;
  return {parameters.maximality.ridge / (unit * unit),
          parameters.maximality.valley / (unit * unit)};
}

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

std::vector<CrestType>
classifyCrestPoints (const SurfaceGraph& graph,
                     const std::vector<CrestProfile>& profiles,
                     double confidence)
{
  return classifyEach (graph, profiles, confidence, [] (const CrestProfile& profile) {
    return profile.resolved;
  });
}

std::vector<CrestType>
likelyCrestPoints (const SurfaceGraph& graph,
                   const std::vector<CrestProfile>& profiles,
                   double confidence)
{
  return classifyEach (
      graph, profiles, 0.5 * confidence, [] (const CrestProfile& profile) {
        return profile.certainty > 0.0F;
      });
}

} // namespace crest
} // namespace pcl
