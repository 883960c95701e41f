// SPDX-License-Identifier: BSD-3-Clause
// The whole method in one call.
#pragma once

#include <pcl_crest/crest_line_estimation.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace oracle {

struct CrestRun {
  pcl::PointCloud<pcl::Label> labels;
  std::vector<pcl::crest::CrestLine> lines;
  /** the cloud with the points on lines where these run */
  pcl::PointCloud<pcl::PointNormal>::ConstPtr line_cloud;
};

inline double
totalLength (const std::vector<pcl::crest::CrestLine>& lines)
{
  double sum = 0.0;
  for (const pcl::crest::CrestLine& line : lines)
    sum += line.length;
  return sum;
}

inline CrestRun
extract (const pcl::PointCloud<pcl::PointNormal>::ConstPtr& cloud,
         const pcl::crest::Parameters& parameters = {})
{
  pcl::CrestLineEstimation<pcl::PointNormal> estimation;
  estimation.setInputCloud (cloud);
  estimation.setParameters (parameters);
  CrestRun run;
  estimation.compute (run.labels);
  run.lines = estimation.getLines();
  run.line_cloud = estimation.getLineCloud();
  return run;
}

inline std::size_t
countDifferent (const pcl::PointCloud<pcl::Label>& a,
                const pcl::PointCloud<pcl::Label>& b)
{
  EXPECT_EQ (a.size(), b.size());
  std::size_t different = 0;
  for (std::size_t i = 0; i < std::min (a.size(), b.size()); ++i)
    different += a[i].label != b[i].label ? 1 : 0;
  return different;
}

} // namespace oracle
