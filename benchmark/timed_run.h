// SPDX-License-Identifier: BSD-3-Clause
// One run of the Feature.
#pragma once

#include <pcl_crest/crest_line.h>

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <functional>
#include <string>

namespace accuracy {

struct TimedRun {
  std::vector<pcl::crest::CrestLine> lines;
  /** what the indices of the lines refer to */
  pcl::PointCloud<pcl::PointNormal>::ConstPtr line_cloud;
  pcl::PointCloud<pcl::PrincipalCurvatures> curvatures;
  double milliseconds;
};

/** \brief How long the work takes. */
double
millisecondsOf (const std::function<void()>& work);

/** \brief Runs a preset, "auto" or "paper", with nothing but its defaults. */
TimedRun
timedRun (const pcl::PointCloud<pcl::PointNormal>::ConstPtr& cloud,
          const std::string& preset,
          unsigned threads);

} // namespace accuracy
