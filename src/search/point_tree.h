// SPDX-License-Identifier: BSD-3-Clause
// Points packed for the search of all their nearest neighbours.
#pragma once

#include <pcl_crest/types.h>

#include "search/simd.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace pcl {
namespace crest {

/** Points a leaf of the tree holds, and children a node has: what one AVX register
 * takes.
 */
constexpr int LEAF_SIZE = 8;

/** \brief The points of one leaf, coordinate by coordinate. Where the last leaf is not
 * full, the rest is at infinity, which is no point's neighbour.
 */
struct alignas (64) PointLeaf {
  float x[LEAF_SIZE];
  float y[LEAF_SIZE];
  float z[LEAF_SIZE];
  /** of each point its index in the array that the tree was built from */
  std::int32_t index[LEAF_SIZE];
};

/** \brief Eight sibling nodes: their bounding boxes, and of each the lowest index of
 * its points, by which ties are cut short. Missing siblings are at infinity.
 */
struct alignas (32) BoxGroup {
  float low[3][LEAF_SIZE];
  float high[3][LEAF_SIZE];
  std::int32_t lowest_index[LEAF_SIZE];
};

/** \brief Points in the order of a k-d tree (Bentley 1975) with disjoint leaves, all of
 * eight points but the last, and over them a tree of boxes with eight children a node.
 *
 * A point is known by its *place* in that order: place p is point p % 8 of leaf p / 8.
 * Nodes need no links: group g of a level holds the boxes of groups (at level 0:
 * leaves) 8 g ... 8 g + 7 of the level below. 16 bytes a point and 4 for the boxes.
 */
struct PointTree {
  struct Release {
    void
    operator() (PointLeaf* leaves) const;
  };

  std::size_t size = 0;
  std::unique_ptr<PointLeaf[], Release> leaves;
  /** levels[0] are the boxes of leaves; the last level has a single group */
  std::vector<std::vector<BoxGroup>> levels;
  /** The coordinates in the leaves times this are those that the tree was built from.
   * It is a power of two, so that the leaves' are exact, but squares of very large or
   * small coordinates keep within floats. */
  double unit = 1.0;

  std::size_t
  leafCount () const
  {
    return (size + LEAF_SIZE - 1) / LEAF_SIZE;
  }

  /** \brief The index of the point at a place in the array the tree was built from. */
  std::int32_t
  index (std::int32_t place) const
  {
    return leaves[place / LEAF_SIZE].index[place % LEAF_SIZE];
  }

  /** \brief For each point of that array its place. */
  std::vector<std::int32_t>
  places () const;
};

/** \brief A power of two to measure points in: a cloud is not wider than it, so that
 * squares of distances do not overflow, and coordinates do not either.
 * \param[in] extent largest side of the bounding box of the points
 * \param[in] largest of the absolute values of their coordinates
 */
double
unitFor (double extent, double largest);

/** \brief Builds the tree over points.
 *
 * \param[in] coordinates x, y and z of point i at coordinates + i * stride
 * \param[in] stride in floats, at least 3
 * \param[in] size number of points, at most MOST_POINTS
 * \param[in] threads 0 for all processors; the tree does not depend on it
 * \param[out] tree empty on failure
 * \param[in] simd one that isAvailable; the tree does not depend on it
 * \return what is wrong: too many points, or the first that is not finite; empty if all
 * is well
 */
std::string
buildPointTree (const float* coordinates,
                std::size_t stride,
                std::size_t size,
                unsigned threads,
                PointTree& tree,
                Simd simd = bestSimd());

} // namespace crest
} // namespace pcl
