// SPDX-License-Identifier: BSD-3-Clause
#include "surface_score.h"

#include <pcl/search/kdtree.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace accuracy {

namespace {

double
medianError (const pcl::PointCloud<pcl::PrincipalCurvatures>& estimated,
             const std::vector<std::pair<std::size_t, double>>& exact)
{
  if (exact.empty())
    return std::numeric_limits<double>::quiet_NaN();
  std::vector<double> errors;
  for (const auto& [index, k1] : exact) {
    const double error = std::abs (estimated[index].pc1 - k1) / std::abs (k1);
    errors.push_back (std::isfinite (error) ? error
                                            : std::numeric_limits<double>::max());
  }
  const auto middle = errors.begin() + static_cast<std::ptrdiff_t> (errors.size() / 2);
  std::nth_element (errors.begin(), middle, errors.end());
  return *middle;
}

} // namespace

std::vector<std::pair<std::size_t, double>>
exactCurvatures (const oracle::AnalyticSurface& surface,
                 const Samples& samples,
                 const std::vector<oracle::TruthSegment>& truth)
{
  std::vector<std::pair<std::size_t, double>> exact;
  pcl::PointCloud<pcl::PointXYZ>::Ptr middles =
      pcl::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
  for (const oracle::TruthSegment& s : oracle::salientLines (truth)) {
    const Eigen::Vector3f p = (0.5 * (s.a + s.b)).cast<float>();
    middles->emplace_back (p.x(), p.y(), p.z());
  }
  if (middles->empty())
    return exact;
  pcl::search::KdTree<pcl::PointXYZ> tree;
  tree.setInputCloud (middles);
  pcl::Indices found;
  std::vector<float> squared;
  for (std::size_t i = 0; i < samples.cloud->size(); ++i) {
    const pcl::PointNormal& p = (*samples.cloud)[i];
    tree.nearestKSearch (pcl::PointXYZ (p.x, p.y, p.z), 1, found, squared);
    if (squared[0] > 0.25 * samples.spacing * samples.spacing)
      continue;
    const Eigen::Vector2d& uv = samples.parameters[i];
    exact.emplace_back (i, oracle::geometryAt (surface, uv.x(), uv.y()).k1);
  }
  return exact;
}

SurfaceScore
scoreSurface (const TimedRun& run,
              double spacing,
              const std::vector<oracle::TruthSegment>& truth,
              const std::vector<std::pair<std::size_t, double>>& curvatures)
{
  SurfaceScore result{};
  result.points = run.line_cloud->size();
  result.milliseconds = run.milliseconds;
  result.curvature_error = medianError (run.curvatures, curvatures);
  for (std::size_t i = 0; i < 2; ++i)
    result.types[i] = scoreType (run.lines,
                                 *run.line_cloud,
                                 truth,
                                 pcl::crest::CREST_TYPES[i],
                                 spacing,
                                 TOLERANCE);
  return result;
}

} // namespace accuracy
