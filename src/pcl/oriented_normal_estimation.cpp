// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_crest/impl/oriented_normal_estimation.hpp>

PCL_INSTANTIATE_OrientedNormalEstimation (pcl::PointXYZ, pcl::Normal);
PCL_INSTANTIATE_OrientedNormalEstimation (pcl::PointXYZI, pcl::Normal);
PCL_INSTANTIATE_OrientedNormalEstimation (pcl::PointXYZRGB, pcl::Normal);
PCL_INSTANTIATE_OrientedNormalEstimation (pcl::PointXYZRGBA, pcl::Normal);
PCL_INSTANTIATE_OrientedNormalEstimation (pcl::PointNormal, pcl::Normal);
PCL_INSTANTIATE_OrientedNormalEstimation (pcl::PointXYZ, pcl::PointNormal);
PCL_INSTANTIATE_OrientedNormalEstimation (pcl::PointNormal, pcl::PointNormal);
