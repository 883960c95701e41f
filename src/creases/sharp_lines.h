// SPDX-License-Identifier: BSD-3-Clause
// The sharp lines of a surface, for the auto preset.
#pragma once

#include "creases/crease_lines.h"
#include "search/point_tree.h"

#include <memory>

namespace pcl {
namespace crest {

/** \brief Finds creases and traces them to lines: on the samples, or where noise is
 * more than two planes may leave, on nodes of the surface that have less of it
 * (gatherOnSurface), each line then through the samples nearest to its nodes.
 *
 * \param[in] points, graph the samples
 * \param[in] tree over their positions
 * \param[in] workers a number of threads, 0 for all processors
 */
SharpLines
findSharpLines (const OrientedPoints& points,
                const SurfaceGraph& graph,
                const std::shared_ptr<const PointTree>& tree,
                const Workers& workers);

} // namespace crest
} // namespace pcl
