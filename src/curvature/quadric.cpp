// SPDX-License-Identifier: BSD-3-Clause
#include "curvature/quadric.h"

#include <Eigen/Dense>

#include "base/large_arrays.h"
#include "base/parallel.h"
#include "curvature/fit_kernels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace pcl {
namespace crest {

namespace {

const PrincipalCurvature UNDETERMINED{0.0F, 0.0F, Eigen::Vector3f::Zero(), false};

/** \brief Whether the projections of a star lie on one line through the point as far as
 * its coordinates can tell.
 */
bool
isOnOneLine (const QuadricFit& fit,
             int lane,
             std::size_t star_size,
             const Eigen::Vector3f& position)
{
  constexpr double ROUNDING = 1.5 * std::numeric_limits<float>::epsilon();
  Eigen::Matrix2d moments;
  moments << fit.uu[lane], fit.uv[lane], fit.uv[lane], fit.vv[lane];
  moments /= static_cast<double> (star_size);
  // Hardly ever more than this is needed to tell: the smaller eigenvalue is at least
  // determinant / trace, and rounding moves a point by no more in any direction.
  const Eigen::Vector3d size = position.cast<double>().cwiseAbs();
  if (moments.determinant() >
      ROUNDING * ROUNDING * size.squaredNorm() * moments.trace())
    return false;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes (moments);
  const Eigen::Vector2d across = axes.eigenvectors().col (0);
  const Eigen::Vector3d direction = across.x() * fit.x[lane] + across.y() * fit.y[lane];
  // Rounding to floats moves a point by up to a third of this in that direction.
  const double rounding = ROUNDING * direction.cwiseAbs().dot (size);
  return axes.eigenvalues()[0] <= rounding * rounding;
}

/** \brief Fits some points at a time. */
class QuadricFitter : public LaneBatch<QuadricFitter> {
public:
  QuadricFitter (const OrientedPoints& points, Simd simd)
  : points_ (points), kernels_ (fitKernels (simd))
  {}

  /** \brief Fits a point together with others, at the latest when finish is called. */
  void
  fit (index_t point, const Star& star, PrincipalCurvature& result)
  {
    result = UNDETERMINED;
    if (star.size() < 3)
      return;
    if (edges_.size() < star.size())
      edges_.resize (star.size());
    for (std::size_t i = 0; i < star.size(); ++i)
      edges_[i].set (queued_, points_.edge (point, star.begin()[i]));
    normals_.set (queued_, points_.normals[point].cast<double>());
    fits_[queued_] = {point, star.size(), &result};
    push();
  }

private:
  friend LaneBatch<QuadricFitter>;

  void
  run ()
  {
    std::size_t most = 0;
    for (int lane = 0; lane < queued_; ++lane)
      most = std::max (most, fits_[lane].star_size);
    for (int lane = 0; lane < queued_; ++lane)
      for (std::size_t i = fits_[lane].star_size; i < most; ++i)
        edges_[i].set (lane, Eigen::Vector3d::Zero());
    QuadricFit fit;
    kernels_.fitQuadrics (normals_, edges_.data(), static_cast<int> (most), fit);
    // Near zero, directions as good as on two lines: errors of the heights would come
    // out some thousand times as large.
    constexpr double DEPENDENT = 1e-6;
    for (int lane = 0; lane < queued_; ++lane) {
      const auto& [point, star_size, result] = fits_[lane];
      const auto k1 = static_cast<float> (fit.k1[lane]);
      const auto k2 = static_cast<float> (fit.k2[lane]);
      if (fit.independence[lane] > DEPENDENT && std::isfinite (k1) &&
          !isOnOneLine (fit, lane, star_size, points_.positions[point]))
        *result = {k1, k2, fit.t1[lane].cast<float>(), true};
    }
  }

  struct Fit {
    index_t point;
    std::size_t star_size;
    PrincipalCurvature* result;
  };

  const OrientedPoints& points_;
  const FitKernels& kernels_;
  LaneVector normals_ = {};
  std::vector<LaneVector> edges_;
  std::array<Fit, LANES> fits_ = {};
};

} // namespace

PrincipalCurvature
fitQuadric (const OrientedPoints& points, index_t point, const Star& star)
{
  PrincipalCurvature curvature = UNDETERMINED;
  QuadricFitter fitter (points, bestSimd());
  fitter.fit (point, star, curvature);
  fitter.finish();
  return curvature;
}

std::vector<PrincipalCurvature>
estimateCurvature (const OrientedPoints& points,
                   const SurfaceGraph& graph,
                   const Workers& workers,
                   Simd simd)
{
  std::vector<PrincipalCurvature> curvature = makeLarge (points.size(), UNDETERMINED);
  forEachBlock (
      points.size(), workers, [&] (std::size_t, std::size_t first, std::size_t last) {
        QuadricFitter fitter (points, simd);
        for (std::size_t i = first; i < last; ++i) {
          const auto point = static_cast<index_t> (i);
          fitter.fit (point, graph.star (point), curvature[i]);
        }
        fitter.finish();
      });
  return curvature;
}

} // namespace crest
} // namespace pcl
