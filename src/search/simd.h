// SPDX-License-Identifier: BSD-3-Clause
// Which instructions the neighbour search and the fits use.
#pragma once

namespace pcl {
namespace crest {

/** \brief Sets of instructions, each giving the same results bit for bit. */
enum class Simd {
  /** plain C++, on every machine */
  PORTABLE,
  /** on every x86-64 processor */
  SSE2,
  AVX2
};

/** \brief Whether this machine and build have these instructions. */
bool
isAvailable (Simd simd);

/** \brief The fastest that this machine has. */
Simd
bestSimd ();

} // namespace crest
} // namespace pcl
