// SPDX-License-Identifier: BSD-3-Clause
// The inner loops of the search, once in plain C++ and once for each instruction set;
// fits rank neighbours by them, too. All compute the same floats in the same order.
#pragma once

#include "search/point_tree.h"
#include "search/simd.h"

namespace pcl {
namespace crest {

/** \brief A box, or a point as a box without extent. */
struct Box {
  float low[3];
  float high[3];
};

/** Kernels write up to so many elements beyond what they return. */
constexpr int KERNEL_SLACK = 2 * LEAF_SIZE;

struct Kernels {
  /** \brief Squared distances of the eight boxes of a group from a box. In floats, too,
   * none is larger than that of any two points in them, as rounding is monotone.
   * \return bit i is set where that of box i is at most the limit
   */
  unsigned (*boxesWithin) (const BoxGroup& group,
                           const Box& box,
                           float limit,
                           float* squared_distances);

  /** \brief The points of some leaves within a distance of a point.
   * \param[in] numbers, count of the leaves
   * \param[in] self place of the point, which is not among those found; its leaf is the
   * first of the numbers, or none of them is
   * \param[out] squared_distances, places of what was found
   * \return their number
   */
  int (*pointsWithin) (const PointLeaf* leaves,
                       const std::int32_t* numbers,
                       int count,
                       const float* point,
                       std::int32_t self,
                       float limit,
                       float* squared_distances,
                       std::int32_t* places);

  /** \brief For each value how many others are less.
   * \param[in,out] values padded with infinity by this
   * \return whether all values are different
   */
  bool (*rankDistinct) (float* values, int count, std::int32_t* ranks);

  /** \brief For each value how many others are less, or equal with lower index. */
  void (*rankTied) (const float* values,
                    const std::int32_t* indices,
                    int count,
                    std::int32_t* ranks);
};

const Kernels&
portableKernels ();

/** \brief Null where the machine does not have the instructions. */
const Kernels*
sse2Kernels ();
const Kernels*
avx2Kernels ();

/** \brief The portable ones where others are not available. */
const Kernels&
kernelsFor (Simd simd);

} // namespace crest
} // namespace pcl
