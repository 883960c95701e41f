// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_crest/types.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace pcl {
namespace crest {

/** \brief Values by indices, which are not negative: a hash table in one array, for
 * many small ones (open addressing with linear probing; Knuth 1973, 6.4, whose
 * algorithm R erases).
 */
template <typename Value>
class IndexMap {
public:
  std::size_t
  size () const
  {
    return size_;
  }

  /** \brief The value of an index; nullptr if it has none. Valid until the next change
   * of which indices have one.
   */
  const Value*
  find (index_t index) const
  {
    if (size_ == 0)
      return nullptr;
    const Slot& slot = slots_[slotOf (index)];
    return slot.index == index ? &slot.value : nullptr;
  }

  /** \brief Makes room for so many in all: those of another map, which come in the
   * order of their slots, else crowd the first slots of one that is nearly full.
   */
  void
  reserve (std::size_t size)
  {
    if (FULL_OF_4 * slots_.size() >= 4 * size)
      return;
    const std::vector<Slot> old = std::move (slots_);
    do
      bits_ = std::max (LEAST_BITS, bits_ + 1);
    while ((FULL_OF_4 << bits_) < 4 * size);
    slots_.assign (std::size_t (1) << bits_, Slot());
    for (const Slot& slot : old)
      if (slot.index != EMPTY)
        slots_[slotOf (slot.index)] = slot;
  }

  /** \brief The value of an index, which has one afterwards. */
  Value&
  operator[] (index_t index)
  {
    reserve (size_ + 1);
    Slot& slot = slots_[slotOf (index)];
    if (slot.index == EMPTY) {
      slot.index = index;
      ++size_;
    }
    return slot.value;
  }

  void
  erase (index_t index)
  {
    if (size_ == 0)
      return;
    std::size_t hole = slotOf (index);
    if (slots_[hole].index == EMPTY)
      return;
    --size_;
    // Those behind, up to the next gap, have to be found without it.
    const std::size_t mask = slots_.size() - 1;
    for (std::size_t next = (hole + 1) & mask; slots_[next].index != EMPTY;
         next = (next + 1) & mask)
      if (((next - homeOf (slots_[next].index)) & mask) >= ((next - hole) & mask)) {
        slots_[hole] = slots_[next];
        hole = next;
      }
    slots_[hole] = Slot();
  }

  /** \brief Calls use (index, value) for all, in no special order. */
  template <typename Use>
  void
  forEach (const Use& use) const
  {
    for (const Slot& slot : slots_)
      if (slot.index != EMPTY)
        use (slot.index, slot.value);
  }

private:
  static constexpr index_t EMPTY = -1;
  /** quarters of the slots that may be taken */
  static constexpr std::size_t FULL_OF_4 = 3;
  static constexpr int LEAST_BITS = 3;

  struct Slot {
    index_t index = EMPTY;
    Value value{};
  };

  std::size_t
  homeOf (index_t index) const
  {
    constexpr std::uint32_t GOLDEN = 0x9E3779B9U;
    return static_cast<std::uint32_t> (index) * GOLDEN >> (32 - bits_);
  }

  /** \brief Where an index is, or would be. */
  std::size_t
  slotOf (index_t index) const
  {
    std::size_t slot = homeOf (index);
    while (slots_[slot].index != index && slots_[slot].index != EMPTY)
      slot = (slot + 1) & (slots_.size() - 1);
    return slot;
  }

  std::vector<Slot> slots_;
  std::size_t size_ = 0;
  int bits_ = 0;
};

} // namespace crest
} // namespace pcl
