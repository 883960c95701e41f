// SPDX-License-Identifier: BSD-3-Clause
// Against the standard library's map, by changes at random.
#include <gtest/gtest.h>

#include "base/index_map.h"

#include <map>
#include <random>

using namespace pcl::crest;

namespace {

std::map<index_t, int>
contentsOf (const IndexMap<int>& map)
{
  std::map<index_t, int> contents;
  map.forEach ([&contents] (index_t index, int value) {
    EXPECT_TRUE (contents.emplace (index, value).second) << index << " comes twice";
  });
  return contents;
}

TEST (IndexMap, IsAsTheStandardMapAfterAnyChanges)
{
  std::mt19937 random (3);
  for (const index_t range : {5, 60, 4000}) {
    IndexMap<int> map;
    std::map<index_t, int> expected;
    for (int step = 0; step < 20000; ++step) {
      // Multiples of a large number share their home slots.
      const index_t index = static_cast<index_t> (random() % range) * 100000;
      if (random() % 3 != 0) {
        map[index] += step;
        expected[index] += step;
      }
      else {
        map.erase (index);
        expected.erase (index);
      }
      ASSERT_EQ (map.size(), expected.size());
      const index_t other = static_cast<index_t> (random() % range) * 100000;
      const int* const value = map.find (other);
      ASSERT_EQ (value != nullptr, expected.count (other) == 1) << other;
      if (value != nullptr) {
        ASSERT_EQ (*value, expected[other]);
      }
    }
    EXPECT_EQ (contentsOf (map), expected);
  }
}

TEST (IndexMap, TakesAllOfAnotherInItsOrder)
{
  // Unless room is made first, the slots' order makes this quadratic.
  IndexMap<int> few;
  IndexMap<int> many;
  std::map<index_t, int> expected;
  for (index_t i = 0; i < 700000; ++i) {
    (i % 2 == 0 ? few : many)[i] = i;
    expected[i] = i;
  }
  many.reserve (many.size() + few.size());
  few.forEach ([&many] (index_t index, int value) { many[index] = value; });
  EXPECT_EQ (contentsOf (many), expected);
}

} // namespace
