// SPDX-License-Identifier: BSD-3-Clause
// Paper, sections 4.6 and 4.7: branch pruning and removing small lines.
#pragma once

#include <pcl_crest/crest_graph.h>

#include <map>

namespace pcl {
namespace crest {

/** \brief One crest line: a tree of points, or a closed loop.
 *
 * A tree without junction is one polyline; else there is one for each branch between
 * junctions and ends, and neighbouring branches share the junction's point. A closed
 * line has one polyline whose first point is repeated at its end.
 */
struct CrestLine {
  CrestType type = CrestType::NONE;
  /** number of points (4.7) */
  std::size_t size = 0;
  /** sum of the lengths of its edges, in the cloud's unit */
  double length = 0.0;
  bool closed = false;
  /** indices into the cloud that the lines were extracted from */
  std::vector<std::vector<index_t>> polylines;
};

/** \brief How many lines there are of each size: the chart of section 4.7. */
using LineSizes = std::map<std::size_t, std::size_t>;

/** \brief Prunes short branches of a forest (sections 4.5 and 4.6).
 *
 * A branch leads from an end (a point with one edge) to the first junction (a point
 * with more than two); its size is the number of its points, without the junction.
 * Branches of one point go first, then those of up to `largest`, shortest first, and
 * again while pruning makes new ones. Among branches of one size the one of smaller
 * length goes first, then the one whose end has the lower index. The way between two
 * ends without a junction is no branch, it is the line itself, and always stays.
 *
 * \param[in] points for the lengths
 * \param[in] forest the edges of a forest
 * \param[in] largest the largest size to prune; 0 prunes only branches of one point,
 * which the paper does in any case
 * \return the edges that remain
 */
std::vector<CrestEdge>
pruneBranches (const OrientedPoints& points,
               const std::vector<CrestEdge>& forest,
               std::size_t largest);

/** \brief Follows the edges of a forest to lines, in packed indices.
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

/** \brief Removes the lines of fewer than min_size points (section 4.7). */
std::vector<CrestLine>
removeSmallLines (std::vector<CrestLine> lines, std::size_t min_size);

} // namespace crest
} // namespace pcl
