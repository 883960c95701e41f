// SPDX-License-Identifier: BSD-3-Clause
// What comes out: crest lines (paper, section 4.7).
#pragma once

#include <pcl_crest/types.h>

#include <array>
#include <map>
#include <vector>

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
  /** mean over its points of how sure the signs of their normals are, 0 to 1: below
   * SURE_SIGN its type is a guess, where it runs is not */
  double sign_trust = 1.0;
};

/** \brief How many lines there are of each size: the chart of section 4.7. */
using LineSizes = std::map<std::size_t, std::size_t>;

} // namespace crest
} // namespace pcl
