// SPDX-License-Identifier: BSD-3-Clause
// Union-find.
#pragma once

#include <pcl_crest/types.h>

#include <algorithm>
#include <numeric>
#include <vector>

namespace pcl {
namespace crest {

/** \brief Sets of the numbers below a size, at first each alone. The lowest member
 * stands for a set.
 */
class DisjointSets {
public:
  explicit DisjointSets (std::size_t size) : parent_ (size)
  {
    std::iota (parent_.begin(), parent_.end(), 0);
  }

  index_t
  find (index_t x)
  {
    while (parent_[x] != x)
      x = parent_[x] = parent_[parent_[x]];
    return x;
  }

  /** \brief Returns whether a and b were apart. */
  bool
  unite (index_t a, index_t b)
  {
    a = find (a);
    b = find (b);
    parent_[std::max (a, b)] = std::min (a, b);
    return a != b;
  }

  /** \brief What find returns for each, until sets are united again. */
  const std::vector<index_t>&
  flatten ()
  {
    // Parents are lower, so that they are done before.
    for (index_t& parent : parent_)
      parent = parent_[parent];
    return parent_;
  }

private:
  std::vector<index_t> parent_;
};

} // namespace crest
} // namespace pcl
