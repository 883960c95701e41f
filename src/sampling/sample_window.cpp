// SPDX-License-Identifier: BSD-3-Clause
#include "sampling/sample_window.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl {
namespace crest {

namespace {

constexpr double PI = 3.14159265358979323846;
/** Heights that differ by less, in spacings, are the same. */
constexpr double SAME_HEIGHT = 2e-3;

/** \brief What a cubic height function leaves of points in the frame of their window,
 * standard deviation.
 */
double
cubicResidual (const Eigen::Matrix3Xd& points)
{
  constexpr int TERMS = 10;
  const auto u = points.row (0).array();
  const auto v = points.row (1).array();
  Eigen::Matrix<double, TERMS, Eigen::Dynamic> terms (TERMS, points.cols());
  terms << Eigen::RowVectorXd::Ones (points.cols()), u, v, u * u, u * v, v * v,
      u * u * u, u * u * v, u * v * v, v * v * v;
  const Eigen::Matrix<double, TERMS, TERMS> products = terms * terms.transpose();
  const Eigen::Matrix<double, TERMS, 1> heights = terms * points.row (2).transpose();
  const Eigen::Matrix<double, TERMS, 1> cubic = products.ldlt().solve (heights);
  return std::sqrt ((points.row (2) - cubic.transpose() * terms).squaredNorm() /
                    (static_cast<double> (points.cols()) - TERMS));
}

/** \brief The median distance to the nearest of random samples, over their spacing. */
double
spacingOf (double median_squared_distance)
{
  return std::sqrt (PI / std::log (2.0) * median_squared_distance);
}

} // namespace

WindowMeasure::WindowMeasure (const PointTree& tree, int widest)
: tree_ (tree), search_ (tree, {widest}), widest_ (widest)
{}

bool
WindowMeasure::measure (std::int32_t place, SampleWindow& window)
{
  const LeafNeighbors& found = search_.searchPoint (place);
  const auto count = static_cast<int> (found.offsets[1] - found.offsets[0]);
  if (count < LEAST)
    return false;
  const auto at = [this] (std::int32_t at_place) {
    const PointLeaf& leaf = tree_.leaves[at_place / LEAF_SIZE];
    const int i = at_place % LEAF_SIZE;
    return Eigen::Vector3d (leaf.x[i], leaf.y[i], leaf.z[i]);
  };
  window.position = at (place);
  steps_.resize (3, count + 1);
  steps_.col (0).setZero();
  for (int j = 0; j < count; ++j)
    steps_.col (j + 1) = at (found.places[j]) - window.position;
  for (int size = 0; size < 3; ++size)
    if (!fitWindow (std::min (count + 1, WINDOW_SIZES[size]), size, window))
      return false;
  local_ *= radius_;
  correlate (window);
  measureSpacings (window);
  lookForSteps (window);
  return true;
}

bool
WindowMeasure::fitWindow (int samples, int size, SampleWindow& window)
{
  const Eigen::Vector3d mean = steps_.leftCols (samples).rowwise().mean();
  local_ = steps_.leftCols (samples).colwise() - mean;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes (local_ *
                                                             local_.transpose());
  const Eigen::Vector3d& moments = axes.eigenvalues();
  radius_ = std::sqrt (2.0 * (moments[1] + moments[2]) / samples);
  constexpr double ON_A_LINE = 1e-12;
  if (!(moments[1] > ON_A_LINE * moments[2]))
    return false;
  local_ = axes.eigenvectors().rowwise().reverse().transpose() * local_ / radius_;
  terms_.resize (6, samples);
  terms_.row (0).setOnes();
  terms_.row (1) = local_.row (0);
  terms_.row (2) = local_.row (1);
  terms_.row (3) = local_.row (0).array().square();
  terms_.row (4) = local_.row (0).array() * local_.row (1).array();
  terms_.row (5) = local_.row (1).array().square();
  const Eigen::Matrix<double, 6, 6> products = terms_ * terms_.transpose();
  const Eigen::Matrix<double, 6, 1> heights = terms_ * local_.row (2).transpose();
  const Eigen::Matrix<double, 6, 1> quadric = products.ldlt().solve (heights);
  residuals_ = radius_ * (local_.row (2) - quadric.transpose() * terms_);
  window.noise[size] = std::sqrt (residuals_.squaredNorm() / (samples - 6.0));
  window.spacing = radius_ * std::sqrt (PI / samples);
  if (size == 0) {
    window.normal = axes.eigenvectors().col (0);
    window.cubic_noise = radius_ * cubicResidual (local_);
  }
  return true;
}

void
WindowMeasure::correlate (SampleWindow& window) const
{
  constexpr std::array<double, 3> LAGS{1.5, 3.0, 5.0};
  // The nearest, as pairs are many. Nearer to the rim the quadric follows the noise.
  constexpr Eigen::Index INNER = 28;
  window.variance = residuals_.squaredNorm() / static_cast<double> (residuals_.size());
  if (window.variance > 0.0)
    window.kurtosis = residuals_.array().square().square().mean() /
                      (window.variance * window.variance);
  std::array<double, 3> products{};
  std::array<double, 3> pairs{};
  for (Eigen::Index i = 0; i < std::min (INNER, residuals_.size()); ++i)
    for (Eigen::Index j = 0; j < i; ++j) {
      const double lag =
          (local_.col (i) - local_.col (j)).head<2>().norm() / window.spacing;
      const auto bin = static_cast<std::size_t> (
          std::upper_bound (LAGS.begin(), LAGS.end(), lag) - LAGS.begin());
      if (bin == LAGS.size())
        continue;
      products[bin] += residuals_[i] * residuals_[j];
      ++pairs[bin];
    }
  for (std::size_t bin = 0; bin < LAGS.size(); ++bin)
    window.covariance[bin] = products[bin] / std::max (1.0, pairs[bin]);
}

void
WindowMeasure::measureSpacings (SampleWindow& window) const
{
  constexpr int PLACES = 40;
  constexpr int SAMPLES = 16;
  constexpr std::size_t NEAREST = 4;
  const double golden_angle = PI * (3.0 - std::sqrt (5.0));
  const Eigen::Index count = local_.cols();

  // Places of a sunflower, which has no direction of its own.
  std::array<double, PLACES> gaps{};
  for (int i = 0; i < PLACES; ++i) {
    const double from_middle = 0.6 * radius_ * std::sqrt ((i + 0.5) / PLACES);
    const Eigen::Vector2d at (from_middle * std::cos (golden_angle * i),
                              from_middle * std::sin (golden_angle * i));
    gaps[i] = (local_.topRows<2>().colwise() - at).colwise().squaredNorm().minCoeff();
  }
  std::nth_element (gaps.begin(), gaps.begin() + PLACES / 2, gaps.end());
  window.empty_spacing = spacingOf (gaps[PLACES / 2]);

  std::array<double, SAMPLES> nearest{};
  Eigen::Matrix2d moments = Eigen::Matrix2d::Zero();
  for (int i = 0; i < SAMPLES; ++i) {
    std::array<std::pair<double, Eigen::Index>, NEAREST> best;
    best.fill ({std::numeric_limits<double>::max(), 0});
    for (Eigen::Index j = 0; j < count; ++j) {
      if (j == i)
        continue;
      std::pair<double, Eigen::Index> next (
          (local_.col (j) - local_.col (i)).squaredNorm(), j);
      for (auto& known : best)
        if (next.first < known.first)
          std::swap (next, known);
    }
    nearest[i] = best.front().first;
    for (const auto& [squared, j] : best) {
      const Eigen::Vector2d step = (local_.col (j) - local_.col (i)).head<2>();
      moments += step * step.transpose();
    }
  }
  std::nth_element (nearest.begin(), nearest.begin() + SAMPLES / 2, nearest.end());
  window.sample_spacing = spacingOf (nearest[SAMPLES / 2]);
  const double half = 0.5 * moments.trace();
  const double root = std::sqrt (std::max (0.0, half * half - moments.determinant()));
  constexpr double LEAST_PART = 1e-6;
  window.anisotropy = (half + root) / std::max (half - root, LEAST_PART * half);
}

void
WindowMeasure::lookForSteps (SampleWindow& window)
{
  constexpr double LEAST_RELIEF = 0.1;
  constexpr std::size_t LEAST_ON_LEVEL = 3;
  constexpr double MOST_ON_LEVELS = 0.9;
  const double same = SAME_HEIGHT * window.spacing;
  window.is_flat =
      window.noise[0] < same && window.noise[2] > LEAST_RELIEF * window.spacing;
  if (!window.is_flat)
    return;
  heights_.clear();
  for (Eigen::Index j = 0; j < steps_.cols(); ++j)
    heights_.emplace_back (window.normal.dot (steps_.col (j)), static_cast<int> (j));
  std::sort (heights_.begin(), heights_.end());
  std::size_t levels = 0;
  std::size_t on_level = 0;
  for (std::size_t i = 0; i < heights_.size();) {
    std::size_t end = i + 1;
    while (end < heights_.size() &&
           heights_[end].first - heights_[end - 1].first < same)
      ++end;
    if (end - i >= LEAST_ON_LEVEL)
      on_level += end - i;
    ++levels;
    i = end;
  }
  window.is_stepped =
      levels > 1 && static_cast<double> (on_level) >
                        MOST_ON_LEVELS * static_cast<double> (heights_.size());
  if (!window.is_stepped)
    return;

  // Above samples of another sheet there are samples of this within a spacing.
  constexpr double MOST_OVER = 0.55;
  const auto on_this = std::stable_partition (
      heights_.begin(), heights_.end(), [same] (const std::pair<double, int>& sample) {
        return std::abs (sample.first) < 2.0 * same;
      });
  double over = 0.0;
  const auto others = static_cast<double> (heights_.end() - on_this);
  for (auto other = on_this; other != heights_.end(); ++other) {
    double least = std::numeric_limits<double>::max();
    for (auto level = heights_.begin(); level != on_this; ++level) {
      const double up = level->first - other->first;
      const auto step = steps_.col (level->second) - steps_.col (other->second);
      least = std::min (least, step.squaredNorm() - up * up);
    }
    if (least < window.spacing * window.spacing)
      ++over;
  }
  window.is_single = over < MOST_OVER * others;
}

} // namespace crest
} // namespace pcl
