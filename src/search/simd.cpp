// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_crest/search/simd.h>

#include "kernels.h"

namespace pcl {
namespace crest {

bool
isAvailable (Simd simd)
{
  switch (simd) {
  case Simd::AVX2:
    return avx2Kernels() != nullptr;
  case Simd::SSE2:
    return sse2Kernels() != nullptr;
  default:
    return true;
  }
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
