// SPDX-License-Identifier: BSD-3-Clause
#include "base/large_arrays.h"

#ifdef __linux__
#include <sys/mman.h>
#include <unistd.h>
#endif

#include <cstdint>

namespace pcl {
namespace crest {

void
adviseLargePages (void* memory, std::size_t bytes)
{
#ifdef MADV_HUGEPAGE
  constexpr std::size_t LARGE = 2U << 20U;
  if (bytes < LARGE)
    return;
  const auto page = static_cast<std::size_t> (::sysconf (_SC_PAGESIZE));
  const std::size_t to_page =
      (page - reinterpret_cast<std::uintptr_t> (memory) % page) % page;
  // Where the system has no large pages, small ones do.
  static_cast<void> (::madvise (static_cast<char*> (memory) + to_page,
                                (bytes - to_page) / page * page,
                                MADV_HUGEPAGE));
#else
  static_cast<void> (memory);
  static_cast<void> (bytes);
#endif
}

} // namespace crest
} // namespace pcl
