// SPDX-License-Identifier: BSD-3-Clause
// Paper, section 4.1: the k closest neighbours.
#pragma once

#include <pcl_crest/parameters.h>

#include "search/position_tree.h"
#include "surface/oriented_points.h"

#include <functional>
#include <memory>
#include <utility>

namespace pcl {
namespace crest {

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

/** \brief A search that is made over the packed points, scaled to about the unit box,
 * since squares of very large or small coordinates do not fit into floats, by a power
 * of two, which rounds nothing.
 *
 * \param[in] points to search in, which have to outlive the search
 * \param[in] make makes it
 * \param[in] parameters k and radius are used
 */
NeighborSearch
searchOver (const OrientedPoints& points,
            const SearchMaker& make,
            const Parameters& parameters);

/** \brief Calls use (point, found) for points of such a tree, with their candidate
 * neighbours: the k nearest, the point among them, and those equally far (see
 * keepNearest). \param[in] first, last places in the tree; first is a multiple of
 * LEAF_SIZE
 */
void
visitLeaves (
    const PointTree& tree,
    int k,
    std::size_t first,
    std::size_t last,
    const std::function<void (index_t point, const std::vector<index_t>& found)>& use);

/** \brief The same for single points, in any order. */
PCL_CREST_EXPORT NeighborSearch
batchedSearch (const std::shared_ptr<const PointTree>& tree, int k);

/** \brief All packed points within a radius, by the same tree.
 * \param[in] radius in the cloud's unit
 */
NeighborSearch
radiusSearch (const OrientedPoints& points,
              const std::shared_ptr<const PointTree>& tree,
              double radius);

/** \brief Where the candidates of all points come from: a search that is asked point by
 * point, or where that is empty the batched search in a tree.
 */
struct NeighborSource {
  NeighborSource() = default;
  NeighborSource (NeighborSearch search) : pointwise (std::move (search)) {}
  NeighborSource (std::shared_ptr<const PointTree> batched) : tree (std::move (batched))
  {}

  NeighborSearch pointwise;
  std::shared_ptr<const PointTree> tree;
};

} // namespace crest
} // namespace pcl
