// SPDX-License-Identifier: BSD-3-Clause
// Paper, section 4.6: branch pruning.
#pragma once

#include "lines/spanning_forest.h"

namespace pcl {
namespace crest {

/** \brief Prunes short branches of a forest (sections 4.5 and 4.6).
 *
 * A branch leads from an end (a point with one edge) to the first junction (a point
 * with more than two); its size is the number of its points, without the junction.
 * Those of up to `largest` points go, shortest first, and again while pruning makes new
 * ones; branches of one point in any case. Among branches of one size the one of
 * smaller length goes first, then the one whose end has the lower index. The way
 * between two ends without a junction is no branch, it is the line itself, and always
 * stays.
 *
 * \param[in] points for the lengths
 * \param[in] forest the edges of a forest
 * \param[in] largest the largest size to prune; 0 is as good as 1
 * \return the edges that remain
 */
std::vector<CrestEdge>
pruneBranches (const OrientedPoints& points,
               std::vector<CrestEdge> forest,
               std::size_t largest);

/** \brief Prunes the branches that are not longer than the limit of their junction, the
 * one with the shortest part of its limit first, and again while pruning makes new
 * ones.
 *
 * \param[in] points for the lengths
 * \param[in] edges of crest graphs, which may have loops
 * \param[in] limits for each point the greatest length of a branch to prune, in the
 * cloud's unit
 * \return the edges that remain
 */
std::vector<CrestEdge>
pruneShortBranches (const OrientedPoints& points,
                    std::vector<CrestEdge> edges,
                    const std::vector<float>& limits);

} // namespace crest
} // namespace pcl
