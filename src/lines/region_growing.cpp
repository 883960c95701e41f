// SPDX-License-Identifier: BSD-3-Clause
#include "lines/region_growing.h"

#include <cmath>

namespace pcl {
namespace crest {

std::vector<Membership>
growRegions (const SurfaceGraph& graph,
             const std::vector<PrincipalCurvature>& curvature,
             const std::vector<CrestType>& crest_points,
             CrestType type)
{
  std::vector<Membership> membership (graph.size(), Membership::OUTSIDE);
  for (std::size_t i = 0; i < graph.size(); ++i) {
    if (crest_points[i] != type)
      continue;
    membership[i] = Membership::CREST;
    for (const index_t q : graph.star (static_cast<index_t> (i)))
      if (crest_points[q] == CrestType::NONE && curvature[q].valid)
        membership[q] = Membership::GROWN;
  }
  return membership;
}

std::vector<Membership>
growAlongCrests (const SurfaceGraph& graph,
                 const std::vector<CrestProfile>& profiles,
                 const std::vector<CrestType>& crest_points,
                 const std::vector<CrestType>& likely_points,
                 CrestType type)
{
  std::vector<Membership> membership (graph.size(), Membership::OUTSIDE);
  std::vector<index_t> reached;
  for (std::size_t i = 0; i < graph.size(); ++i)
    if (crest_points[i] == type) {
      membership[i] = Membership::CREST;
      reached.push_back (static_cast<index_t> (i));
    }
  const auto join = [&] (index_t q) {
    const bool free =
        membership[q] == Membership::OUTSIDE && crest_points[q] == CrestType::NONE;
    if (free)
      membership[q] = Membership::GROWN;
    return free;
  };
  for (std::size_t i = 0; i < reached.size(); ++i)
    for (const index_t q : graph.star (reached[i]))
      if (likely_points[q] == type && join (q))
        reached.push_back (q);

  constexpr double FARTHEST_FOOT = 3.0;
  for (const index_t p : reached)
    for (const index_t q : graph.star (p)) {
      const CrestProfile& profile = profiles[q];
      if (profile.curvature.valid &&
          (profile.curvature.k1 > 0.0F) == (type == CrestType::RIDGE) &&
          std::abs (profile.foot) < FARTHEST_FOOT * graph.spacing[q])
        join (q);
    }
  return membership;
}

} // namespace crest
} // namespace pcl
