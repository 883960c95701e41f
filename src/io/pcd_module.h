// SPDX-License-Identifier: BSD-3-Clause
// PCL's reader of PCD files, in a module of its own: PCL's IO brings along VTK and some
// sixty libraries, which would take every program that reads any format longer to load
// than most clouds take to compute.
#pragma once

#include <pcl_crest/types.h>

#include <pcl/PCLPointCloud2.h>

#include <Eigen/Geometry>

extern "C" {

/** \brief pcl::PCDReader::read; returns whether the file could be read. */
PCL_CREST_EXPORT bool
pcl_crest_read_pcd (const char* file,
                    pcl::PCLPointCloud2& data,
                    Eigen::Vector4f& origin,
                    Eigen::Quaternionf& orientation);
}
