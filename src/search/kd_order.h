// SPDX-License-Identifier: BSD-3-Clause
// The order of the points in the tree.
#pragma once

#include "search/kernels.h"

#include <cstddef>

namespace pcl {
namespace crest {

struct PackedPoint {
  float coordinates[3];
  std::int32_t index;
};

/** \brief Sorts points in the order of a k-d tree with leaves of LEAF_SIZE, each split
 * along its widest axis. Groups of leaves of all levels are boxes apart from each
 * other. Which kernels and how many threads does not matter.
 */
void
putInKdOrder (PackedPoint* points,
              std::size_t size,
              const Kernels& kernels,
              int threads);

} // namespace crest
} // namespace pcl
