// SPDX-License-Identifier: BSD-3-Clause
// The words that all stages share: the two types of crest, the label codes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace pcl {
namespace crest {

/** \brief The place of a point in a cloud, as pcl::index_t is unless PCL was built with
 * larger ones.
 */
using index_t = std::int32_t;

/** The most points that an index_t tells apart. */
constexpr std::size_t MOST_POINTS = std::numeric_limits<index_t>::max();

/** \brief What a crest is (paper, section 3): a ridge where the largest principal
 * curvature is positive (convex seen from the side that the normals point to), a
 * valley where it is negative.
 */
enum class CrestType : std::uint8_t { NONE = 0, RIDGE = 1, VALLEY = 2 };

/** \brief The two types that lines are made of, in the order of every output. */
constexpr std::array<CrestType, 2> CREST_TYPES{CrestType::RIDGE, CrestType::VALLEY};

/** \brief The codes in the label field of the output.
 *
 * RIDGE and VALLEY are the crest points of section 4.3, whether a line that is kept
 * passes through them or not. The points joined by growth (4.4) have a label only
 * where they lie on a line that is kept.
 */
enum Label : std::uint32_t {
  LABEL_NONE = 0,
  LABEL_RIDGE = 1,
  LABEL_VALLEY = 2,
  LABEL_RIDGE_GROWN = 3,
  LABEL_VALLEY_GROWN = 4,
  /** not finite, zero normal, or too few neighbours to fit a quadric to */
  LABEL_INVALID = 5,
  /** where the surface ends (4.1) and no other label applies; only on request */
  LABEL_BOUNDARY = 6
};

} // namespace crest
} // namespace pcl
