// SPDX-License-Identifier: BSD-3-Clause
// What is near a node in space, which where nothing else is in the way is what is near
// along the surface: a search that nodes share costs less than a walk of each.
#pragma once

#include "base/parallel.h"
#include "curvature/pyramid.h"
#include "search/leaf_search.h"

#include <algorithm>

namespace pcl {
namespace crest {

/** \brief A node as others see it. */
struct SeenNode {
  Eigen::Vector3f position = Eigen::Vector3f::Zero();
  float weight = 0.0F;
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();
  /** whether the graph leaves it alone, as beside a sharp edge, which is not looked
   * across */
  bool is_alone = false;
};

/** \brief The nodes of a level in the order of its tree. */
std::vector<SeenNode>
nodesInTreeOrder (const PyramidLevel& level, const Workers& workers);

/** \brief Others than a node, by their places in the tree: the nearest first. */
struct NearNodes {
  const PointTree& tree;
  const std::int32_t* places;
  const float* squared_distances;
  std::size_t count;

  /** \brief The node that is i-th nearest. */
  index_t
  indexOf (std::size_t i) const
  {
    return tree.index (places[i]);
  }
};

/** Least cosine between normals of nodes that are certainly on one sheet. */
constexpr float SAME_SHEET_COSINE = 0.2F;

/** \brief Of so many nodes that are used so many may be on other sheets: with more,
 * what is near in space may not be so along the surface.
 */
constexpr int
mostOthers (int nodes)
{
  return nodes / 8;
}

/** \brief Calls use (place, node, near) for the nodes of some places that are needed.
 * \param[in] nearest how many others are near
 * \param[in] first, last a block of places in the tree, of whole leaves
 */
template <typename Use>
void
visitNearNodes (const PointTree& tree,
                const std::vector<std::uint8_t>& needed,
                int nearest,
                std::size_t first,
                std::size_t last,
                const Use& use)
{
  static_assert (BLOCK_SIZE % LEAF_SIZE == 0, "blocks have whole leaves");
  LeafSearch search (tree, {nearest});
  for (std::size_t place = first; place < last; place += LEAF_SIZE) {
    const PointLeaf& leaf = tree.leaves[place / LEAF_SIZE];
    const std::size_t size = std::min<std::size_t> (LEAF_SIZE, last - place);
    if (std::none_of (leaf.index, leaf.index + size, [&needed] (std::int32_t node) {
          return needed[node] != 0;
        }))
      continue;
    const LeafNeighbors& found = search.searchLeaf (place / LEAF_SIZE);
    for (int i = 0; i < found.count; ++i)
      if (needed[leaf.index[i]] != 0)
        use (found.first + i,
             leaf.index[i],
             NearNodes{tree,
                       found.places + found.offsets[i],
                       found.squared_distances + found.offsets[i],
                       found.offsets[i + 1] - found.offsets[i]});
  }
}

} // namespace crest
} // namespace pcl
