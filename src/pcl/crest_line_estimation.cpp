// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_crest/impl/crest_line_estimation.hpp>

PCL_INSTANTIATE_CrestLineEstimation (pcl::PointXYZ, pcl::Label);
PCL_INSTANTIATE_CrestLineEstimation (pcl::PointXYZI, pcl::Label);
PCL_INSTANTIATE_CrestLineEstimation (pcl::PointXYZRGB, pcl::Label);
PCL_INSTANTIATE_CrestLineEstimation (pcl::PointXYZRGBA, pcl::Label);
PCL_INSTANTIATE_CrestLineEstimation (pcl::PointNormal, pcl::Label);
PCL_INSTANTIATE_CrestLineEstimation (pcl::PointXYZINormal, pcl::Label);
PCL_INSTANTIATE_CrestLineEstimation (pcl::PointXYZRGBNormal, pcl::Label);
PCL_INSTANTIATE_CrestLineEstimation (pcl::PointXYZLNormal, pcl::Label);
PCL_INSTANTIATE_CrestLineEstimation (pcl::PointSurfel, pcl::Label);
