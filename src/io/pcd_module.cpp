// SPDX-License-Identifier: BSD-3-Clause
#include "io/pcd_module.h"

#include <pcl/io/lzf.h>

bool
pcl_crest_decode_lzf (const char* data,
                      unsigned size,
                      char* unpacked,
                      unsigned unpacked_size)
{
  return pcl::lzfDecompress (data, size, unpacked, unpacked_size) == unpacked_size;
}
