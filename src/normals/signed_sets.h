// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_crest/types.h>

#include <numeric>
#include <vector>

namespace pcl {
namespace crest {

/** \brief Disjoint sets whose members know whether they are turned against the root. */
class SignedSets {
public:
  explicit SignedSets (std::size_t size) : parent_ (size), turned_ (size, 0)
  {
    std::iota (parent_.begin(), parent_.end(), 0);
  }

  struct Place {
    index_t root;
    bool turned;
  };

  Place
  find (index_t i)
  {
    Place place{i, false};
    while (parent_[place.root] != place.root) {
      place.turned ^= turned_[place.root] != 0;
      place.root = parent_[place.root];
    }
    for (bool turned = place.turned; parent_[i] != place.root && i != place.root;) {
      const index_t next = parent_[i];
      const bool step = turned_[i] != 0;
      parent_[i] = place.root;
      turned_[i] = turned ? 1 : 0;
      turned ^= step;
      i = next;
    }
    return place;
  }

  void
  unite (index_t a, index_t b, bool opposite)
  {
    const Place of_a = find (a);
    const Place of_b = find (b);
    if (of_a.root == of_b.root)
      return;
    parent_[of_b.root] = of_a.root;
    turned_[of_b.root] = (of_a.turned ^ of_b.turned ^ opposite) ? 1 : 0;
  }

private:
  std::vector<index_t> parent_;
  std::vector<char> turned_;
};

} // namespace crest
} // namespace pcl
