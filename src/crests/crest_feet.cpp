// SPDX-License-Identifier: BSD-3-Clause
#include "crests/crest_feet.h"

#include <algorithm>
#include <cmath>

namespace pcl {
namespace crest {

OrientedPoints
moveToCrests (const OrientedPoints& points,
              const SurfaceGraph& graph,
              const std::vector<CrestProfile>& profiles)
{
  // In spacings.
  constexpr float FARTHEST_FOOT = 2.0F;
  // What is farther from the surface than noise explains is a sharp edge that a coarse
  // fit has rounded off: it stays where it is.
  constexpr float NOISE_LIMIT = 4.0F;
  constexpr float LEAST_NOISE = 0.01F;

  OrientedPoints moved = points;
  for (std::size_t i = 0; i < profiles.size(); ++i) {
    const CrestProfile& profile = profiles[i];
    if (!profile.curvature.valid)
      continue;
    const float limit =
        NOISE_LIMIT * std::max (profile.noise, LEAST_NOISE * graph.spacing[i]);
    moved.positions[i] += std::clamp (profile.height, -limit, limit) * profile.normal;
    const float u = profile.foot;
    if (std::abs (u) < FARTHEST_FOOT * graph.spacing[i])
      moved.positions[i] += u * profile.curvature.t1 -
                            0.5F * profile.curvature.k1 * u * u * profile.normal;
  }
  return moved;
}

} // namespace crest
} // namespace pcl
