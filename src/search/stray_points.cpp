// SPDX-License-Identifier: BSD-3-Clause
#include "search/stray_points.h"

#include "base/quantile.h"

#include <algorithm>
#include <array>
#include <limits>

namespace pcl {
namespace crest {

namespace {

/** In widths of the bulk. */
constexpr double FARTHEST = 1e3;

struct Range {
  Eigen::Array3d low = Eigen::Array3d::Zero();
  Eigen::Array3d high = Eigen::Array3d::Zero();
  std::size_t points = 0;

  int
  widestAxis () const
  {
    int axis = 0;
    (high - low).maxCoeff (&axis);
    return axis;
  }
  double
  width () const
  {
    return (high - low).maxCoeff();
  }
};

/** \brief The bounding box of the finite points. */
Range
rangeOf (const PointView& cloud)
{
  Eigen::Array3f low =
      Eigen::Array3f::Constant (std::numeric_limits<float>::infinity());
  Eigen::Array3f high = -low;
  Range range;
  for (std::size_t i = 0; i < cloud.size; ++i) {
    const Eigen::Array3f p = cloud.positionOf (i).array();
    if (!p.allFinite())
      continue;
    low = low.min (p);
    high = high.max (p);
    ++range.points;
  }
  if (range.points != 0) {
    range.low = low.cast<double>();
    range.high = high.cast<double>();
  }
  return range;
}

/** \brief Whether nine tenths of the points surely take up so much of the range along
 * its widest axis that nothing in it is astray: that takes no sorting.
 */
bool
isFilled (const PointView& cloud, const Range& range)
{
  constexpr std::size_t BINS = 2048;
  constexpr std::size_t LEAST = 4;
  static_assert (FARTHEST * (LEAST - 1) > BINS, "else there is room for strays");
  const int axis = range.widestAxis();
  std::array<std::size_t, BINS> counts{};
  const double scale = (BINS - 1) / range.width();
  for (std::size_t i = 0; i < cloud.size; ++i) {
    const Eigen::Vector3f p = cloud.positionOf (i);
    if (p.allFinite())
      ++counts[static_cast<std::size_t> (
          scale * (static_cast<double> (p[axis]) - range.low[axis]))];
  }
  const auto binOf = [&] (std::size_t percent) {
    const std::size_t rank = range.points * percent / 100;
    std::size_t before = counts[0];
    std::size_t bin = 0;
    while (before <= rank)
      before += counts[++bin];
    return bin;
  };
  return binOf (95) - binOf (5) >= LEAST;
}

/** \brief The range of the nine tenths in the middle, axis by axis. */
Range
bulkOf (const PointView& cloud, const Range& range)
{
  Range bulk;
  bulk.points = range.points;
  std::vector<float> values;
  values.reserve (range.points);
  for (int axis = 0; axis < 3; ++axis) {
    values.clear();
    for (std::size_t i = 0; i < cloud.size; ++i) {
      const Eigen::Vector3f p = cloud.positionOf (i);
      if (p.allFinite())
        values.push_back (p[axis]);
    }
    bulk.low[axis] = static_cast<double> (quantile (values, 5));
    bulk.high[axis] = static_cast<double> (quantile (values, 95));
  }
  return bulk;
}

} // namespace

NearPoints::NearPoints (const PointView& cloud) : view_ (cloud)
{
  const Range range = rangeOf (cloud);
  if (!(range.width() > 0.0) || isFilled (cloud, range))
    return;
  const Range bulk = bulkOf (cloud, range);
  const double reach = FARTHEST * bulk.width();
  // Of one place there is nothing to be far from.
  if (!(reach > 0.0) || ((bulk.low - range.low).maxCoeff() <= reach &&
                         (range.high - bulk.high).maxCoeff() <= reach))
    return;
  positions_.reserve (cloud.size);
  for (std::size_t i = 0; i < cloud.size; ++i) {
    const Eigen::Vector3f p = cloud.positionOf (i);
    const Eigen::Array3d place = p.cast<double>().array();
    const bool is_stray =
        (place < bulk.low - reach).any() || (place > bulk.high + reach).any();
    positions_.push_back (
        is_stray
            ? Eigen::Vector3f::Constant (std::numeric_limits<float>::quiet_NaN()).eval()
            : p);
  }
  view_.position = positions_.front().data();
  view_.stride = 3;
  if (view_.normal_stride == 0)
    view_.normal_stride = cloud.stride;
}

} // namespace crest
} // namespace pcl
