// SPDX-License-Identifier: BSD-3-Clause
// How much memory this process had at its peak (Linux).
#pragma once

#include <cstddef>
#include <functional>

namespace performance {

/** \brief By how many bytes the resident memory was at its largest above what it was
 * before, while something runs; 0 where the system does not tell.
 */
std::size_t
peakMemory (const std::function<void()>& run);

} // namespace performance
