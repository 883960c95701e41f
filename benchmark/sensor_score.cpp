// SPDX-License-Identifier: BSD-3-Clause
#include "sensor_score.h"

#include <pcl_crest/crest_line_estimation.h>

#include <pcl/common/io.h>

#include "sharp_edges.h"
#include "surface_score.h"
#include "timed_run.h"
#include <nlohmann/json.hpp>

#include <cmath>

namespace accuracy {

namespace {

/** \brief Parts of lengths, added up. */
struct Part {
  double part = 0.0;
  double whole = 0.0;

  void
  add (double share, double length)
  {
    if (length > 0.0)
      part += share * length;
    whole += length;
  }
  double
  share () const
  {
    return part / whole;
  }
};

} // namespace

SensorRun
runOn (const oracle::SensorCloud& scan, unsigned threads)
{
  pcl::CrestLineEstimation<pcl::PointXYZ> estimation;
  estimation.setInputCloud (scan.cloud);
  estimation.setNumberOfThreads (threads);
  pcl::PointCloud<pcl::Label> labels;
  const double milliseconds = millisecondsOf ([&] { estimation.compute (labels); });
  SensorRun run{estimation.getLines(),
                pcl::make_shared<pcl::PointCloud<pcl::PointNormal>>(),
                estimation.getStatistics().sampling,
                milliseconds};
  pcl::copyPointCloud (*estimation.getLineCloud(), *run.line_cloud);
  return run;
}

SensorScore
scoreSensor (const SensorRun& run,
             const oracle::Scene& scene,
             const std::optional<oracle::View>& view)
{
  SensorScore result{};
  result.points = run.line_cloud->size();
  result.milliseconds = run.milliseconds;
  result.spacing = run.sampling.spacing;
  result.resolving_spacing = std::max (run.sampling.resolving_spacing, result.spacing);
  const double spacing = result.resolving_spacing;
  const bool is_sharp = !scene.crests.front().sides.empty();
  const auto score = [&] (const std::vector<oracle::TruthSegment>& truth,
                          pcl::crest::CrestType type) {
    return scoreType (run.lines,
                      *run.line_cloud,
                      truth,
                      type,
                      spacing,
                      is_sharp ? SHARP_TOLERANCE : TOLERANCE);
  };
  const auto visible = oracle::visibleCrests (scene, view, result.spacing, 1.0);
  const auto wide = oracle::visibleCrests (scene, view, spacing, WIDE);
  Part precise;
  Part found;
  Part found_wide;
  Part error;
  for (const pcl::crest::CrestType type : pcl::crest::CREST_TYPES) {
    const TypeScore of_visible = score (visible, type);
    const TypeScore of_wide = score (wide, type);
    precise.add (of_visible.precision, of_visible.drawn_length);
    found.add (of_visible.recall, of_visible.salient_length);
    found_wide.add (of_wide.recall, of_wide.salient_length);
    if (of_visible.precision > 0.0)
      error.add (of_visible.error, of_visible.precision * of_visible.drawn_length);
  }
  result.precision = precise.share();
  result.recall = found.share();
  result.wide_recall = found_wide.share();
  result.error = error.share();
  result.drawn_length = precise.whole;
  result.visible_length = found.whole;
  result.wide_length = found_wide.whole;
  return result;
}

nlohmann::json
toJson (const SensorScore& score)
{
  return {{"sensor", score.sensor},
          {"scene", score.scene},
          {"points", score.points},
          {"spacing", score.spacing},
          {"resolving_spacing", score.resolving_spacing},
          {"precision", score.precision},
          {"recall", score.recall},
          {"wide_recall", score.wide_recall},
          {"error", score.error},
          {"drawn_length", score.drawn_length},
          {"visible_length", score.visible_length},
          {"wide_length", score.wide_length},
          {"milliseconds", score.milliseconds}};
}

} // namespace accuracy
