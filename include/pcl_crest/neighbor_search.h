// SPDX-License-Identifier: BSD-3-Clause
// Paper, section 4.1: the k closest neighbours.
#pragma once

#include <pcl_crest/oriented_points.h>
#include <pcl_crest/parameters.h>

#include <functional>
#include <memory>

namespace pcl {
namespace crest {

/** \brief Finds the candidate neighbours of a packed point. Any order; may hold the
 * point itself, and points twice; must be callable from several threads at once.
 */
using NeighborSearch = std::function<void (index_t point, std::vector<index_t>& found)>;

struct PointTree;

/** \brief The most candidates of a point, itself among them: k and those equally far.
 */
constexpr int
mostCandidates (int k)
{
  return 8 * k;
}

/** \brief Leaves mostCandidates of what was found for a point: the point and the
 * nearest others, of equally near ones (in floats, as the batched search has them)
 * those of lowest index. Whichever search found them, they are the same.
 *
 * \param[in] points, point, k as in the search
 * \param[in,out] found packed points, in any order
 */
void
keepNearest (const OrientedPoints& points,
             index_t point,
             int k,
             std::vector<index_t>& found);

/** \brief The default: PCL's KdTree over the packed points, scaled to about the unit
 * box, since squares of very large or small coordinates do not fit into its floats, by
 * a power of two, which rounds nothing.
 *
 * \param[in] points to search in, which have to outlive the search
 * \param[in] parameters k and radius are used
 */
NeighborSearch
kdTreeSearch (const OrientedPoints& points, const Parameters& parameters);

/** \brief The tree of the batched search (search/point_tree.h) over the packed points.
 * \param[in] threads 0 for all processors
 */
std::shared_ptr<const PointTree>
batchedTree (const OrientedPoints& points, unsigned threads);

/** \brief Calls use (point, found) for points of such a tree, with their candidate
 * neighbours: exactly those that kdTreeSearch finds for a k, the point among them.
 * \param[in] first, last places in the tree; first is a multiple of LEAF_SIZE
 */
void
visitLeaves (
    const PointTree& tree,
    int k,
    std::size_t first,
    std::size_t last,
    const std::function<void (index_t point, const std::vector<index_t>& found)>& use);

/** \brief The same for single points, in any order. */
NeighborSearch
batchedSearch (const std::shared_ptr<const PointTree>& tree, int k);

} // namespace crest
} // namespace pcl
