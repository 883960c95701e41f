// SPDX-License-Identifier: BSD-3-Clause
// How far points are from a smooth surface.
#pragma once

#include <Eigen/Geometry>

#include "curvature/fit_kernels.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace pcl {
namespace crest {

/** \brief The residuals of cubic height functions that are fitted to points, of some
 * samples at a time.
 */
class CubicResiduals {
public:
  /** \param[in] most points of a fit */
  explicit CubicResiduals (int most) : samples_ (static_cast<std::size_t> (most)) {}

  /** \brief Sets the points of a lane; what is fitted next starts anew for all lanes.
   * \param[in] normal the direction of heights
   * \param[in] size about the largest distance of a point from the origin
   * \param[in] count, position (i) the points
   */
  template <typename Position>
  void
  set (int lane,
       const Eigen::Vector3d& normal,
       double size,
       std::size_t count,
       const Position& position)
  {
    const Eigen::Vector3d x = normal.unitOrthogonal() / size;
    const Eigen::Vector3d y = normal.cross (x);
    for (std::size_t i = 0; i < count; ++i) {
      const Eigen::Vector3d& p = position (i);
      LaneSample& sample = samples_[i];
      sample.u[lane] = p.dot (x);
      sample.v[lane] = p.dot (y);
      sample.value[lane] = p.dot (normal);
      sample.weight[lane] = 1.0;
    }
    for (std::size_t i = count; i < samples_.size(); ++i)
      samples_[i].clear (lane);
    sums_ = CubicSums();
    added_ = 0;
  }

  /** \brief Fits to the first points of all lanes, more of them than at the time
   * before.
   */
  void
  fit (int count)
  {
    kernels_.addHeights (samples_.data() + added_, count - added_, sums_);
    added_ = count;
    kernels_.fitCubics (sums_, cubics_);
  }

  /** \brief Mean squared distance of the points of a lane from the cubic, for its
   * degrees of freedom; there have to be more points than its ten terms.
   */
  double
  meanSquare (int lane) const
  {
    // Seen along a face, heights are no function of the place.
    const double residual = std::isfinite (cubics_.residual[lane])
                                ? std::max (0.0, cubics_.residual[lane])
                                : sums_.squared_heights[lane];
    return residual / (sums_.powers[0][lane] - CubicSums::TERMS);
  }

private:
  const FitKernels& kernels_ = fitKernels();
  std::vector<LaneSample> samples_;
  CubicSums sums_;
  int added_ = 0;
  CubicFit cubics_ = {};
};

} // namespace crest
} // namespace pcl
