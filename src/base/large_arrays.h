// SPDX-License-Identifier: BSD-3-Clause
// Arrays of a number for each point, which are as large as clouds are.
#pragma once

#include <cstddef>
#include <vector>

namespace pcl {
namespace crest {

/** \brief Asks the system for large pages for memory that has not been touched yet. In
 * pages of 4 KB it costs as much time to come by as a stage takes to fill it.
 */
void
adviseLargePages (void* memory, std::size_t bytes);

template <typename T, typename Allocator>
void
reserveLarge (std::vector<T, Allocator>& array, std::size_t size)
{
  array.reserve (size);
  adviseLargePages (array.data(), array.capacity() * sizeof (T));
}

template <typename T>
std::vector<T>
makeLarge (std::size_t size, const T& value)
{
  std::vector<T> array;
  reserveLarge (array, size);
  array.resize (size, value);
  return array;
}

template <typename T>
std::vector<T>
copyLarge (const std::vector<T>& array)
{
  std::vector<T> copy;
  reserveLarge (copy, array.size());
  copy.assign (array.begin(), array.end());
  return copy;
}

} // namespace crest
} // namespace pcl
