// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <omp.h>

#include <algorithm>
#include <cstddef>

namespace pcl {
namespace crest {

/** \brief The number of threads that a setting stands for: 0 is all processors. */
inline int
threadCount (unsigned threads)
{
  return threads == 0 ? omp_get_num_procs() : static_cast<int> (threads);
}

/** \brief Calls work (block, first, last) for consecutive blocks of [0, size). The
 * blocks do not depend on the number of threads, so that what is summed per block does
 * not either.
 */
constexpr std::size_t BLOCK_SIZE = 1024;

inline std::size_t
blockCount (std::size_t size)
{
  return (size + BLOCK_SIZE - 1) / BLOCK_SIZE;
}

template <typename Work>
void
forEachBlock (std::size_t size, unsigned threads, const Work& work)
{
  const auto blocks = static_cast<std::ptrdiff_t> (blockCount (size));
#pragma omp parallel for schedule(dynamic, 1) num_threads(threadCount(threads))
  for (std::ptrdiff_t block = 0; block < blocks; ++block) {
    const std::size_t first = static_cast<std::size_t> (block) * BLOCK_SIZE;
    work (static_cast<std::size_t> (block), first, std::min (first + BLOCK_SIZE, size));
  }
}

} // namespace crest
} // namespace pcl
