// SPDX-License-Identifier: BSD-3-Clause
#include "lines/line_measures.h"

#include "base/parallel.h"

#include <algorithm>
#include <cmath>

namespace pcl {
namespace crest {

namespace {

bool
nearBoundary (const SurfaceGraph& graph, index_t point)
{
  const Star star = graph.star (point);
  return graph.boundary[point] != 0 ||
         std::any_of (star.begin(), star.end(), [&] (index_t q) {
           return graph.boundary[q] != 0;
         });
}

/** \brief How often polylines come to each of `size` points. */
std::vector<int>
countVisits (std::size_t size, const std::vector<CrestLine>& lines)
{
  std::vector<int> count (size, 0);
  for (const CrestLine& line : lines)
    for (const std::vector<index_t>& polyline : line.polylines)
      for (const index_t p : polyline)
        ++count[p];
  return count;
}

} // namespace

void
measureLines (const OrientedPoints& points,
              const std::vector<PrincipalCurvature>& curvature,
              unsigned threads,
              std::vector<CrestLine>& lines)
{
  const auto measure = [&] (CrestLine& line) {
    line.length = 0.0;
    line.strength = 0.0;
    for (const std::vector<index_t>& polyline : line.polylines) {
      double of_polyline = 0.0;
      for (std::size_t i = 1; i < polyline.size(); ++i) {
        const index_t p = polyline[i - 1];
        const index_t q = polyline[i];
        const double length = points.edge (p, q).norm();
        of_polyline += length;
        line.strength +=
            0.5 * length * (std::abs (curvature[p].k1) + std::abs (curvature[q].k1));
      }
      line.length += of_polyline;
    }
    line.mean_curvature = line.length > 0.0 ? line.strength / line.length : 0.0;
  };
  const auto count = static_cast<std::ptrdiff_t> (lines.size());
  // A few lines of thousands may be most of the work.
#pragma omp parallel for schedule(dynamic, 16) num_threads(threadCount(threads))
  for (std::ptrdiff_t i = 0; i < count; ++i)
    measure (lines[i]);
}

void
classifyEnds (const SurfaceGraph& graph, std::vector<CrestLine>& lines)
{
  // A line may end in a corner of lines of the other type.
  const std::vector<int> visits = countVisits (graph.size(), lines);
  const auto endAt = [&] (const CrestLine& line, index_t point) {
    if (line.closed)
      return LineEnd::CLOSED;
    if (visits[point] > 1)
      return LineEnd::JUNCTION;
    return nearBoundary (graph, point) ? LineEnd::BOUNDARY : LineEnd::FREE;
  };
  for (CrestLine& line : lines) {
    line.ends.clear();
    for (const std::vector<index_t>& polyline : line.polylines)
      line.ends.push_back (
          {endAt (line, polyline.front()), endAt (line, polyline.back())});
  }
}

void
measureProfiles (const std::vector<CrestProfile>& profiles,
                 const std::vector<CrestType>& crest_points,
                 std::vector<CrestLine>& lines)
{
  for (CrestLine& line : lines) {
    double angle = 0.0;
    double radius = 0.0;
    double count = 0.0;
    for (const std::vector<index_t>& polyline : line.polylines)
      for (const index_t p : polyline)
        if (crest_points[p] != CrestType::NONE) {
          angle += turningAngle (profiles[p].sharpness);
          radius += profiles[p].radius;
          count += 1.0;
        }
    line.turning_angle = count > 0.0 ? angle / count : 0.0;
    line.scale = count > 0.0 ? radius / count : 0.0;
  }
}

} // namespace crest
} // namespace pcl
