// SPDX-License-Identifier: BSD-3-Clause
#include "surface/flat_places.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include "base/parallel.h"
#include "base/quantile.h"
#include "search/position_tree.h"
#include "surface/neighbor_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace pcl {
namespace crest {

namespace {

/** Terms of a quadric height function. */
constexpr int TERMS = 6;
/** Fewer tell too little of the noise. */
constexpr std::size_t LEAST_NEIGHBORS = 16;
constexpr std::array<int, 2> WINDOWS{48, 96};
/** Of a window's radius: what is noisier is not flat in it. */
constexpr double FLAT = 0.2;
/** Least cosines between normals of one sheet, as they come and as windows have made
 * them. */
constexpr float SAME_SHEET = 0.0F;
constexpr float CERTAIN_SHEET = 0.3F;

/** \brief What a window tells of the surface at its sample, in the cloud's unit. */
struct WindowFit {
  Eigen::Vector3d foot;
  Eigen::Vector3d normal;
  double noise;
  double spacing;
  double radius;
};

/** \brief The sums that a quadric height function is fitted from: the moments of places
 * u, v, up to the fourth, and of heights with the terms 1, u, v, uu, uv, vv.
 */
class QuadricMoments {
public:
  /** \param[in] u, v, height of `count` points */
  QuadricMoments (const double* u,
                  const double* v,
                  const double* height,
                  std::size_t count)
  : count_ (static_cast<double> (count))
  {
    double s10 = 0.0, s01 = 0.0, s20 = 0.0, s11 = 0.0, s02 = 0.0, s30 = 0.0, s21 = 0.0;
    double s12 = 0.0, s03 = 0.0, s40 = 0.0, s31 = 0.0, s22 = 0.0, s13 = 0.0, s04 = 0.0;
    double h = 0.0, hu = 0.0, hv = 0.0, huu = 0.0, huv = 0.0, hvv = 0.0, hh = 0.0;
#pragma omp simd reduction(+ : s10, s01, s20, s11, s02, s30, s21, s12, s03, s40, s31)  \
    reduction(+ : s22, s13, s04, h, hu, hv, huu, huv, hvv, hh)
    for (std::size_t i = 0; i < count; ++i) {
      const double uu = u[i] * u[i];
      const double uv = u[i] * v[i];
      const double vv = v[i] * v[i];
      s10 += u[i];
      s01 += v[i];
      s20 += uu;
      s11 += uv;
      s02 += vv;
      s30 += uu * u[i];
      s21 += uu * v[i];
      s12 += vv * u[i];
      s03 += vv * v[i];
      s40 += uu * uu;
      s31 += uu * uv;
      s22 += uv * uv;
      s13 += uv * vv;
      s04 += vv * vv;
      h += height[i];
      hu += height[i] * u[i];
      hv += height[i] * v[i];
      huu += height[i] * uu;
      huv += height[i] * uv;
      hvv += height[i] * vv;
      hh += height[i] * height[i];
    }
    products_ << count_, s10, s01, s20, s11, s02, //
        s10, s20, s11, s30, s21, s12,             //
        s01, s11, s02, s21, s12, s03,             //
        s20, s30, s21, s40, s31, s22,             //
        s11, s21, s12, s31, s22, s13,             //
        s02, s12, s03, s22, s13, s04;
    heights_ << h, hu, hv, huu, huv, hvv;
    squared_heights_ = hh;
  }

  /** \brief The coefficients of the terms.
   * \param[out] left the standard deviation from the quadric
   */
  Eigen::Matrix<double, TERMS, 1>
  fit (double& left) const
  {
    Eigen::Matrix<double, TERMS, 1> quadric = products_.ldlt().solve (heights_);
    left = std::sqrt (std::max (0.0, squared_heights_ - quadric.dot (heights_)) /
                      (count_ - TERMS));
    return quadric;
  }

private:
  double count_;
  Eigen::Matrix<double, TERMS, TERMS> products_;
  Eigen::Matrix<double, TERMS, 1> heights_;
  double squared_heights_;
};

/** \brief Fits windows around one sample after the other. */
class FootFitter {
public:
  /** \param[in] points the samples
   *
   * \param[in] places, normals where they are in the surface, and its normals there, as
   * far as is known
   *
   * \param[in] least_cosine between normals of one sheet
   */
  FootFitter (const OrientedPoints& points,
              const std::vector<Eigen::Vector3f>& places,
              const std::vector<Eigen::Vector3f>& normals,
              float least_cosine)
  : points_ (points), places_ (places), normals_ (normals), least_cosine_ (least_cosine)
  {}

  /** \brief Takes what a search has found, in any order. */
  void
  setNeighbors (index_t sample, const std::vector<index_t>& found)
  {
    sample_ = sample;
    const Eigen::Vector3f& place = places_[sample];
    const Eigen::Vector3f& normal = normals_[sample];
    near_.clear();
    for (const index_t q : found)
      if (normals_[q].dot (normal) > least_cosine_)
        near_.emplace_back ((places_[q] - place).cast<double>().squaredNorm(), q);
    std::sort (near_.begin(), near_.end());
    if (near_.size() > WIDEST)
      near_.resize (WIDEST);
    for (std::size_t i = 0; i < near_.size(); ++i)
      steps_.row (static_cast<Eigen::Index> (i)) =
          points_.edge (sample, near_[i].second).transpose();
  }

