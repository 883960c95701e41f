// SPDX-License-Identifier: BSD-3-Clause
#include "sampling/resolving_spacing.h"

#include <Eigen/Eigenvalues>

#include "base/quantile.h"

#include <algorithm>
#include <cmath>

namespace pcl {
namespace crest {

namespace {

/** Windows of a region. */
constexpr std::size_t REGION = 32;

double
square (double x)
{
  return x * x;
}

template <typename Value>
double
medianOver (const std::vector<const SampleWindow*>& windows, const Value& value)
{
  std::vector<double> values;
  for (const SampleWindow* window : windows)
    values.push_back (value (*window));
  return quantile (values, 50);
}

/** \brief Whether the patches without noise are the depth steps of one sensor: parallel
 * all over the cloud, and many of them.
 */
bool
areDepthSteps (const std::vector<SampleWindow>& windows)
{
  constexpr double LEAST_PATCHES = 16.0;
  constexpr double PARALLEL = 0.9998;
  constexpr double MOST_PARALLEL = 0.85;
  constexpr double APART = 0.3;
  constexpr int LEAST_DEPTHS = 8;
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  double patches = 0.0;
  for (const SampleWindow& window : windows)
    if (window.is_flat) {
      sum += window.normal * window.normal.transpose();
      ++patches;
    }
  if (patches < LEAST_PATCHES)
    return false;
  const Eigen::Vector3d axis =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> (sum).eigenvectors().col (2);
  std::vector<std::pair<double, double>> depths;
  for (const SampleWindow& window : windows)
    if (window.is_flat && std::abs (window.normal.dot (axis)) > PARALLEL)
      depths.emplace_back (window.position.dot (axis), window.spacing);
  std::sort (depths.begin(), depths.end());
  int distinct = 0;
  for (std::size_t i = 0; i < depths.size(); ++i)
    if (i == 0 || depths[i].first - depths[i - 1].first > APART * depths[i].second)
      ++distinct;
  return static_cast<double> (depths.size()) > MOST_PARALLEL * patches &&
         distinct >= LEAST_DEPTHS;
}

/** \brief What a region asks for, in the unit of its positions. */
struct Wish {
  /** for clumps and lines */
  double gathered = 0.0;
  bool surely_gathered = false;
  /** for noise */
  double smoothed = 0.0;
  SamplingFlaw flaw = SamplingFlaw::NONE;
  bool surely_noisy = false;
  /** the same, with little of it at the finest scale, which may be relief */
  bool perhaps_noisy = false;
};

void
wishForClumps (const std::vector<const SampleWindow*>& region, Wish& wish)
{
  constexpr double CLUMPED = 1.4;
  constexpr double SURELY_CLUMPED = 2.0;
  constexpr double LINES = 8.0;
  const double spacing =
      medianOver (region, [] (const SampleWindow& w) { return w.spacing; });
  const double empty =
      medianOver (region, [] (const SampleWindow& w) { return w.empty_spacing; });
  const double sample =
      medianOver (region, [] (const SampleWindow& w) { return w.sample_spacing; });
  const bool in_lines =
      medianOver (region, [] (const SampleWindow& w) { return w.anisotropy; }) >
          LINES &&
      empty > spacing;
  // Weak clumps are random samples with a few too near to each other, and smaller than
  // the places between them.
  if (empty > CLUMPED * sample || in_lines)
    wish.gathered = (0.6 + 0.4 * std::clamp (empty / sample - 1.5, 0.0, 0.5)) * empty;
  wish.surely_gathered = empty > SURELY_CLUMPED * sample || in_lines;
}

/** \brief Residuals of a region where they are least: what is left there is noise
 * rather than shape. Variances over the squared spacing.
 */
struct RegionNoise {
  std::array<double, 3> variance{};
  /** what a cubic leaves of the smallest windows */
  double of_cubic = 0.0;
  std::array<double, 3> correlation{};
  double kurtosis = 3.0;
};

RegionNoise
noiseOf (std::vector<const SampleWindow*> region)
{
  const auto relief = [] (const SampleWindow* w) { return w->noise[2] / w->spacing; };
  std::stable_sort (
      region.begin(), region.end(), [&] (const SampleWindow* a, const SampleWindow* b) {
        return relief (a) < relief (b);
      });
  region.resize ((region.size() + 3) / 4);
  RegionNoise noise;
  double variance = 0.0;
  for (const SampleWindow* window : region) {
    const double part =
        1.0 / (square (window->spacing) * static_cast<double> (region.size()));
    for (std::size_t i = 0; i < 3; ++i) {
      noise.variance[i] += part * square (window->noise[i]);
      noise.correlation[i] += part * window->covariance[i];
    }
    noise.of_cubic += part * square (window->cubic_noise);
    variance += part * window->variance;
  }
  for (double& correlation : noise.correlation)
    correlation = variance > 0.0 ? correlation / variance : 0.0;
  noise.kurtosis =
      medianOver (region, [] (const SampleWindow& w) { return w.kurtosis; });
  return noise;
}

/** \brief How far apart, in spacings, places are whose noise is nearly independent. */
double
correlationLength (const std::array<double, 3>& correlation)
{
  constexpr double INDEPENDENT = 0.15;
  // The middles of the bins.
  constexpr std::array<double, 3> LAGS{1.1, 2.3, 4.0};
  for (std::size_t i = 0; i < 3; ++i) {
    if (correlation[i] > INDEPENDENT)
      continue;
    if (i == 0)
      return LAGS[0];
    const double part =
        (correlation[i - 1] - INDEPENDENT) / (correlation[i - 1] - correlation[i]);
    return LAGS[i - 1] + (LAGS[i] - LAGS[i - 1]) * part;
  }
  return LAGS[2];
}

/** \brief Whether what a region has at the finest scale is its shape.
 *
 * What a sensor shares between neighbours it makes by averaging, which leaves no two
 * places of opposite signs; beside a wave there is one. And a cubic follows relief that
 * samples resolve, but no noise of their own. Smooth noise is told from that by nothing
 * but its size.
 */
bool
isRelief (const RegionNoise& noise)
{
  constexpr double OPPOSITE = -0.1;
  constexpr double FOLLOWED = 0.3;
  // In spacings.
  constexpr double LARGEST = 0.4;
  const bool has_waves =
      std::min (noise.correlation[1], noise.correlation[2]) < OPPOSITE;
  return has_waves || (noise.of_cubic < FOLLOWED * noise.variance[0] &&
                       noise.variance[2] < square (LARGEST));
}

void
wishForNoise (const std::vector<const SampleWindow*>& region,
              NoiseSearch search,
              Wish& wish)
{
  // All standard deviations in spacings.
  constexpr double MUCH = 0.25;
  constexpr double SOME = 0.12;
  constexpr double CORRELATED = 0.15;
  constexpr double LEAST_OF_GRID = 0.15;
  // Kurtosis, of thin parts.
  constexpr double OF_TWO_SHEETS = 1.9;
  constexpr double WIDEST = 5.0;
  const RegionNoise noise = noiseOf (region);
  const auto& [finest, middle, widest] = noise.variance;
  const auto& correlation = noise.correlation;
  const double sigma = std::sqrt (widest);
  const auto count = [&region] (bool SampleWindow::*what) {
    return static_cast<double> (
        std::count_if (region.begin(), region.end(), [what] (const SampleWindow* w) {
          return w->*what;
        }));
  };

  // Two scans that do not quite meet: samples on two parallel sheets, neither of which
  // is complete without the other.
  const bool two_scans = noise.kurtosis < 1.5 && correlation[0] < 0.05 &&
                         finest > 0.7 * widest && sigma > 0.15 && sigma < 0.6;
  if (two_scans) {
    constexpr double ACROSS = 3.5;
    constexpr double LEAST = 2.5;
    wish.flaw = SamplingFlaw::TWO_SCANS;
    wish.surely_noisy = true;
    wish.smoothed = std::max (LEAST, ACROSS * sigma);
    return;
  }
  if (search == NoiseSearch::GRID_SAMPLES && sigma > LEAST_OF_GRID &&
      noise.kurtosis > OF_TWO_SHEETS) {
    constexpr double OVER_STEPS = 2.5;
    wish.flaw = SamplingFlaw::GRID_STEPS;
    wish.surely_noisy = true;
    wish.smoothed = OVER_STEPS;
    return;
  }
  const double stepped = count (&SampleWindow::is_stepped);
  const bool steps = stepped >= 4.0 && stepped > 0.4 * count (&SampleWindow::is_flat) &&
                     stepped > 0.2 * static_cast<double> (region.size());
  // Noise that is correlated over a few spacings grows with the window, and then no
  // more; relief goes on. Relief has nothing at the finest scale either.
  const bool like_noise = !isRelief (noise) && middle > 1.2 * finest &&
                          widest - finest < 4.0 * (middle - finest) &&
                          correlation[0] > CORRELATED &&
                          noise.kurtosis > OF_TWO_SHEETS && noise.kurtosis < 4.2;
  wish.surely_noisy =
      sigma > MUCH && (steps || (like_noise && finest > 0.16 * widest &&
                                 correlation[2] < 0.6 * correlation[0]));
  wish.perhaps_noisy =
      wish.surely_noisy || (sigma > MUCH && like_noise && finest > 0.04 * widest &&
                            correlation[2] < 0.35 * correlation[0]);
  const bool may_be = correlation[0] > CORRELATED && finest > 0.05 * widest;
  if (sigma > SOME && (steps || may_be || wish.perhaps_noisy)) {
    constexpr double APART = 2.7;
    wish.flaw = steps ? SamplingFlaw::DEPTH_STEPS : SamplingFlaw::CORRELATED_NOISE;
    wish.smoothed =
        std::min (WIDEST, std::max (APART * sigma, correlationLength (correlation)));
  }
}

} // namespace

ResolvingSpacing
findResolvingSpacing (std::vector<SampleWindow> windows, NoiseSearch search)
{
  ResolvingSpacing result;
  result.spacings.assign (windows.size(), 0.0);
  result.flaws.assign (windows.size(), SamplingFlaw::NONE);
  if (windows.size() < REGION)
    return result;
  // Thin plates and terraces look like steps but for that.
  if (!areDepthSteps (windows))
    for (SampleWindow& window : windows)
      window.is_stepped = window.is_stepped && window.is_single;

  std::vector<Wish> wishes (windows.size());
  std::vector<std::pair<double, std::size_t>> near (windows.size());
  for (std::size_t i = 0; i < windows.size(); ++i) {
    for (std::size_t j = 0; j < windows.size(); ++j)
      near[j] = {(windows[j].position - windows[i].position).squaredNorm(), j};
    std::nth_element (near.begin(), near.begin() + REGION - 1, near.end());
    std::sort (near.begin(), near.begin() + REGION);
    std::vector<const SampleWindow*> region;
    for (std::size_t j = 0; j < REGION; ++j)
      region.push_back (&windows[near[j].second]);
    wishForClumps (region, wishes[i]);
    if (search != NoiseSearch::NONE) {
      wishForNoise (region, search, wishes[i]);
      wishes[i].smoothed *=
          medianOver (region, [] (const SampleWindow& w) { return w.spacing; });
    }
  }

  const auto part = [&wishes] (const auto& which) {
    return static_cast<double> (std::count_if (wishes.begin(), wishes.end(), which)) /
           static_cast<double> (wishes.size());
  };
  constexpr double CLUMPED = 0.03;
  constexpr double NOISY = 0.25;
  constexpr double NODES_NOISY = 0.5;
  constexpr double PERHAPS_NOISY = 0.6;
  const bool clumped =
      part ([] (const Wish& w) { return w.surely_gathered; }) > CLUMPED;
  const bool noisy = part ([] (const Wish& w) { return w.surely_noisy; }) >
                         (search == NoiseSearch::NODES ? NODES_NOISY : NOISY) ||
                     (search != NoiseSearch::NODES && part ([] (const Wish& w) {
                                                        return w.perhaps_noisy;
                                                      }) > PERHAPS_NOISY);
  for (std::size_t i = 0; i < wishes.size(); ++i) {
    const Wish& wish = wishes[i];
    if (clumped && wish.gathered > 0.0) {
      result.spacings[i] = wish.gathered;
      result.flaws[i] = SamplingFlaw::CLUMPS;
    }
    if (noisy && wish.smoothed > result.spacings[i]) {
      result.spacings[i] = wish.smoothed;
      result.flaws[i] = wish.flaw;
    }
  }
  return result;
}

} // namespace crest
} // namespace pcl
