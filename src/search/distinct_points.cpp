// SPDX-License-Identifier: BSD-3-Clause
#include "search/distinct_points.h"

#include "base/large_arrays.h"

namespace pcl {
namespace crest {

DistinctPoints
takeDistinct (const PointView& cloud, const Workers& workers)
{
  DistinctPoints distinct;
  reserveLarge (distinct.points, cloud.size);
  for (std::size_t i = 0; i < cloud.size; ++i)
    if (cloud.positionOf (i).allFinite())
      distinct.points.push_back ({0, cloud.positionOf (i), static_cast<index_t> (i)});
  if (distinct.points.empty())
    return distinct;
  const CurveBox box = sortAlongCurve (distinct.points, workers);
  distinct.begins = beginsOfPlaces (distinct.points);
  distinct.center = distinct.points[distinct.points.size() / 2].position.cast<double>();
  if (box.extent() > 0.0)
    distinct.scale = 1.0 / box.extent();
  reserveLarge (distinct.positions, distinct.begins.size() - 1);
  for (std::size_t i = 0; i + 1 < distinct.begins.size(); ++i)
    distinct.positions.push_back (
        distinct.fromCloud (distinct.points[distinct.begins[i]].position));
  return distinct;
}

} // namespace crest
} // namespace pcl
