// SPDX-License-Identifier: BSD-3-Clause
#include "peak_memory.h"

#include <malloc.h>

#include <fstream>
#include <string>

namespace performance {

namespace {

/** \brief A line of /proc/self/status, in bytes. */
std::size_t
memoryOf (const std::string& field)
{
  std::ifstream status ("/proc/self/status");
  for (std::string name; status >> name;)
    if (name == field + ":") {
      std::size_t kilobytes = 0;
      status >> kilobytes;
      return 1024 * kilobytes;
    }
  return 0;
}

} // namespace

std::size_t
peakMemory (const std::function<void()>& run)
{
  // Freed memory that the process still holds would be used again, and not be seen.
  malloc_trim (0);
  std::ofstream reset ("/proc/self/clear_refs");
  const bool known = static_cast<bool> (reset << "5" << std::flush); // the peak is now
  const std::size_t before = memoryOf ("VmRSS");
  run();
  const std::size_t peak = memoryOf ("VmHWM");
  return known && peak > before ? peak - before : 0;
}

} // namespace performance
