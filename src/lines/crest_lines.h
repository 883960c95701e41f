// SPDX-License-Identifier: BSD-3-Clause
// Room lines: paper, sections 4.4 to 4.7; here 4.7, the lines, and removing small ones.
//
// Crest points go in, lines come out, by region growing (4.4, region_growing.h),
// minimum spanning forests (4.5, spanning_forest.h) and branch pruning (4.6,
// branch_pruning.h). For the auto preset loops are closed (crest_loops.h), lines judged
// (crest_significance.h) and smoothed (line_smoothing.h); line_measures.h measures
// them. It knows nothing of sharp edges but their profiles, and not which preset calls
// it.
#pragma once

#include <pcl_crest/crest_line.h>

#include "lines/spanning_forest.h"

namespace pcl {
namespace crest {

/** \brief Follows edges, those of closed loops included, to lines in packed indices,
 * largest first.
 *
 * \param[in] points for the lengths
 * \param[in] edges after pruning
 * \param[in] type of the lines
 */
std::vector<CrestLine>
traceLines (const OrientedPoints& points,
            const std::vector<CrestEdge>& edges,
            CrestType type);

/** \brief The same for a forest alone, with the paper's stars.
 *
 * A spanning tree cuts every loop of its crest graph. Where a line without junction,
 * longer than a branch that would be pruned, is cut so that no more than that many
 * points, and no more than a quarter of its own, lead back from one end to the other
 * within the crest graph, these are put back and the line is closed.
 *
 * \param[in] points, graph, membership what the forest was made from
 * \param[in] forest its edges after pruning
 * \param[in] type of the lines
 * \param[in] largest_branch the largest size that was pruned
 * \return the lines, largest first
 */
std::vector<CrestLine>
traceLines (const OrientedPoints& points,
            const SurfaceGraph& graph,
            const std::vector<Membership>& membership,
            const std::vector<CrestEdge>& forest,
            CrestType type,
            std::size_t largest_branch);

/** \brief The distribution of sizes that the choice of S is made from. */
LineSizes
lineSizes (const std::vector<CrestLine>& lines);

/** \brief Whether a line has fewer than min_size points (section 4.7). */
inline bool
isSmall (const CrestLine& line, const PerType<int>& min_size)
{
  return line.size < static_cast<std::size_t> (min_size[line.type]);
}

} // namespace crest
} // namespace pcl
