// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_crest/version.h>

#include "search/simd.h"

#include <utility>

namespace pcl {
namespace crest {

std::string
version ()
{
  return PCL_CREST_VERSION;
}

std::vector<std::string>
kernelNames ()
{
  std::vector<std::string> names;
  for (const auto& [simd, name] : {std::pair{Simd::AVX2, "avx2"},
                                   std::pair{Simd::SSE2, "sse2"},
                                   std::pair{Simd::PORTABLE, "portable"}})
    if (isAvailable (simd))
      names.emplace_back (name);
  return names;
}

} // namespace crest
} // namespace pcl
