// SPDX-License-Identifier: BSD-3-Clause
#include "normal_score.h"

#include <pcl/features/normal_3d_omp.h>

#include <Eigen/Geometry>

#include "timed_run.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace accuracy {

namespace {

using Cloud = pcl::PointCloud<pcl::PointNormal>;

/** \brief Angles to the exact normals in degrees, 0 to 180; 90 without a normal. */
std::vector<double>
anglesOf (const std::vector<Eigen::Vector3f>& normals, const Cloud& exact)
{
  std::vector<double> angles (normals.size(), 90.0);
  for (std::size_t i = 0; i < normals.size(); ++i) {
    const Eigen::Vector3d n = normals[i].cast<double>();
    const Eigen::Vector3d m = exact[i].getNormalVector3fMap().cast<double>();
    if (n.allFinite() && !n.isZero())
      angles[i] = std::atan2 (n.cross (m).norm(), n.dot (m)) * 180.0 / M_PI;
  }
  return angles;
}

double
median (std::vector<double> values)
{
  if (values.empty())
    return std::numeric_limits<double>::quiet_NaN();
  const auto middle = values.begin() + static_cast<std::ptrdiff_t> (values.size() / 2);
  std::nth_element (values.begin(), middle, values.end());
  return *middle;
}

AngleErrors
angleErrors (const std::vector<double>& angles,
             const std::vector<double>& edge_distances)
{
  std::vector<double> near;
  std::vector<double> far;
  for (std::size_t i = 0; i < angles.size(); ++i) {
    const double unsigned_angle = std::min (angles[i], 180.0 - angles[i]);
    if (edge_distances[i] > FAR_FROM_EDGES)
      far.push_back (unsigned_angle);
    if (edge_distances[i] < NEAR_EDGE)
      near.push_back (unsigned_angle);
  }
  return {median (far), median (near)};
}

double
share (std::size_t part, std::size_t whole)
{
  // NaN of nothing
  return static_cast<double> (part) / static_cast<double> (whole);
}

double
distance (const Eigen::Vector3d& p, const oracle::SharpEdge& edge)
{
  const Eigen::Vector3d along = edge.b - edge.a;
  const double place = (p - edge.a).dot (along) / along.squaredNorm();
  return (edge.a + std::clamp (place, 0.0, 1.0) * along - p).norm();
}

} // namespace

NormalRun
runNormals (const Cloud& cloud, bool closed, unsigned threads)
{
  NormalRun run;
  pcl::crest::NormalRequest request;
  request.cloud = {
      &cloud[0].x, nullptr, sizeof (pcl::PointNormal) / sizeof (float), cloud.size()};
  request.k = NORMAL_NEIGHBORS;
  request.threads = threads;
  if (!closed)
    request.hints.up = Eigen::Vector3f::UnitZ();
  run.milliseconds =
      millisecondsOf ([&] { run.estimate = pcl::crest::estimateNormals (request); });

  pcl::NormalEstimationOMP<pcl::PointNormal, pcl::Normal> estimation (threads);
  estimation.setInputCloud (cloud.makeShared());
  estimation.setKSearch (NORMAL_NEIGHBORS);
  pcl::PointCloud<pcl::Normal> normals;
  run.milliseconds_of_pcl = millisecondsOf ([&] { estimation.compute (normals); });
  for (const pcl::Normal& normal : normals)
    run.of_pcl.emplace_back (normal.getNormalVector3fMap());
  return run;
}

std::vector<double>
edgeDistances (const oracle::SolidCloud& exact)
{
  std::vector<double> result (exact.cloud->size(),
                              std::numeric_limits<double>::infinity());
#pragma omp parallel for schedule(static)
  for (std::size_t i = 0; i < result.size(); ++i)
    for (const oracle::SharpEdge& edge : exact.edges)
      result[i] =
          std::min (result[i],
                    distance ((*exact.cloud)[i].getVector3fMap().cast<double>(), edge) /
                        exact.spacing);
  return result;
}

NormalScore
scoreNormals (const NormalRun& run,
              const oracle::SolidCloud& exact,
              const std::vector<double>& edge_distances)
{
  const std::vector<double> angles = anglesOf (run.estimate.normals, *exact.cloud);
  std::size_t decided = 0;
  std::size_t wrong = 0;
  std::size_t sure = 0;
  std::size_t sure_decided = 0;
  std::size_t sure_wrong = 0;
  for (std::size_t i = 0; i < angles.size(); ++i) {
    const bool is_sure = run.estimate.trust[i] >= pcl::crest::SURE_SIGN;
    sure += is_sure ? 1 : 0;
    constexpr double UNDECIDED = 60.0;
    if (std::min (angles[i], 180.0 - angles[i]) >= UNDECIDED)
      continue;
    const bool is_wrong = angles[i] > 90.0;
    ++decided;
    wrong += is_wrong ? 1 : 0;
    sure_decided += is_sure ? 1 : 0;
    sure_wrong += is_sure && is_wrong ? 1 : 0;
  }
  NormalScore score;
  score.points = angles.size();
  score.undecided = share (angles.size() - decided, angles.size());
  score.wrong = share (wrong, decided);
  score.unsure = share (angles.size() - sure, angles.size());
  score.wrong_of_sure = share (sure_wrong, sure_decided);
  score.angle = angleErrors (angles, edge_distances);
  score.angle_of_pcl =
      angleErrors (anglesOf (run.of_pcl, *exact.cloud), edge_distances);
  score.milliseconds = run.milliseconds;
  score.milliseconds_of_pcl = run.milliseconds_of_pcl;
  return score;
}

} // namespace accuracy