  /** \brief Fits to the nearest, or to all where fewer are there. Returns false where
   * these tell nothing.
   */
  bool
  fit (int window, WindowFit& result)
  {
    const auto count = std::min (near_.size(), static_cast<std::size_t> (window));
    if (count < LEAST_NEIGHBORS)
      return false;
    const auto size = static_cast<double> (count);
    const auto steps = steps_.topRows (static_cast<Eigen::Index> (count));
    const Eigen::Vector3d mean = steps.colwise().mean();
    const Eigen::Matrix3d squares =
        steps.transpose() * steps - size * mean * mean.transpose();
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes;
    axes.computeDirect (squares);
    Eigen::Vector3d n = axes.eigenvectors().col (0);
    if (n.dot (normals_[sample_].cast<double>()) < 0.0)
      n = -n;
    const Eigen::Vector3d x = n.unitOrthogonal();
    const Eigen::Vector3d y = n.cross (x);
    const double radius =
        std::sqrt (2.0 * (axes.eigenvalues()[1] + axes.eigenvalues()[2]) / size);
    if (!(radius > 0.0))
      return false;
    Eigen::Matrix3d frame;
    frame << x, y, n;
    auto places = places_and_heights_.topRows (static_cast<Eigen::Index> (count));
    places.noalias() = steps * (frame / radius);

    double left = 0.0;
    const auto quadric =
        QuadricMoments (
            places.col (0).data(), places.col (1).data(), places.col (2).data(), count)
            .fit (left);
    result.foot = points_.positions[sample_].cast<double>() + radius * quadric[0] * n;
    result.normal = (n - quadric[1] * x - quadric[2] * y).normalized();
    result.noise = radius * left;
    result.spacing = radius * std::sqrt (M_PI / size);
    result.radius = radius;
    return result.foot.allFinite() && result.normal.allFinite();
  }

private:
  static constexpr std::size_t WIDEST = WINDOWS.back();
  using Rows = Eigen::Matrix<double, static_cast<int> (WIDEST), 3>;

  const OrientedPoints& points_;
  const std::vector<Eigen::Vector3f>& places_;
  const std::vector<Eigen::Vector3f>& normals_;
  float least_cosine_;
  index_t sample_ = 0;
  /** squared distances of places, and samples */
  std::vector<std::pair<double, index_t>> near_;
  /** from the sample to those that are near, and the same in the frame of the window
   * and in its radius */
  Rows steps_;
  Rows places_and_heights_;
};

/** \brief The first quartile; 0 of none. */
double
firstQuartile (std::vector<double> values)
{
  return values.empty() ? 0.0 : quantile (values, 25);
}

/** \brief One round: windows hold what is near by the places of the one before. */
void
flattenOnce (const OrientedPoints& points,
             float least_cosine,
             const Workers& workers,
             FlatPlaces& places)
{
  const std::vector<Eigen::Vector3f> positions = places.positions;
  const std::vector<Eigen::Vector3f> normals = places.normals;
  const std::shared_ptr<const PointTree> tree = treeOver (positions, workers.threads);
  const auto flatten = [&places] (index_t sample, FootFitter& fitter) {
    WindowFit fit;
    for (const int window : WINDOWS) {
      if (!fitter.fit (window, fit))
        return;
      if (fit.noise <= FLAT * fit.radius)
        break;
    }
    places.positions[sample] = fit.foot.cast<float>();
    places.normals[sample] = fit.normal.cast<float>();
    places.noise[sample] = static_cast<float> (fit.noise);
    places.spacings[sample] = static_cast<float> (fit.spacing);
  };
  forEachBlock (
      points.size(), workers, [&] (std::size_t, std::size_t first, std::size_t last) {
        FootFitter fitter (points, positions, normals, least_cosine);
        visitLeaves (*tree,
                     WINDOWS.back(),
                     first,
                     last,
                     [&] (index_t sample, const std::vector<index_t>& found) {
                       fitter.setNeighbors (sample, found);
                       flatten (sample, fitter);
                     });
      });
}

} // namespace

double
typicalNoise (const FlatPlaces& places)
{
  std::vector<double> ratios;
  for (std::size_t i = 0; i < places.noise.size(); ++i)
    if (places.spacings[i] > 0.0F)
      ratios.push_back (places.noise[i] / places.spacings[i]);
  return firstQuartile (std::move (ratios));
}

double
typicalNoise (const OrientedPoints& points, const NeighborSearch& search)
{
  constexpr std::size_t SAMPLES = 512;
  constexpr int WINDOW = 24;
  FootFitter fitter (points, points.positions, points.normals, SAME_SHEET);
  std::vector<index_t> found;
  std::vector<double> ratios;
  const std::size_t count = std::min (SAMPLES, points.size());
  for (std::size_t i = 0; i < count; ++i) {
    const auto sample = static_cast<index_t> (i * points.size() / count);
    search (sample, found);
    fitter.setNeighbors (sample, found);
    WindowFit fit;
    if (fitter.fit (WINDOW, fit))
      ratios.push_back (fit.noise / fit.spacing);
  }
  return firstQuartile (std::move (ratios));
}

FlatPlaces
flattenPlaces (const OrientedPoints& points, const Workers& workers)
{
  FlatPlaces places{points.positions,
                    points.normals,
                    std::vector<float> (points.size(), 0.0F),
                    std::vector<float> (points.size(), 0.0F)};
  for (const float least_cosine : {SAME_SHEET, CERTAIN_SHEET})
    flattenOnce (points, least_cosine, workers, places);
  return places;
}

} // namespace crest
} // namespace pcl
