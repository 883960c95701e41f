// SPDX-License-Identifier: BSD-3-Clause
// Hints for normals in the unit of a tree.
#pragma once

#include <pcl_crest/normal_estimation.h>

#include "search/distinct_points.h"

namespace pcl {
namespace crest {

/** \brief The hints in the unit of a tree over the distinct points. */
inline NormalHints
hintsFor (const NormalHints& hints, const DistinctPoints& distinct, double unit)
{
  const auto scaledPlace = [&] (const Eigen::Vector3f& place) -> Eigen::Vector3f {
    return distinct.fromViewpoint (place) / static_cast<float> (unit);
  };
  NormalHints scaled = hints;
  if (hints.viewpoint)
    scaled.viewpoint = scaledPlace (*hints.viewpoint);
  scaled.origin = scaledPlace (hints.origin);
  return scaled;
}

} // namespace crest
} // namespace pcl
