// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "base/radix_sort.h"

#include <random>
#include <vector>

using pcl::crest::radixSort;

namespace {

struct Element {
  std::uint64_t key;
  int order;

  bool
  operator== (const Element& o) const
  {
    return key == o.key && order == o.order;
  }
};

/** \brief Sorts as the standard library does, and compares. */
void
expectSorted (std::vector<Element> elements)
{
  std::vector<Element> expected = elements;
  std::sort (expected.begin(), expected.end(), [] (const Element& a, const Element& b) {
    return a.key < b.key || (a.key == b.key && a.order < b.order);
  });
  radixSort (
      elements.data(),
      elements.data() + elements.size(),
      [] (const Element& e) { return e.key; },
      [] (const Element& a, const Element& b) { return a.order < b.order; });
  EXPECT_EQ (elements, expected);
}

} // namespace

TEST (RadixSort, EqualsTheStandardLibrary)
{
  // All bits, the lowest alone, the highest alone, few different keys, one key.
  std::mt19937_64 random (1);
  for (const std::uint64_t mask :
       {~0ULL, 0xffffULL, 0xff00000000000000ULL, 0x8001ULL, 0ULL})
    for (const std::size_t size : {0U, 1U, 2U, 64U, 65U, 1000U, 30000U}) {
      SCOPED_TRACE (testing::Message() << std::hex << mask << ", " << size);
      std::vector<Element> elements;
      for (std::size_t i = 0; i < size; ++i)
        elements.push_back ({random() & mask, static_cast<int> (size - i)});
      expectSorted (elements);
    }
}
