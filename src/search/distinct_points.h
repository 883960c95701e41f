// SPDX-License-Identifier: BSD-3-Clause
// The distinct points of a cloud, scaled.
#pragma once

#include "search/curve_order.h"
#include "search/point_view.h"

#include <vector>

namespace pcl {
namespace crest {

/** \brief The distinct finite points of a cloud, scaled to unit size about one of them
 * in the middle of their order: where most are, whatever strays, single precision does
 * no harm.
 */
struct DistinctPoints {
  std::vector<Eigen::Vector3f> positions;
  /** the points of the cloud, coincident ones next to each other */
  std::vector<CurvePoint> points;
  /** where in these the ones at each position begin, and the end */
  std::vector<std::size_t> begins;
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  double scale = 1.0;

  Eigen::Vector3f
  fromCloud (const Eigen::Vector3f& position) const
  {
    return ((position.cast<double>() - center) * scale).cast<float>();
  }

  /** \brief Viewpoints farther away than this see the cloud as from there. */
  Eigen::Vector3f
  fromViewpoint (const Eigen::Vector3f& viewpoint) const
  {
    constexpr double FARTHEST = 1e3;
    const Eigen::Vector3d place = (viewpoint.cast<double>() - center) * scale;
    const double distance = place.stableNorm();
    return (distance > FARTHEST ? (FARTHEST / distance * place).eval() : place)
        .cast<float>();
  }
};

DistinctPoints
takeDistinct (const PointView& cloud, const Workers& workers);

} // namespace crest
} // namespace pcl
