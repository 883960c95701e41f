// SPDX-License-Identifier: BSD-3-Clause
// Which lines a person would draw: significance, for the auto preset.
#pragma once

#include "crests/crest_prominence.h"
#include "lines/crest_lines.h"

namespace pcl {
namespace crest {

/** \brief What the points of lines tell about the significance of these. */
struct CrestEvidence {
  const SurfaceGraph& graph;
  const std::vector<CrestProfile>& profiles;
  const std::vector<CrestType>& crest_points;
  /** see measureProminence */
  std::vector<Prominence> prominence;
};

/** \brief Removes the branches whose points do not bear them out: few of them are crest
 * points, or the surface turns across them by less than `angle` degrees, or they are
 * ripples on the side of a larger crest. Of a branch that nearly all points bear out
 * but not all, the weaker end goes alone; rungs between two lines go that only their
 * junctions bear out. What this leaves of growth at ends goes too.
 *
 * \param[in] points where the lines run
 * \param[in] evidence of the same points
 * \param[in] edges of one type
 * \param[in] limits for each point the greatest length of a branch to prune again
 * \param[in] angle in degrees; below 25, lower ripples count, too
 */
std::vector<CrestEdge>
significantBranches (const OrientedPoints& points,
                     const CrestEvidence& evidence,
                     std::vector<CrestEdge> edges,
                     const std::vector<float>& limits,
                     double angle);

/** \brief Keeps the lines that are significant as a whole: long against the spacing,
 * their scale and their width, certain beyond chance, and across which the surface
 * turns enough.
 */
std::vector<CrestLine>
significantLines (const OrientedPoints& points,
                  const CrestEvidence& evidence,
                  std::vector<CrestLine> lines,
                  const Parameters& parameters);

} // namespace crest
} // namespace pcl
