// SPDX-License-Identifier: BSD-3-Clause
// All points near a place.
#pragma once

#include "search/point_tree.h"

#include <functional>
#include <vector>

namespace pcl {
namespace crest {

/** \brief Finds the points of a tree that are nearer to a place than a radius.
 * \param[in] tree to search
 * \param[in] centre x, y and z in the unit of the points that the tree was built from
 * \param[in] radius in that unit
 * \param[out] found their indices in what the tree was built from, in no special order
 */
void
findWithin (const PointTree& tree,
            const float* centre,
            double radius,
            std::vector<std::int32_t>& found);

/** \brief Whether a condition holds of any of these points, by their indices: the first
 * that is found of it ends the search.
 */
bool
anyWithin (const PointTree& tree,
           const float* centre,
           double radius,
           const std::function<bool (std::int32_t)>& holds);

} // namespace crest
} // namespace pcl
