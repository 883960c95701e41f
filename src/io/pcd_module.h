// SPDX-License-Identifier: BSD-3-Clause
// PCL's decompression of PCD files, in a module of its own: PCL's IO brings along VTK
// and some sixty libraries, which would take every program that reads any format longer
// to load than most clouds take to compute.
#pragma once

#include <pcl_crest/types.h>

extern "C" {

/** \brief pcl::lzfDecompress; whether the data, of a size in bytes, unpack to as many
 * bytes as there is room for.
 */
PCL_CREST_EXPORT bool
pcl_crest_decode_lzf (const char* data,
                      unsigned size,
                      char* unpacked,
                      unsigned unpacked_size);
}
