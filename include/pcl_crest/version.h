// SPDX-License-Identifier: BSD-3-Clause
// Which version of the library this is, and what it computes with.
#pragma once

#include <pcl_crest/types.h>

#include <string>
#include <vector>

namespace pcl {
namespace crest {

/** \brief The version of the library, as in "0.1.0". */
PCL_CREST_EXPORT std::string
version ();

/** \brief The sets of instructions that this machine can run the inner loops with, as
 * in "avx2", "sse2", "portable". The first is the fastest, and the one in use.
 */
PCL_CREST_EXPORT std::vector<std::string>
kernelNames ();

} // namespace crest
} // namespace pcl
