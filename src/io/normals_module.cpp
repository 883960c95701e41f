// SPDX-License-Identifier: BSD-3-Clause
#include "normals_module.h"

#include <pcl/features/normal_3d_omp.h>

void
pcl_crest_estimate_normals (const pcl::PointCloud<pcl::PointXYZ>::ConstPtr& points,
                            int k,
                            unsigned threads,
                            pcl::PointCloud<pcl::Normal>& normals)
{
  pcl::NormalEstimationOMP<pcl::PointXYZ, pcl::Normal> estimation (threads);
  estimation.setInputCloud (points);
  estimation.setKSearch (k);
  estimation.compute (normals);
}
