// SPDX-License-Identifier: BSD-3-Clause
// Room base: loops over blocks on several threads, and beside them progress, stopwatch,
// large arrays, disjoint sets, and sorting by bits.
//
// Arrays go in and out, and what comes out does not depend on the number of threads. It
// knows nothing of points and surfaces.
#pragma once

#include "base/progress.h"
#include <omp.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>

namespace pcl {
namespace crest {

/** \brief The number of threads that a setting stands for: 0 is all processors. */
inline int
threadCount (unsigned threads)
{
  return threads == 0 ? omp_get_num_procs() : static_cast<int> (threads);
}

/** \brief Brings an exception out of a parallel region, which none may leave by itself:
 * of several the first that was thrown.
 */
class ThreadFailure {
public:
  /** \brief Calls work, unless some has failed already. */
  template <typename Work>
  void
  guard (const Work& work)
  {
    if (failed_)
      return;
    try {
      work();
    }
    catch (...) {
      if (!failed_.exchange (true))
        failure_ = std::current_exception();
    }
  }

  /** \brief To be called when the region has ended. */
  void
  rethrow () const
  {
    if (failure_)
      std::rethrow_exception (failure_);
  }

private:
  std::atomic<bool> failed_{false};
  std::exception_ptr failure_;
};

/** \brief Calls work (block, first, last) for consecutive blocks of [0, size). The
 * blocks do not depend on the number of threads, so that what is summed per block does
 * not either.
 */
constexpr std::size_t BLOCK_SIZE = 1024;

inline std::size_t
blockCount (std::size_t size, std::size_t block_size = BLOCK_SIZE)
{
  return (size + block_size - 1) / block_size;
}

template <typename Work>
void
forEachBlock (std::size_t size,
              const Workers& workers,
              const Work& work,
              std::size_t block_size = BLOCK_SIZE)
{
  const auto blocks = static_cast<std::ptrdiff_t> (blockCount (size, block_size));
  Progress* const progress = workers.progress;
  std::atomic<std::ptrdiff_t> finished{0};
  const auto workOn = [&] (std::ptrdiff_t block, bool tells) {
    if (progress != nullptr && progress->isCancelled())
      return;
    const std::size_t first = static_cast<std::size_t> (block) * block_size;
    work (static_cast<std::size_t> (block), first, std::min (first + block_size, size));
    ++finished;
    if (progress != nullptr && tells)
      progress->advance (static_cast<double> (finished) / static_cast<double> (blocks));
  };
  // Even of one thread a parallel region makes those within it dear, which FLANN opens
  // for each query.
  const auto threads = static_cast<int> (
      std::min<std::ptrdiff_t> (threadCount (workers.threads), blocks));
  if (threads <= 1)
    for (std::ptrdiff_t block = 0; block < blocks; ++block)
      workOn (block, true);
  else {
    ThreadFailure failure;
    // The first of the threads is the one that started the loop.
#pragma omp parallel for schedule(dynamic, 1) num_threads(threads)
    for (std::ptrdiff_t block = 0; block < blocks; ++block)
      failure.guard ([&] { workOn (block, omp_get_thread_num() == 0); });
    failure.rethrow();
  }
  if (progress != nullptr)
    progress->check();
}

} // namespace crest
} // namespace pcl
