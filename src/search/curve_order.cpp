// SPDX-License-Identifier: BSD-3-Clause
#include "search/curve_order.h"

#include "base/large_arrays.h"
#include "base/parallel.h"
#include "base/radix_sort.h"

#include <limits>
#include <tuple>

namespace pcl {
namespace crest {

namespace {

/** \brief Spreads the lowest 21 bits to every third bit. */
std::uint64_t
spreadBits (std::uint64_t v)
{
  v &= 0x1fffffULL;
  v = (v | v << 32) & 0x001f00000000ffffULL;
  v = (v | v << 16) & 0x001f0000ff0000ffULL;
  v = (v | v << 8) & 0x100f00f00f00f00fULL;
  v = (v | v << 4) & 0x10c30c30c30c30c3ULL;
  v = (v | v << 2) & 0x1249249249249249ULL;
  return v;
}

std::uint64_t
mortonCode (const Eigen::Vector3f& p, const Eigen::Vector3f& low, double cells_per_unit)
{
  const Eigen::Vector3d cell = (p.cast<double>() - low.cast<double>()) * cells_per_unit;
  return spreadBits (static_cast<std::uint64_t> (cell.x())) |
         spreadBits (static_cast<std::uint64_t> (cell.y())) << 1 |
         spreadBits (static_cast<std::uint64_t> (cell.z())) << 2;
}

} // namespace

CurveBox
sortAlongCurve (std::vector<CurvePoint>& points, const Workers& workers)
{
  CurveBox box;
  box.low.setConstant (std::numeric_limits<float>::infinity());
  box.high = -box.low;
  for (const CurvePoint& point : points) {
    box.low = box.low.cwiseMin (point.position);
    box.high = box.high.cwiseMax (point.position);
  }
  constexpr double CELLS = (1 << 21) - 1;
  const double extent = points.empty() ? 0.0 : box.extent();
  if (extent > 0.0)
    forEachBlock (
        points.size(), workers, [&] (std::size_t, std::size_t first, std::size_t last) {
          for (std::size_t i = first; i < last; ++i)
            points[i].code = mortonCode (points[i].position, box.low, CELLS / extent);
        });
  radixSort (
      points.data(),
      points.data() + points.size(),
      [] (const CurvePoint& p) { return p.code; },
      [] (const CurvePoint& p, const CurvePoint& q) {
        return std::make_tuple (
                   p.position.x(), p.position.y(), p.position.z(), p.cloud_index) <
               std::make_tuple (
                   q.position.x(), q.position.y(), q.position.z(), q.cloud_index);
      });
  return box;
}

std::vector<std::size_t>
beginsOfPlaces (const std::vector<CurvePoint>& points)
{
  std::vector<std::size_t> begins;
  reserveLarge (begins, points.size() + 1);
  for (std::size_t i = 0; i < points.size(); ++i)
    if (i == 0 || points[i].position != points[i - 1].position)
      begins.push_back (i);
  begins.push_back (points.size());
  return begins;
}

} // namespace crest
} // namespace pcl
