// SPDX-License-Identifier: BSD-3-Clause
// Paper, section 4.7: the lines, and removing small ones.
#pragma once

#include <pcl_crest/crest_graph.h>

#include <map>

namespace pcl {
namespace crest {

/** \brief Where a polyline of a line ends. */
enum class LineEnd : std::uint8_t {
  FREE,
  /** where it meets other polylines, of its line or, at corners, of the other type */
  JUNCTION,
  /** where the surface ends */
  BOUNDARY,
  /** nowhere: the line is closed */
  CLOSED
};

/** \brief One crest line: a tree of points, or a closed loop, or with
 * the preset AUTO a net of both.
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
  /** for each polyline the kinds of its first and last end */
  std::vector<std::array<LineEnd, 2>> ends{};
  /** integral of |k1| along the line, without unit (Yoshizawa et al. 2005) */
  double strength = 0.0;
  /** strength / length, in 1 / (the cloud's unit) */
  double mean_curvature = 0.0;
  /** mean over its crest points of how far the surface turns across it, in degrees; 0
   * for the preset PAPER, which does not know */
  double turning_angle = 0.0;
  /** mean radius that its curvatures were fitted over, in the cloud's unit; 0 for the
   * preset PAPER, which fits to stars */
  double scale = 0.0;
};

/** \brief How many lines there are of each size: the chart of section 4.7. */
using LineSizes = std::map<std::size_t, std::size_t>;

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
