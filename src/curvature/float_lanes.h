// SPDX-License-Identifier: BSD-3-Clause
// Eight fits at a time in floats, one in each lane of as many registers as that takes.
#pragma once

#include "curvature/lanes.h"

#include <cstdint>

namespace pcl {
namespace crest {

/** \brief So many fits are prepared together. Whatever the instructions, they are the
 * same, as no lane sees another.
 */
constexpr int FLOAT_LANES = 8;

/** \brief A number of each of the eight. */
struct alignas (FLOAT_LANES * sizeof (float)) FloatRow {
  float lanes[FLOAT_LANES] = {};

  float&
  operator[] (int lane)
  {
    return lanes[lane];
  }
  float
  operator[] (int lane) const
  {
    return lanes[lane];
  }
};

/** \brief Registers of some of them. */
template <int WIDTH>
struct FloatRegisters {
  using Number = float;
  typedef float Numbers __attribute__ ((vector_size (WIDTH * sizeof (float))));
  /** what comparing them gives: all bits of a lane, or none */
  typedef std::int32_t Mask
      __attribute__ ((vector_size (WIDTH * sizeof (std::int32_t))));
};

template <typename Numbers>
PCL_CREST_INLINE void
load (const FloatRow& row, int first, Numbers& numbers)
{
  __builtin_memcpy (&numbers, row.lanes + first, sizeof (numbers));
}

template <typename Numbers>
PCL_CREST_INLINE void
store (const Numbers& numbers, int first, FloatRow& row)
{
  __builtin_memcpy (row.lanes + first, &numbers, sizeof (numbers));
}

/** \brief A vector of each of the eight. */
struct FloatVectorRow {
  FloatRow x, y, z;
};

/** \brief Registers of a vector of each. */
template <typename Numbers>
struct Vectors {
  Numbers x, y, z;
};

template <typename Numbers>
PCL_CREST_INLINE void
load (const FloatVectorRow& row, int first, Vectors<Numbers>& vectors)
{
  load (row.x, first, vectors.x);
  load (row.y, first, vectors.y);
  load (row.z, first, vectors.z);
}

template <typename Numbers>
PCL_CREST_INLINE void
store (const Vectors<Numbers>& vectors, int first, FloatVectorRow& row)
{
  store (vectors.x, first, row.x);
  store (vectors.y, first, row.y);
  store (vectors.z, first, row.z);
}

} // namespace crest
} // namespace pcl
