// SPDX-License-Identifier: BSD-3-Clause
// The loops of crest graphs, which a spanning forest cuts, for the auto preset.
#pragma once

#include "lines/spanning_forest.h"

namespace pcl {
namespace crest {

/** \brief Adds the edges that close loops to a forest: those whose ends are apart by
 * more than their limit along what is there already. Smaller loops are no lines of
 * their own but the width of one.
 *
 * \param[in] points for the lengths
 * \param[in] edges the edges that the forest was made of; they are tried in the order
 * in which Kruskal's algorithm tries them
 *
 * \param[in] limits for each point the length up to which a loop stays cut, in the
 * cloud's unit; the larger of an edge's two counts
 * \param[in] forest a minimum spanning forest of the edges
 */
std::vector<CrestEdge>
closeLoops (const OrientedPoints& points,
            std::vector<CrestEdge> edges,
            const std::vector<float>& limits,
            std::vector<CrestEdge> forest);

} // namespace crest
} // namespace pcl
