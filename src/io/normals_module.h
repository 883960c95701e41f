// SPDX-License-Identifier: BSD-3-Clause
// PCL's estimation of normals, in a module of its own: PCL's features bring along
// libraries that take longer to load than a small cloud takes to compute.
#pragma once

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

extern "C" {

/** \brief pcl::NormalEstimationOMP.
 * \param[out] normals one for each point; those of points without are not finite
 */
void
pcl_crest_estimate_normals (const pcl::PointCloud<pcl::PointXYZ>::ConstPtr& points,
                            int k,
                            unsigned threads,
                            pcl::PointCloud<pcl::Normal>& normals);
}
