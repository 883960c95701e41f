// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_crest/surface_graph.h>

#include <vector>

namespace pcl {
namespace crest {

/** \brief Walks a graph from a node outward. What it has seen is kept in a small hash
 * table, so that neither making nor starting one takes time that grows with the graph.
 */
class NodeWalk {
public:
  explicit NodeWalk (const SurfaceGraph& graph) : graph_ (graph), table_ (1024) {}

  void
  start (index_t node)
  {
    ++walk_;
    filled_ = 0;
    reached_.clear();
    see (node);
    reached_.push_back (node);
  }

  /** \brief Reaches the neighbours of a node that are accepted and were not seen. */
  template <typename Accept>
  void
  expand (index_t node, const Accept& accept)
  {
    for (const index_t q : graph_.star (node))
      if (see (q) && accept (q))
        reached_.push_back (q);
  }

  /** \brief The nodes reached so far, in the order in which they were. */
  const std::vector<index_t>&
  reached () const
  {
    return reached_;
  }

private:
  struct Slot {
    index_t node = 0;
    /** the walk that filled it; others count as empty */
    std::uint32_t walk = 0;
  };

  /** \brief Returns whether the node was not seen before. */
  bool
  see (index_t node)
  {
    if (2 * filled_ >= table_.size())
      grow();
    const std::size_t mask = table_.size() - 1;
    // Neighbours in the cloud have similar indices: they spread by themselves.
    for (std::size_t i = static_cast<std::size_t> (node) & mask;; i = (i + 1) & mask) {
      if (table_[i].walk != walk_) {
        table_[i] = {node, walk_};
        ++filled_;
        return true;
      }
      if (table_[i].node == node)
        return false;
    }
  }

  void
  grow ()
  {
    std::vector<Slot> old (2 * table_.size());
    old.swap (table_);
    filled_ = 0;
    for (const Slot& slot : old)
      if (slot.walk == walk_)
        see (slot.node);
  }

  const SurfaceGraph& graph_;
  std::vector<Slot> table_;
  std::uint32_t walk_ = 0;
  std::size_t filled_ = 0;
  std::vector<index_t> reached_;
};

} // namespace crest
} // namespace pcl
