// SPDX-License-Identifier: BSD-3-Clause
#include "surface_score.h"

#include <pcl_crest/crest_line_estimation.h>

#include <pcl/search/kdtree.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <set>

namespace accuracy {

namespace {

using pcl::crest::CrestLine;
using pcl::crest::CrestType;
using pcl::crest::LineEnd;

TypeScore
scoreType (const std::vector<CrestLine>& lines,
           const pcl::PointCloud<pcl::PointNormal>& line_cloud,
           double spacing,
           const std::vector<oracle::TruthSegment>& truth,
           CrestType type)
{
  const oracle::LineScore score =
      oracle::scoreLines (lines, line_cloud, truth, type, TOLERANCE * spacing);
  TypeScore result{};
  result.type = type;
  result.precision = score.precision;
  result.recall = score.recall;
  result.error = TOLERANCE * score.error;
  result.drawn_length = score.drawn_length / spacing;
  result.salient_length = score.salient_length / spacing;
  for (const oracle::TruthSegment& s : truth)
    if (s.type == type)
      result.true_length += (s.b - s.a).norm() / spacing;
  std::set<pcl::index_t> junctions;
  for (const CrestLine& line : lines) {
    if (line.type != type)
      continue;
    ++result.lines;
    result.closed += line.closed ? 1 : 0;
    for (std::size_t i = 0; i < line.polylines.size(); ++i) {
      if (line.ends[i][0] == LineEnd::JUNCTION)
        junctions.insert (line.polylines[i].front());
      if (line.ends[i][1] == LineEnd::JUNCTION)
        junctions.insert (line.polylines[i].back());
    }
  }
  result.junctions = junctions.size();
  return result;
}

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
scoreRun (const pcl::PointCloud<pcl::PointNormal>::ConstPtr& cloud,
          double spacing,
          const std::vector<oracle::TruthSegment>& truth,
          const std::vector<std::pair<std::size_t, double>>& curvatures,
          const pcl::crest::Parameters& parameters)
{
  pcl::CrestLineEstimation<pcl::PointNormal> estimation;
  estimation.setInputCloud (cloud);
  estimation.setParameters (parameters);
  pcl::PointCloud<pcl::Label> labels;
  const auto start = std::chrono::steady_clock::now();
  estimation.compute (labels);
  const std::chrono::duration<double, std::milli> took =
      std::chrono::steady_clock::now() - start;

  SurfaceScore result{};
  result.points = cloud->size();
  result.milliseconds = took.count();
  result.curvature_error =
      medianError (estimation.getPrincipalCurvatures(), curvatures);
  for (std::size_t i = 0; i < 2; ++i)
    result.types[i] = scoreType (estimation.getLines(),
                                 *estimation.getLineCloud(),
                                 spacing,
                                 truth,
                                 pcl::crest::CREST_TYPES[i]);
  return result;
}

} // namespace accuracy
