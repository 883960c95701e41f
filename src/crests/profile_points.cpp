// SPDX-License-Identifier: BSD-3-Clause
#include "crests/profile_points.h"

#include <cmath>

namespace pcl {
namespace crest {

namespace {

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
