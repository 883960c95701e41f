// SPDX-License-Identifier: BSD-3-Clause
#include "creases/sharp_profiles.h"

#include <Eigen/Geometry>

#include "base/parallel.h"
#include "creases/place_search.h"
#include "curvature/scale_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>

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

/** \brief Takes the crests from profiles that are the image of a sharp line: windows
 * that reach round its end or through a gap blur it to a crest beside it.
 */
void
dropImages (const OrientedPoints& points,
            const SharpLines& lines,
            const Workers& workers,
            std::vector<CrestProfile>& profiles)
{
  // Of the radius of the window.
  constexpr float NEAR = 0.35F;
  constexpr float PARALLEL = 0.8F;
  std::vector<Eigen::Vector3d> feet;
  for (const SharpNode& node : lines.nodes)
    feet.push_back (node.crease.foot.cast<double>());
  if (feet.empty())
    return;
  const PlaceSearch search (points, feet);
  forEachBlock (
      profiles.size(), workers, [&] (std::size_t, std::size_t i, std::size_t last) {
        std::vector<int> near;
        for (; i < last; ++i) {
          CrestProfile& profile = profiles[i];
          if (lines.blocked[i] != 0 || !std::isfinite (profile.foot))
            continue;
          const Eigen::Vector3f along =
              profile.normal.cross (profile.curvature.t1).normalized();
          const CrestType type =
              profile.curvature.k1 > 0.0F ? CrestType::RIDGE : CrestType::VALLEY;
          search.within (
              points.positions[i].cast<double>(), NEAR * profile.radius, near);
          const bool is_image = std::any_of (near.begin(), near.end(), [&] (int j) {
            const Crease& crease = lines.nodes[j].crease;
            return crease.type == type &&
                   std::abs (crease.direction.dot (along)) > PARALLEL;
          });
          if (is_image) {
            profile.foot = std::numeric_limits<float>::infinity();
            profile.certainty = profile.peak_z = 0.0F;
            profile.resolved = false;
          }
        }
      });
}

} // namespace

std::vector<CrestProfile>
profileSharpCrests (const OrientedPoints& points,
                    const SurfaceGraph& graph,
                    const SharpLines& lines,
                    const std::shared_ptr<const PointTree>& tree,
                    const Workers& workers)
{
  std::vector<CrestProfile> profiles =
      profileCrests (points, withoutPoints (graph, lines.blocked), tree, workers);
  // Narrow strips between lines have too few samples left for a profile, too.
  std::vector<std::uint8_t> needed = lines.blocked;
  for (std::size_t i = 0; i < profiles.size(); ++i)
    if (!profiles[i].curvature.valid)
      needed[i] = 1;
  if (std::find (needed.begin(), needed.end(), 1) != needed.end()) {
    const std::vector<ScaleFit> fits = fitAtScale (
        finestLevel (points, graph, tree), FINEST_SCALE_NODES, needed, workers);
    for (std::size_t i = 0; i < profiles.size(); ++i)
      if (needed[i] != 0)
        profiles[i] = profileOf (fits[i]);
  }
  dropImages (points, lines, workers, profiles);
  for (const SharpNode& node : lines.nodes)
    profiles[node.point] =
        profileOf (node.crease, graph.spacing[node.point], profiles[node.point].noise);
  return profiles;
}

} // namespace crest
} // namespace pcl
