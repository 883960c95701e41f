// SPDX-License-Identifier: BSD-3-Clause
// To which side connected parts look.
#pragma once

#include <pcl_crest/normal_estimation.h>

#include "normals/plane_fits.h"

namespace pcl {
namespace crest {

/** \brief Signed normals of samples and the parts they belong to, by their places. */
struct SignedParts {
  /** of unit length or zero, consistent over each part */
  std::vector<Eigen::Vector3f> normals;
  /** of each sample its part, or -1 */
  std::vector<index_t> part;
  /** of each part how far rays bear out that it looks outward, 1 to -1, or 0 */
  std::vector<float> outward;
};

/** \brief The side of a part, and whether its normals have to be turned over for it. */
struct PartSide {
  NormalSide side = NormalSide::UP;
  bool turned = false;
  float trust = 0.0F;
};

/** The trust in a side that is a guess. */
constexpr float A_GUESS = 0.4F;
static_assert (A_GUESS < SURE_SIGN, "a guess is not sure");

/** The largest sum of the normals of a closed part, of its area: a quarter leaves room
 * for scans with holes and uneven sampling; a hemisphere has one half, a height field
 * nearly one.
 */
constexpr double MOST_OPEN = 0.25;

struct PartSides {
  std::vector<PartSide> of_parts;
  /** whether all may be what a sensor at the viewpoint saw: nearly all of the surface
   * shows it one side, and is not one closed part around it, which is rather a model
   * around its origin */
  bool may_be_view = false;
};

/** \brief Decides the sides of parts: outward of those that are closed, that is whose
 * normals add up to nothing much and whose signed volume by the divergence theorem is
 * not zero, or that rays find an inside of; of others toward the viewpoint, if there is
 * one and most of the part faces it or most faces away, which is a guess if it is
 * assumed; else up.
 *
 * \param[in] hints in the unit of the fits
 */
PartSides
decideSides (const PlaneFits& fits, const SignedParts& parts, const NormalHints& hints);

} // namespace crest
} // namespace pcl
