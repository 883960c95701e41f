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
  }

  /** \brief Fits to the nearest, or to all where fewer are there. Returns false where
   * these tell nothing.
   */
  bool
  fit (int window, WindowFit& result) const
  {
    const auto count = std::min (near_.size(), static_cast<std::size_t> (window));
    if (count < LEAST_NEIGHBORS)
      return false;
    const auto size = static_cast<double> (count);
    const auto step = [this] (std::size_t i) -> Eigen::Vector3d {
      return points_.positions[near_[i].second].cast<double>() -
             points_.positions[sample_].cast<double>();
    };
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
    for (std::size_t i = 0; i < count; ++i) {
      mean += step (i) / size;
      squares += step (i) * step (i).transpose();
    }
    squares -= size * mean * mean.transpose();
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes (squares);
    Eigen::Vector3d n = axes.eigenvectors().col (0);
    if (n.dot (normals_[sample_].cast<double>()) < 0.0)
      n = -n;
    const Eigen::Vector3d x = n.unitOrthogonal();
    const Eigen::Vector3d y = n.cross (x);
    const double radius =
        std::sqrt (2.0 * (axes.eigenvalues()[1] + axes.eigenvalues()[2]) / size);
    if (!(radius > 0.0))
      return false;

    using Terms = Eigen::Matrix<double, TERMS, 1>;
    Eigen::Matrix<double, TERMS, TERMS> products =
        Eigen::Matrix<double, TERMS, TERMS>::Zero();
    Terms heights = Terms::Zero();
    double squared_heights = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
      const Eigen::Vector3d e = step (i) / radius;
      const double u = e.dot (x);
      const double v = e.dot (y);
      const double height = e.dot (n);
      const Terms terms = (Terms() << 1.0, u, v, u * u, u * v, v * v).finished();
      products += terms * terms.transpose();
      heights += height * terms;
      squared_heights += height * height;
    }
    const Terms quadric = products.ldlt().solve (heights);
    const double left = std::max (0.0, squared_heights - quadric.dot (heights));
    result.foot = points_.positions[sample_].cast<double>() + radius * quadric[0] * n;
    result.normal = (n - quadric[1] * x - quadric[2] * y).normalized();
    result.noise = radius * std::sqrt (left / (size - TERMS));
    result.spacing = radius * std::sqrt (M_PI / size);
    result.radius = radius;
    return result.foot.allFinite() && result.normal.allFinite();
  }

private:
  const OrientedPoints& points_;
  const std::vector<Eigen::Vector3f>& places_;
  const std::vector<Eigen::Vector3f>& normals_;
  float least_cosine_;
  index_t sample_ = 0;
  /** squared distances of places, and samples */
  std::vector<std::pair<double, index_t>> near_;
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
  const auto flatten = [&places] (index_t sample, const FootFitter& fitter) {
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
