// SPDX-License-Identifier: BSD-3-Clause
// An output type that is not precompiled: the user includes the implementation.
#include <pcl_crest/impl/crest_line_estimation.hpp>

#include <gtest/gtest.h>

#include "support/analytic_surface.h"

TEST (OutputType, MaySharePositionsAndNormalsWithTheInput)
{
  const auto cloud = oracle::sample (oracle::ridgeAndValley(), 3000);
  pcl::CrestLineEstimation<pcl::PointNormal, pcl::PointXYZLNormal> estimation;
  estimation.setInputCloud (cloud);
  pcl::PointCloud<pcl::PointXYZLNormal> output;
  estimation.compute (output);

  pcl::CrestLineEstimation<pcl::PointNormal> precompiled;
  precompiled.setInputCloud (cloud);
  pcl::PointCloud<pcl::Label> labels;
  precompiled.compute (labels);

  ASSERT_EQ (output.size(), cloud->size());
  for (std::size_t i = 0; i < output.size(); ++i) {
    EXPECT_EQ (output[i].label, labels[i].label);
    EXPECT_EQ (output[i].x, (*cloud)[i].x);
    EXPECT_EQ (output[i].normal_z, (*cloud)[i].normal_z);
  }
}
