// SPDX-License-Identifier: BSD-3-Clause
// Whether a cloud can be searched at all, and which of its normals can be used.
#pragma once

#include <pcl_crest/input.h>

#include "base/progress.h"

#include <cstdint>

namespace pcl {
namespace crest {

/** \brief Checks that there are positions, not too many of them.
 *
 * \throw std::invalid_argument in words for the user
 */
void
checkPoints (const PointView& cloud);

/** \brief Whether a normal is finite and not zero. */
inline bool
isUsable (const Eigen::Vector3f& normal)
{
  return normal.allFinite() && !normal.isZero (0.0F);
}

/** \brief Of unit length, whatever the length of a normal that can be used. */
inline Eigen::Vector3d
unitNormalOf (const PointView& cloud, std::size_t i)
{
  return cloud.normalOf (i).cast<double>().stableNormalized();
}

/** \brief A number that differs, for all that is likely, where a position or a normal
 * of two clouds does.
 * \param[in] workers a number of threads, 0 for all processors
 */
std::uint64_t
fingerprint (const PointView& cloud, const Workers& workers = 1);

/** \brief The cloud without its normals. */
inline PointView
positionsOf (PointView cloud)
{
  cloud.normal = nullptr;
  return cloud;
}

} // namespace crest
} // namespace pcl
