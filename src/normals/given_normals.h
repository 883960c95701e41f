// SPDX-License-Identifier: BSD-3-Clause
// Normals that come with a cloud: checked, and repaired where it is certain how.
#pragma once

#include <pcl_crest/normal_estimation.h>

#include "base/progress.h"

namespace pcl {
namespace crest {

/** \brief Checks the normals of a cloud against each other and the surface.
 *
 * Lengths and missing normals are counted. Whether signs contradict each other is
 * looked for between points that follow each other along a curve through all of them: a
 * look that costs little beside any other stage. Only where it finds something are
 * signs made consistent as those of estimated normals are (see findConsistentSigns),
 * with the given normals for the windows'. A sign that this contradicts for sure is
 * turned; the side of a part is that of most of its given normals, and only where these
 * are divided that of estimated ones. Missing normals are estimated.
 *
 * \param[in] cloud that has normals
 * \param[in] hints for parts that are divided
 */
NormalCheck
checkNormals (const PointView& cloud, const NormalHints& hints, const Workers& workers);

/** \brief Whether any finite point of a cloud has a normal that can be used. */
bool
hasNormals (const PointView& cloud);

} // namespace crest
} // namespace pcl
