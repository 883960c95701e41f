// SPDX-License-Identifier: BSD-3-Clause
// The words that all stages share: the two types of crest, the label codes, how a
// surface bends; and what of the shared libraries others may call.
#pragma once

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

// All else is hidden.
#if defined(__GNUC__)
#define PCL_CREST_EXPORT __attribute__ ((visibility ("default")))
#else
#define PCL_CREST_EXPORT
#endif

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

/** \brief The principal curvatures at a point, in 1 / (the cloud's unit).
 *
 * k1 is the larger in absolute value (section 3). Curvature is positive where the
 * surface is convex seen from the side that the normal points to, so that ridges are
 * positive with outward normals. t1 is the unit direction of k1 in the tangent plane;
 * its sign means nothing.
 */
struct PrincipalCurvature {
  float k1;
  float k2;
  Eigen::Vector3f t1;
  /** false where the surface around the point does not determine them; k1 and k2 are
   * then 0 */
  bool valid;
};

} // namespace crest
} // namespace pcl
