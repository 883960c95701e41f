// SPDX-License-Identifier: BSD-3-Clause
#include "creases/sharp_profiles.h"

#include <Eigen/Geometry>

#include "curvature/scale_fit.h"

#include <cmath>

namespace pcl {
namespace crest {

namespace {

CrestProfile
profileOf (const Crease& crease, float spacing, float noise)
{
  // Beyond any doubt.
  constexpr float Z = 100.0F;
  const float angle = crease.angle * static_cast<float> (M_PI / 180.0);
  const float sign = crease.type == CrestType::RIDGE ? 1.0F : -1.0F;
  CrestProfile profile;
  profile.curvature = {sign * angle / (2.0F * spacing),
                       0.0F,
                       crease.direction.cross (crease.normal).normalized(),
                       true};
  profile.normal = crease.normal;
  profile.peak_z = Z;
  // The inverse of turningAngle.
  profile.sharpness = 32.0F / (9.0F * angle * angle);
  profile.fall = 1.0F;
  profile.noise = noise;
  profile.radius = spacing;
  profile.resolved = true;
  profile.sharp = true;
  return profile;
}

CrestProfile
profileOf (const ScaleFit& fit)
{
  CrestProfile profile;
  if (!fit.valid)
    return profile;
  profile.curvature = {
      static_cast<float> (fit.k1), static_cast<float> (fit.k2), fit.t1, true};
  profile.normal = fit.normal;
  profile.noise = static_cast<float> (fit.noise);
  profile.radius = static_cast<float> (fit.radius);
  return profile;
}

} // namespace

std::vector<CrestProfile>
profileSharpCrests (const OrientedPoints& points,
                    const SurfaceGraph& graph,
                    const SharpLines& lines,
                    const Workers& workers)
{
  std::vector<CrestProfile> profiles =
      profileCrests (points, withoutPoints (graph, lines.blocked), workers);
  // Narrow strips between lines have too few samples left for a profile, too.
  std::vector<std::uint8_t> needed = lines.blocked;
  for (std::size_t i = 0; i < profiles.size(); ++i)
    if (!profiles[i].curvature.valid)
      needed[i] = 1;
  const std::vector<ScaleFit> fits =
      fitAtScale (finestLevel (points, graph), FINEST_SCALE_NODES, needed, workers);
  for (std::size_t i = 0; i < profiles.size(); ++i)
    if (needed[i] != 0)
      profiles[i] = profileOf (fits[i]);
  for (const SharpNode& node : lines.nodes)
    profiles[node.point] =
        profileOf (node.crease, graph.spacing[node.point], profiles[node.point].noise);
  return profiles;
}

} // namespace crest
} // namespace pcl
