// SPDX-License-Identifier: BSD-3-Clause
#include "io/pcd_module.h"

#include <pcl/io/pcd_io.h>

bool
pcl_crest_read_pcd (const char* file,
                    pcl::PCLPointCloud2& data,
                    Eigen::Vector4f& origin,
                    Eigen::Quaternionf& orientation)
{
  int version = 0;
  return pcl::PCDReader().read (file, data, origin, orientation, version) >= 0;
}
