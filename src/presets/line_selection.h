// SPDX-License-Identifier: BSD-3-Clause
// Paper, section 4.7: which of the lines are kept, and how their points are labelled.
#pragma once

#include "presets/pipeline.h"

namespace pcl {
namespace crest {

/** \brief The lines that are kept. */
struct SelectedLines {
  /** ridges first, of each type the largest first */
  std::vector<CrestLine> lines;
  /** for each packed point where lines run by it; empty if through the points
   * themselves */
  std::vector<Eigen::Vector3f> positions;
};

/** \brief Keeps the lines of the wanted types that have min_size points, measures
 * them, and removes those below min_strength.
 * \param[in] traced of at least the wanted types, with these parameters but for
 * min_size, min_strength and positions
 */
SelectedLines
selectLines (const OrientedPoints& points,
             const SurfaceShape& shape,
             const Crests& traced,
             const Parameters& parameters);

/** \brief The label of each packed point. A point joined by growth that lies on lines
 * of both types belongs to the larger one, of equals to the longer.
 * \param[in] parameters wanted, boundaries and threads are used
 */
std::vector<Label>
labelPoints (const SurfaceShape& shape,
             const std::vector<CrestType>& crest_points,
             const std::vector<CrestLine>& lines,
             const Parameters& parameters);

} // namespace crest
} // namespace pcl
