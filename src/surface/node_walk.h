// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "surface/surface_graph.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace pcl {
namespace crest {

/** \brief Walks a graph from a node outward, ring by ring.
 *
 * Walks that start beside each other see mostly the same nodes. What they have seen is
 * kept under small numbers, its places: stars as rows of bits, so that a ring is the
 * union of some rows, and what is known of each node beside them, where the nearest
 * cache has it. Neither making nor starting one takes time that grows with the graph.
 *
 * \tparam Load makes what is known of a node, a small value, from its index
 */
template <typename Load>
class NodeWalk {
public:
  using Known = decltype (std::declval<const Load&>() (index_t{}));

  NodeWalk (const SurfaceGraph& graph, const Load& load) : graph_ (graph), load_ (load)
  {
    forget();
  }

  void
  start (index_t node)
  {
    // A quarter is room for what a walk sees that others did not.
    if (4 * nodes_.size() > 3 * words_ * WORD)
      forget();
    std::fill (asked_.begin(), asked_.end(), 0);
    const Place place = placeOf (node);
    setBit (asked_.data(), place);
    reached_.resize (nodes_.size());
    reached_[0] = place;
    size_ = 1;
    ring_ = 0;
  }

  /** \brief Reaches the neighbours of the last ring, of those that no ring has asked
   * for before the ones that are accepted, which are the next ring.
   * \return whether there are any
   */
  template <typename Accept>
  bool
  advance (const Accept& accept)
  {
    const std::size_t last = size_;
    for (std::size_t i = ring_; i < last; ++i)
      if (row_of_[reached_[i]] == UNKNOWN)
        loadStar (reached_[i]);
    // Every place is reached once at most, and one more is written to.
    reached_.resize (nodes_.size() + 1);
    fresh_.assign (words_, 0);
    for (; ring_ < last; ++ring_) {
      const Bits* const row = rows_.data() + row_of_[reached_[ring_]];
      for (std::size_t w = 0; w < words_; ++w)
        fresh_[w] |= row[w];
    }
    for (std::size_t w = 0; w < words_; ++w) {
      Bits bits = fresh_[w] & ~asked_[w];
      asked_[w] |= bits;
      for (; bits != 0; bits &= bits - 1) {
        const auto place = static_cast<Place> (
            w * WORD + static_cast<std::size_t> (__builtin_ctzll (bits)));
        // Whether it is accepted may be as good as random: there is no branch for it.
        reached_[size_] = place;
        size_ += accept (known_[place]) ? 1 : 0;
      }
    }
    return size_ > last;
  }

  /** \brief The number of nodes reached so far, with the first. */
  std::size_t
  size () const
  {
    return size_;
  }

  /** \brief The i-th of them, ring by ring. */
  index_t
  node (std::size_t i) const
  {
    return nodes_[reached_[i]];
  }

  /** \brief What is known of it. */
  const Known&
  operator[] (std::size_t i) const
  {
    return known_[reached_[i]];
  }

private:
  using Place = std::uint32_t;
  using Bits = std::uint64_t;
  static constexpr std::size_t WORD = 64;
  /** Of a row, at first: twice as many whenever a walk sees more than it has bits. */
  static constexpr std::size_t FEWEST_WORDS = 8;
  static constexpr std::size_t UNKNOWN = std::numeric_limits<std::size_t>::max();

  /** \brief A node in the hash table, and its place. */
  struct Slot {
    index_t node = OrientedPoints::INVALID;
    Place place = 0;
  };

  static void
  setBit (Bits* row, Place place)
  {
    row[place / WORD] |= Bits{1} << place % WORD;
  }

  void
  forget ()
  {
    asked_.assign (words_, 0);
    table_.assign (2 * words_ * WORD, Slot());
    nodes_.clear();
    known_.clear();
    row_of_.clear();
    rows_.clear();
  }

  Place
  placeOf (index_t node)
  {
    Slot* slot = find (node);
    if (slot->node == node)
      return slot->place;
    if (nodes_.size() == words_ * WORD) {
      widen();
      slot = find (node);
    }
    *slot = {node, static_cast<Place> (nodes_.size())};
    nodes_.push_back (node);
    known_.push_back (load_ (node));
    row_of_.push_back (UNKNOWN);
    return slot->place;
  }

  /** \brief The slot of a node, or the one for it: half of the table stays empty. */
  Slot*
  find (index_t node)
  {
    const std::size_t mask = table_.size() - 1;
    // Of neighbours that the curve through the cloud has far apart the lowest bits are
    // mostly the same.
    const std::uint64_t spread =
        0x9E3779B97F4A7C15U * static_cast<std::uint64_t> (node);
    for (std::size_t i = spread >> WORD / 2 & mask;; i = (i + 1) & mask)
      if (table_[i].node == node || table_[i].node == OrientedPoints::INVALID)
        return &table_[i];
  }

  /** \brief Makes room for twice as many places. */
  void
  widen ()
  {
    std::vector<Bits> rows (2 * rows_.size(), 0);
    for (std::size_t i = 0; i < rows_.size(); ++i)
      rows[i / words_ * 2 * words_ + i % words_] = rows_[i];
    rows_.swap (rows);
    for (std::size_t& row : row_of_)
      row = row == UNKNOWN ? UNKNOWN : 2 * row;
    words_ *= 2;
    asked_.resize (words_, 0);
    table_.assign (2 * words_ * WORD, Slot());
    for (std::size_t place = 0; place < nodes_.size(); ++place)
      *find (nodes_[place]) = {nodes_[place], static_cast<Place> (place)};
  }

  void
  loadStar (Place place)
  {
    star_.clear();
    for (const index_t q : graph_.star (nodes_[place]))
      star_.push_back (placeOf (q)); // which may widen rows
    row_of_[place] = rows_.size();
    rows_.resize (rows_.size() + words_, 0);
    Bits* const row = rows_.data() + row_of_[place];
    for (const Place q : star_)
      setBit (row, q);
  }

  const SurfaceGraph& graph_;
  Load load_;
  /** of a row */
  std::size_t words_ = FEWEST_WORDS;
  std::vector<Slot> table_;
  /** by places: nodes, what is known of them, where the row of each begins */
  std::vector<index_t> nodes_;
  std::vector<Known> known_;
  std::vector<std::size_t> row_of_;
  std::vector<Bits> rows_;
  std::vector<Place> star_;
  /** what has been seen by this walk, and by its next ring */
  std::vector<Bits> asked_;
  std::vector<Bits> fresh_;
  std::vector<Place> reached_;
  std::size_t size_ = 0;
  /** where in these the last ring begins */
  std::size_t ring_ = 0;
};

} // namespace crest
} // namespace pcl
