// SPDX-License-Identifier: BSD-3-Clause
// The neighbours of a single point, for where no guess of their distance is good.
#pragma once

#include "search/kernels.h"

#include <cstdint>
#include <vector>

namespace pcl {
namespace crest {

/** \brief A neighbour, or a node of the tree that may have some. */
struct Ranked {
  /** squared distance, then (lowest) index: squares are not negative, so that the bits
   * of such floats are in their order */
  std::uint64_t key;
  /** the place of a point, else a node's number in its level */
  std::int32_t number;
  /** of a node: 0 for leaves, 1 for groups over these */
  std::int32_t height;
};

/** \brief Visits nodes in the order of (squared distance, lowest index) until no other
 * can hold a nearer neighbour (Hjaltason and Samet 1999): few, even among many
 * coincident points or where a cluster is far from all others.
 */
class NearestFirst {
public:
  NearestFirst (const PointTree& tree, const Kernels& kernels);

  /** \brief The nearest neighbours of the point at a place, sorted.
   *
   * \param[in] count how many of them
   * \param[in] limit on the squared distance
   * \return valid until the next search
   */
  const std::vector<Ranked>&
  search (std::int32_t place, const float* point, std::size_t count, float limit);

private:
  void
  visitLeaf (std::int32_t leaf, std::int32_t self, const float* point);
  void
  visitGroup (const Ranked& node, const Box& box);
  std::uint64_t
  worstKey () const;

  const PointTree& tree_;
  const Kernels& kernels_;
  std::size_t count_ = 0;
  float limit_ = 0.0F;
  /** a heap, nearest at its front */
  std::vector<Ranked> nodes_;
  /** a heap, farthest at its front */
  std::vector<Ranked> found_;
};

/** \brief The squared distance of a neighbour. */
float
squaredDistanceOf (const Ranked& ranked);

} // namespace crest
} // namespace pcl
