// SPDX-License-Identifier: BSD-3-Clause
#include "crest_session.h"

#include <pcl_crest/impl/cloud_results.hpp>
#include <pcl_crest/surface_analysis.h>

namespace pcl {
namespace crest {

namespace {

/** \brief The parameters with what the shape of the surface depends on from others. */
Parameters
withShapeOf (const Parameters& shape, const Parameters& thresholds)
{
  Parameters result = thresholds;
  result.preset = shape.preset;
  result.k = shape.k;
  result.radius = shape.radius;
  result.batched_search = shape.batched_search;
  result.points_per_quadrant = shape.points_per_quadrant;
  result.max_normal_angle = shape.max_normal_angle;
  return result;
}

} // namespace

CrestSession::CrestSession (InputCloud cloud,
                            const Parameters& parameters,
                            const std::function<void (const std::string&)>& tell)
: cloud_ (std::move (cloud)), parameters_ (parameters)
{
  tell ("curvature");
  Stopwatch watch (statistics_.times);
  line_cloud_ = *cloud_.points;
  const pcl::PointNormal& first = *cloud_.points->points.data();
  points_ = packOrientedPoints ({&first.x,
                                 &first.normal_x,
                                 sizeof (pcl::PointNormal) / sizeof (float),
                                 cloud_.points->size()});
  watch.stageDone ("packing");
  shape_ = analyzeSurface (points_, parameters_);
  statistics_.mean_spacing = shape_.graph.mean_spacing;
  statistics_.extent = points_.extent;
  const std::vector<StageTime> packing = statistics_.times;
  tell ("crest lines");
  trace();
  keep();
  std::vector<StageTime>& times = statistics_.times;
  times.insert (times.begin(), shape_.times.begin(), shape_.times.end());
  times.insert (times.begin(), packing.begin(), packing.end());
}

void
CrestSession::setThresholds (const Parameters& thresholds)
{
  const Parameters before = parameters_;
  parameters_ = withShapeOf (before, thresholds);
  traced_.times.clear();
  if (!haveSameTrace (before, parameters_))
    trace();
  keep();
}

void
CrestSession::trace()
{
  Parameters of_both = parameters_;
  of_both.wanted = {true, true};
  traced_ = traceCrests (points_, shape_, of_both);
}

void
CrestSession::keep()
{
  // Copying a large cloud at each move of a slider would be felt.
  for (const CrestLine& line : lines_)
    for (const std::vector<index_t>& polyline : line.polylines)
      for (const index_t point : polyline)
        line_cloud_[point].getVector3fMap() = (*cloud_.points)[point].getVector3fMap();
  crests_ = keepLines (points_, shape_, traced_, parameters_);
  lines_ = linesOfCloud (points_, crests_.lines);
  movePointsToLines (points_, lines_, crests_.positions, line_cloud_);
  statistics_.line_sizes = crests_.sizes;
  statistics_.times = crests_.times;
}

pcl::PointCloud<pcl::Label>
CrestSession::labels() const
{
  const std::vector<Label> packed = labelPoints (shape_, crests_, parameters_);
  pcl::PointCloud<pcl::Label> labels;
  for (const index_t point : points_.packed_index)
    labels.push_back (pcl::Label{labelAt (packed, point)});
  labels.width = cloud_.points->width;
  labels.height = cloud_.points->height;
  return labels;
}

pcl::PointCloud<pcl::PrincipalCurvatures>
CrestSession::curvatures() const
{
  pcl::PointCloud<pcl::PrincipalCurvatures> curvatures;
  for (const index_t point : points_.packed_index)
    curvatures.push_back (curvatureAt (shape_.curvature, point));
  curvatures.width = cloud_.points->width;
  curvatures.height = cloud_.points->height;
  curvatures.is_dense = false;
  return curvatures;
}

} // namespace crest
} // namespace pcl
