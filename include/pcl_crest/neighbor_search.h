// SPDX-License-Identifier: BSD-3-Clause
// Paper, section 4.1: the k closest neighbours.
#pragma once

#include <pcl_crest/oriented_points.h>
#include <pcl_crest/parameters.h>

#include <functional>

namespace pcl {
namespace crest {

/** \brief Finds the candidate neighbours of a packed point. Any order; may hold the
 * point itself, and points twice; must be callable from several threads at once.
 */
using NeighborSearch = std::function<void (index_t point, std::vector<index_t>& found)>;

/** \brief The default: PCL's KdTree over the packed points, moved and scaled to the
 * unit box, since squares of very large or small coordinates do not fit into its
 * floats. \param[in] points to search in \param[in] parameters k and radius are used
 */
NeighborSearch
kdTreeSearch (const OrientedPoints& points, const Parameters& parameters);

} // namespace crest
} // namespace pcl
