// SPDX-License-Identifier: BSD-3-Clause
// Room search: the nearest neighbours of all points, leaf by leaf; the tree that holds
// the points (Bentley 1975), and all points within a radius.
//
// Positions go in, places in the tree come out, in exactly the order that comparing all
// points would give. It knows no normals, and neither PCL nor a surface.
#pragma once

#include "search/point_tree.h"
#include "search/simd.h"

#include <memory>

namespace pcl {
namespace crest {

/** \brief Which neighbours to find. */
struct NeighborCount {
  /** the nearest, without the point itself; fewer only where the cloud has no more.
   * Meant for up to some hundred: beyond, the cost of sorting them grows with their
   * square. */
  int nearest = 0;
  /** Beyond these, others that are as far away as the last of them: those whose squared
   * distance is larger by at most this part. */
  double equidistant = 0.0;
  /** the most to find in all, nearest and equidistant; none of the latter by default */
  int most = 0;
};

/** \brief The neighbours of consecutive points, until the next search. */
struct LeafNeighbors {
  /** place of the first of the points, and their number */
  std::int32_t first = 0;
  int count = 0;
  /** point first + i has neighbours offsets[i] ... offsets[i + 1] - 1 of the following,
   * sorted by squared distance, of equal ones by index in the array that the tree was
   * built from */
  std::size_t offsets[LEAF_SIZE + 1] = {};
  const std::int32_t* places = nullptr;
  /** in floats, (dx dx + dy dy) + dz dz, in units of the tree (PointTree::unit) */
  const float* squared_distances = nullptr;
};

/** \brief Finds the nearest neighbours of all points of a leaf at once: its points
 * share the walk through the tree, whose radius is guessed from the leaf before.
 *
 * The result is exact: what comparing all points by (squared distance, index) would
 * give, whatever the instructions, the order of the points and the searches before. One
 * such object belongs to one thread; consecutive leaves are fastest.
 *
 * \code
 * PointTree tree;
 * const std::string error =
 *     buildPointTree (&points[0].x, 3, points.size(), 0, tree);
 * LeafSearch search (tree, {20});
 * for (std::size_t leaf = 0; leaf < tree.leafCount(); ++leaf) {
 *   const LeafNeighbors& found = search.searchLeaf (leaf);
 *   for (int i = 0; i < found.count; ++i)
 *     for (std::size_t j = found.offsets[i]; j < found.offsets[i + 1]; ++j)
 *       use (tree.index (found.first + i), tree.index (found.places[j]));
 * }
 * \endcode
 */
class LeafSearch {
public:
  /** \param[in] tree has to outlive the search
   *
   * \param[in] count what to find
   * \param[in] simd one that isAvailable
   */
  LeafSearch (const PointTree& tree,
              const NeighborCount& count,
              Simd simd = bestSimd());
  ~LeafSearch();

  /** \brief The neighbours of all points of a leaf. */
  const LeafNeighbors&
  searchLeaf (std::size_t leaf);

  /** \brief The neighbours of the point at one place. */
  const LeafNeighbors&
  searchPoint (std::int32_t place);

private:
  class Worker;
  std::unique_ptr<Worker> worker_;
};

} // namespace crest
} // namespace pcl
