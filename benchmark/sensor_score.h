// SPDX-License-Identifier: BSD-3-Clause
// A run on what a sensor gives of a scene, against the crests of that.
#pragma once

#include <pcl_crest/crest_line.h>
#include <pcl_crest/input.h>

#include "support/sensor_cases.h"
#include <nlohmann/json_fwd.hpp>

namespace accuracy {

/** \brief What is wider than so many resolving spacings should be found. */
constexpr double WIDE = 6.0;

struct SensorRun {
  std::vector<pcl::crest::CrestLine> lines;
  /** what the indices of the lines refer to; without normals */
  pcl::PointCloud<pcl::PointNormal>::Ptr line_cloud;
  pcl::crest::SamplingFindings sampling;
  double milliseconds;
};

/** \brief Runs the Feature with nothing but its defaults. */
SensorRun
runOn (const oracle::SensorCloud& scan, unsigned threads);

/** \brief Lines and truth of both types, each measured by its own; NaN where there is
 * nothing to take a part of.
 */
struct SensorScore {
  std::string sensor, scene;
  std::size_t points;
  /** as the run found them, in the unit of the cloud; where samples will do both are
   * the same */
  double spacing, resolving_spacing;
  double precision;
  /** of all that is visible and wider than a spacing, and of what is wider than WIDE
   * resolving spacings */
  double recall, wide_recall;
  /** in resolving spacings, as are the lengths */
  double error;
  double drawn_length, visible_length, wide_length;
  double milliseconds;
};

/** \brief Fills in what can be told without the names. Near is what is within 2
 * resolving spacings of a sharp edge, or 1.5 of a smooth crest.
 */
SensorScore
scoreSensor (const SensorRun& run,
             const oracle::Scene& scene,
             const std::optional<oracle::View>& view);

nlohmann::json
toJson (const SensorScore& score);

} // namespace accuracy
