// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/large_arrays.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace pcl {
namespace crest {

/** \brief Where the parts of an array begin that is divided among points: ascending
 * numbers, of which 32 bits each are kept, and beside them where the others change.
 * That is half the memory, and no cloud has more than a few such places.
 */
class StarOffsets {
public:
  StarOffsets() = default;

  /** \param[in] memory to keep them in, what is in it goes */
  explicit StarOffsets (std::vector<std::uint32_t> memory) : low_ (std::move (memory))
  {
    low_.clear();
  }

  /** \param[in] offset not less than the last, by less than 2^32 more */
  void
  push_back (std::size_t offset)
  {
    const auto low = static_cast<std::uint32_t> (offset);
    if (!low_.empty() && low < low_.back())
      wraps_.push_back (low_.size());
    low_.push_back (low);
  }

  std::size_t
  operator[] (std::size_t i) const
  {
    std::size_t offset = low_[i];
    if (!wraps_.empty())
      offset += static_cast<std::size_t> (
                    std::upper_bound (wraps_.begin(), wraps_.end(), i) - wraps_.begin())
                << 32;
    return offset;
  }

  std::size_t
  size () const
  {
    return low_.size();
  }

  bool
  operator== (const StarOffsets& other) const
  {
    return low_ == other.low_ && wraps_ == other.wraps_;
  }

private:
  std::vector<std::uint32_t> low_;
  /** the places from which on the higher bits are one more */
  std::vector<std::size_t> wraps_;
};

/** \brief Room for where the stars of some points begin, and the first beginning. */
inline StarOffsets
makeOffsets (std::size_t points)
{
  std::vector<std::uint32_t> memory;
  reserveLarge (memory, points + 1);
  StarOffsets offsets (std::move (memory));
  offsets.push_back (0);
  return offsets;
}

} // namespace crest
} // namespace pcl
