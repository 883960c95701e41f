// SPDX-License-Identifier: BSD-3-Clause
// What there is to say about a line beside its course.
#pragma once

#include "lines/crest_lines.h"

namespace pcl {
namespace crest {

/** \brief Fills in length, strength and mean curvature of lines.
 * \param[in] threads how many, 0 for all processors
 */
void
measureLines (const OrientedPoints& points,
              const std::vector<PrincipalCurvature>& curvature,
              unsigned threads,
              std::vector<CrestLine>& lines);

/** \brief Fills in the kinds of ends of lines, given all lines that are kept. An end is
 * at the boundary if its point or a neighbour of that is a boundary point.
 */
void
classifyEnds (const SurfaceGraph& graph, std::vector<CrestLine>& lines);

/** \brief Fills in what profiles tell: turning angle and scale. */
void
measureProfiles (const std::vector<CrestProfile>& profiles,
                 const std::vector<CrestType>& crest_points,
                 std::vector<CrestLine>& lines);

} // namespace crest
} // namespace pcl
