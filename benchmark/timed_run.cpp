// SPDX-License-Identifier: BSD-3-Clause
#include "timed_run.h"

#include <pcl_crest/crest_line_estimation.h>

#include <chrono>

namespace accuracy {

double
millisecondsOf (const std::function<void()>& work)
{
  const auto start = std::chrono::steady_clock::now();
  work();
  const std::chrono::duration<double, std::milli> took =
      std::chrono::steady_clock::now() - start;
  return took.count();
}

TimedRun
timedRun (const pcl::PointCloud<pcl::PointNormal>::ConstPtr& cloud,
          const std::string& preset,
          unsigned threads)
{
  pcl::CrestLineEstimation<pcl::PointNormal> estimation;
  estimation.setInputCloud (cloud);
  estimation.setPreset (preset == "auto" ? pcl::crest::Preset::AUTO
                                         : pcl::crest::Preset::PAPER);
  estimation.setNumberOfThreads (threads);
  pcl::PointCloud<pcl::Label> labels;
  const double milliseconds = millisecondsOf ([&] { estimation.compute (labels); });
  return {estimation.getLines(),
          estimation.getLineCloud(),
          estimation.getPrincipalCurvatures(),
          milliseconds};
}

} // namespace accuracy
