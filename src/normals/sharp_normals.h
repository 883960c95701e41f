// SPDX-License-Identifier: BSD-3-Clause
// Normals that average neither two faces nor two sheets.
#pragma once

#include "base/progress.h"
#include "normals/plane_fits.h"

namespace pcl {
namespace crest {

/** \brief Gives samples beside sharp edges, where the k nearest lie on several faces,
 * the plane of a window near by that fits its own points at least twice as well, and
 * the sample, too: as Kuwahara et al. 1976 smooth images up to their edges. Where no
 * window does, as on faces narrower than windows, and there is little noise, it is the
 * plane through the sample on which the most of its neighbours are. Else, as on smooth
 * surfaces and in noise, nothing changes.
 *
 * \param[in] tree that the fits were made from
 *
 * \param[in,out] fits their nearest planes change, and where there is hardly any noise
 * those that votes are for, too
 */
void
sharpenNormals (const PointTree& tree, PlaneFits& fits, const Workers& workers);

/** \brief Doubts the signs of samples in the tips of wedges: where the plane of a
 * neighbour that looks the other way passes through them, so that they may be on either
 * side.
 *
 * \param[in] normals of the samples with their signs
 *
 * \param[in,out] trust of these
 */
void
doubtTips (const PointTree& tree,
           const PlaneFits& fits,
           const std::vector<Eigen::Vector3f>& normals,
           const Workers& workers,
           std::vector<float>& trust);

/** \brief The normals of the k nearest with the signs of the windows that noise asked
 * for. Where the two look elsewhere, as at rims of thin plates, the neighbours decide.
 *
 * \param[in] tree that the fits were made from
 *
 * \param[in] fits whose normals have consistent signs
 */
std::vector<Eigen::Vector3f>
signedNormals (const PointTree& tree, const PlaneFits& fits, const Workers& workers);

} // namespace crest
} // namespace pcl
