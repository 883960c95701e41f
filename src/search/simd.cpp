// SPDX-License-Identifier: BSD-3-Clause
#include "search/simd.h"

#include "search/kernels.h"

namespace pcl {
namespace crest {

namespace {

/** \brief Null where the machine does not have them. */
const Kernels*
find (Simd simd)
{
  switch (simd) {
  case Simd::AVX2:
    return avx2Kernels();
  case Simd::SSE2:
    return sse2Kernels();
  default:
    return &portableKernels();
  }
}

} // namespace

bool
isAvailable (Simd simd)
{
  return find (simd) != nullptr;
}

const Kernels&
kernelsFor (Simd simd)
{
  const Kernels* const kernels = find (simd);
  return kernels == nullptr ? portableKernels() : *kernels;
}

Simd
bestSimd ()
{
  for (const Simd simd : {Simd::AVX2, Simd::SSE2})
    if (isAvailable (simd))
      return simd;
  return Simd::PORTABLE;
}

} // namespace crest
} // namespace pcl
