// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "surface/surface_graph.h"

#include <vector>

namespace pcl {
namespace crest {

/** \brief Walks a graph from a node outward. What it has seen is kept in a small hash
 * table, so that neither making nor starting one takes time that grows with the graph.
 */
class NodeWalk {
public:
  explicit NodeWalk (const SurfaceGraph& graph) : graph_ (graph), table_ (1024, 0) {}

  void
  start (index_t node)
  {
    walk_ += NEXT_WALK;
    size_ = 0;
    seen_ = 0;
    const index_t* const first = &node;
    reach (first, first + 1);
  }

  /** \brief Reaches the neighbours of a node that were not seen. */
  void
  expand (index_t node)
  {
    const Star star = graph_.star (node);
    reach (star.begin(), star.end());
  }

  /** \brief The same of those that are accepted; others are not asked for again. */
  template <typename Accept>
  void
  expand (index_t node, const Accept& accept)
  {
    const std::size_t first = size_;
    expand (node);
    const std::size_t last = size_;
    size_ = first;
    for (std::size_t i = first; i < last; ++i) {
      const index_t q = reached_[i];
      reached_[size_] = q;
      size_ += accept (q) ? 1 : 0;
    }
  }

  /** \brief The number of nodes reached so far. */
  std::size_t
  size () const
  {
    return size_;
  }

  /** \brief The i-th of the nodes in the order in which they were reached. */
  index_t
  operator[] (std::size_t i) const
  {
    return reached_[i];
  }

private:
  /** A slot has a node in its lower half and the walk that filled it in the upper;
   * those of other walks count as empty. */
  using Slot = std::uint64_t;
  static constexpr Slot NEXT_WALK = Slot{1} << 32;

  /** \brief Half of the table at least stays empty. */
  void
  makeRoom (std::size_t nodes)
  {
    while (2 * (seen_ + nodes) > table_.size())
      grow();
    if (size_ + nodes > reached_.size())
      reached_.resize (2 * (size_ + nodes));
  }

  void
  reach (const index_t* first, const index_t* last)
  {
    makeRoom (static_cast<std::size_t> (last - first));
    index_t* const end = reached_.data() + size_;
    std::size_t reached = 0;
    for (; first != last; ++first) {
      // Whether it was seen is as good as random: there is no branch for it.
      end[reached] = *first;
      reached += see (*first) ? 1 : 0;
    }
    size_ += reached;
    seen_ += reached;
  }

  /** \brief Returns whether the node was not seen before. */
  bool
  see (index_t node)
  {
    const Slot key = walk_ | static_cast<std::uint32_t> (node);
    const std::size_t mask = table_.size() - 1;
    // Neighbours in the cloud have similar indices: they spread by themselves.
    for (std::size_t i = static_cast<std::size_t> (node) & mask;; i = (i + 1) & mask) {
      // Zero for the same node, less than a walk for another of this walk.
      const Slot difference = table_[i] ^ key;
      if (difference - 1 < NEXT_WALK - 1)
        continue;
      table_[i] = key;
      return difference != 0;
    }
  }

  void
  grow ()
  {
    std::vector<Slot> old (2 * table_.size(), 0);
    old.swap (table_);
    for (const Slot slot : old)
      if (slot >= walk_)
        see (static_cast<index_t> (slot & (NEXT_WALK - 1)));
  }

  const SurfaceGraph& graph_;
  std::vector<Slot> table_;
  /** in the upper half, as in slots */
  Slot walk_ = 0;
  std::vector<index_t> reached_;
  std::size_t size_ = 0;
  /** more than were reached, where not all were accepted */
  std::size_t seen_ = 0;
};

} // namespace crest
} // namespace pcl
