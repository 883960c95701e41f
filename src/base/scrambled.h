// SPDX-License-Identifier: BSD-3-Clause
// An order that is random, and the same each time.
#pragma once

#include <cstdint>

namespace pcl {
namespace crest {

/** \brief Mixes the bits of an index, no two of them to the same (the finalizer of
 * MurmurHash3, A. Appleby, public domain).
 */
inline std::uint32_t
scrambled (std::uint32_t x)
{
  x = (x ^ x >> 16) * 0x85ebca6bU;
  x = (x ^ x >> 13) * 0xc2b2ae35U;
  return x ^ x >> 16;
}

} // namespace crest
} // namespace pcl
