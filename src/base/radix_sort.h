// SPDX-License-Identifier: BSD-3-Clause
// Sorting by whole numbers, faster than by comparisons.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace pcl {
namespace crest {

/** \brief Sorts by a key of 64 bits, of equal keys by a comparison: in place, by a byte
 * at a time from the highest (the American flag sort of McIlroy, Bostic and McIlroy
 * 1993), and by comparisons where there are few.
 * \param[in] first, last what to sort
 * \param[in] key of an element
 * \param[in] less a strict weak order of elements whose keys are equal
 * \param[in] shift that of the byte to begin with
 */
template <typename Element, typename Key, typename Less>
void
radixSort (
    Element* first, Element* last, const Key& key, const Less& less, int shift = 56)
{
  constexpr std::ptrdiff_t FEW = 64;
  constexpr std::size_t VALUES = 256;
  if (last - first <= FEW || shift < 0) {
    std::sort (first, last, [&] (const Element& a, const Element& b) {
      const std::uint64_t key_of_a = key (a);
      const std::uint64_t key_of_b = key (b);
      return key_of_a < key_of_b || (key_of_a == key_of_b && less (a, b));
    });
    return;
  }
  const auto byteOf = [&] (const Element& element) {
    return static_cast<std::size_t> (key (element) >> shift) % VALUES;
  };
  std::array<std::ptrdiff_t, VALUES> counts{};
  for (const Element* element = first; element != last; ++element)
    ++counts[byteOf (*element)];
  std::array<Element*, VALUES> ends;
  std::array<Element*, VALUES> next;
  Element* end = first;
  for (std::size_t value = 0; value < VALUES; ++value) {
    next[value] = end;
    ends[value] = end += counts[value];
  }
  for (std::size_t value = 0; value < VALUES; ++value)
    while (next[value] != ends[value]) {
      Element element = *next[value];
      for (std::size_t own = byteOf (element); own != value; own = byteOf (element))
        std::swap (element, *next[own]++);
      *next[value]++ = element;
    }
  Element* begin = first;
  for (Element* const bucket_end : ends) {
    radixSort (begin, bucket_end, key, less, shift - 8);
    begin = bucket_end;
  }
}

} // namespace crest
} // namespace pcl
