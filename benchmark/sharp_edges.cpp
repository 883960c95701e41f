// SPDX-License-Identifier: BSD-3-Clause
#include "sharp_edges.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace accuracy {

namespace {

using pcl::crest::CrestLine;
using pcl::crest::CrestType;
using pcl::crest::LineEnd;

/** \brief Edges as truth of which everything is salient, in pieces shorter than h. */
std::vector<oracle::TruthSegment>
asTruth (const std::vector<SharpEdge>& edges, double spacing)
{
  std::vector<oracle::TruthSegment> truth;
  for (const SharpEdge& edge : edges) {
    const Eigen::Vector3d step = edge.b - edge.a;
    const int pieces =
        std::max (1, static_cast<int> (std::ceil (step.norm() / spacing)));
    for (int i = 0; i < pieces; ++i)
      truth.push_back ({edge.a + step * i / pieces,
                        edge.a + step * (i + 1) / pieces,
                        edge.type,
                        1.0,
                        1.0});
  }
  return truth;
}

/** \brief An end of a polyline. */
struct End {
  Eigen::Vector3d position;
  bool junction;
};

std::vector<End>
endsOf (const TimedRun& run)
{
  std::vector<End> ends;
  for (const CrestLine& line : run.lines)
    for (std::size_t i = 0; i < line.ends.size(); ++i)
      for (const std::size_t side : {0U, 1U}) {
        if (line.ends[i][side] == LineEnd::CLOSED)
          continue;
        const pcl::index_t at =
            side == 0 ? line.polylines[i].front() : line.polylines[i].back();
        ends.push_back ({(*run.line_cloud)[at].getVector3fMap().cast<double>(),
                         line.ends[i][side] == LineEnd::JUNCTION});
      }
  return ends;
}

bool
linesMeet (const std::vector<End>& ends, const Eigen::Vector3d& corner, double spacing)
{
  std::vector<End> near;
  for (const End& end : ends)
    if ((end.position - corner).norm() < SHARP_TOLERANCE * spacing)
      near.push_back (end);
  constexpr double SAME_PLACE = 0.1;
  for (std::size_t i = 0; i < near.size(); ++i) {
    if (near[i].junction)
      return true;
    for (std::size_t j = 0; j < i; ++j)
      if ((near[i].position - near[j].position).norm() < SAME_PLACE * spacing)
        return true;
  }
  return false;
}

} // namespace

std::vector<Eigen::Vector3d>
cornersOf (const std::vector<SharpEdge>& edges)
{
  std::map<std::array<double, 3>, int> meeting;
  for (const SharpEdge& edge : edges)
    if (edge.angle > 25.0)
      for (const Eigen::Vector3d& p : {edge.a, edge.b})
        ++meeting[{p.x(), p.y(), p.z()}];
  std::vector<Eigen::Vector3d> corners;
  for (const auto& [p, count] : meeting)
    if (count >= 3)
      corners.emplace_back (p[0], p[1], p[2]);
  return corners;
}

SharpScore
scoreSharp (const TimedRun& run, const std::vector<SharpEdge>& edges, double spacing)
{
  SharpScore result{};
  result.points = run.line_cloud->size();
  result.milliseconds = run.milliseconds;

  const auto score = [&] (const std::vector<CrestLine>& lines,
                          const std::vector<oracle::TruthSegment>& truth,
                          CrestType type) {
    return scoreType (lines, *run.line_cloud, truth, type, spacing, SHARP_TOLERANCE);
  };
  const std::vector<oracle::TruthSegment> truth = asTruth (edges, spacing);
  std::vector<oracle::TruthSegment> untyped_truth = truth;
  for (oracle::TruthSegment& s : untyped_truth)
    s.type = CrestType::NONE;
  std::vector<CrestLine> untyped_lines = run.lines;
  for (CrestLine& line : untyped_lines)
    line.type = CrestType::NONE;
  result.types.push_back (score (untyped_lines, untyped_truth, CrestType::NONE));
  for (const CrestType type : pcl::crest::CREST_TYPES)
    result.types.push_back (score (run.lines, truth, type));

  const std::vector<End> ends = endsOf (run);
  const std::vector<Eigen::Vector3d> corners = cornersOf (edges);
  result.corners = corners.size();
  result.joined = static_cast<std::size_t> (
      std::count_if (corners.begin(), corners.end(), [&] (const Eigen::Vector3d& p) {
        return linesMeet (ends, p, spacing);
      }));
  return result;
}

} // namespace accuracy
