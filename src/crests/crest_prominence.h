// SPDX-License-Identifier: BSD-3-Clause
// How far crests stand out from what is beside them, for the auto preset.
#pragma once

#include "crests/crest_profile.h"

namespace pcl {
namespace crest {

/** \brief How a crest stands out from what is beside it. */
struct Prominence {
  /** how far |k1| falls beside it until it rises again, as a part of it: 0 where it
   * only rises, 1 where nothing of its sign is left, more where that turns */
  float fall = 0.0F;
  /** how far it has fallen halfway to where it is half, as a part of it, on the side
   * where that is less: about an eighth on any smooth crest, nothing on a blend of
   * constant radius; infinite where that is not known, for noise or as data end, or it
   * is half within five spacings */
  float shoulders = std::numeric_limits<float>::infinity();
};

/** \brief Measures how far |k1| falls beside each crest point until it rises again, as
 * a part of it: of the two sides the smaller part, unless data end on one. Along the
 * surface it is followed from sample to sample.
 *
 * Where data end the fits have errors of their own. It is 1 for points of the coarsest
 * level, but 0 where data end beside their fits, as for those of any fit over more than
 * a radian.
 *
 * \param[in] points, graph, profiles the samples and what was found out about them
 * \param[in] crest_points which of them are crest points
 * \param[in] workers a number of threads, 0 for all processors
 * \return that of each crest point
 */
std::vector<Prominence>
measureProminence (const OrientedPoints& points,
                   const SurfaceGraph& graph,
                   const std::vector<CrestProfile>& profiles,
                   const std::vector<CrestType>& crest_points,
                   const Workers& workers);

} // namespace crest
} // namespace pcl
