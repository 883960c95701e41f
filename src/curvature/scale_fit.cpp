// SPDX-License-Identifier: BSD-3-Clause
#include "curvature/scale_fit.h"

#include "base/large_arrays.h"
#include "base/parallel.h"
#include "curvature/local_cubic.h"
#include "search/kernels.h"
#include "surface/node_walk.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace pcl {
namespace crest {

namespace {

constexpr int TERMS = CubicSums::TERMS;

/** Fewer nodes than this leave too little to tell noise from shape by. */
constexpr std::size_t LEAST_NODES = TERMS + 4;

/** The frame is tilted again where its slope is above a twentieth (3 degrees). */
constexpr double LARGEST_SQUARED_SLOPE = 0.05 * 0.05;
constexpr int MOST_FITS = 3;

/** \brief The weights of the fit are no inverse variances, as they fall off to the rim.
 * With kappa the mean of the kernel g under the weights, kappa A^-1 is near to the true
 * covariance A^-1 (sum g w x x^T) A^-1, but not near enough for a test; these are the
 * ratios of the true values to it for a cubic under (1 - r^2)^2 on a disc: of the
 * degrees of freedom that the fit takes, and of the variance of a second derivative. By
 * numerical integration; on 28 to 70 scattered nodes they differ by less than .02.
 */
constexpr double TAKEN_FREEDOM = 0.60;
constexpr double CURVATURE_VARIANCE = 0.615;

/** \brief Fits some nodes at a time. */
class CubicFitter : public LaneBatch<CubicFitter> {
public:
  CubicFitter (const PyramidLevel& level, int nearest)
  : level_ (level)
  , nearest_ (nearest)
  , walk_ (level.graph)
  , samples_ (static_cast<std::size_t> (nearest))
  {}

  /** \brief Fits a node together with others, at the latest when finish is called. */
  void
  fit (index_t node, ScaleFit& result)
  {
    Fit& next = fits_[queued_];
    if (!gather (node, next))
      return;
    next.result = &result;
    next.frame = Frame (level_.normals[node].cast<double>().normalized());
    next.state = State::OPEN;
    push();
  }

private:
  friend LaneBatch<CubicFitter>;

  void
  run ()
  {
    int fits = 1;
    while (fitInFrames (fits == MOST_FITS))
      ++fits;
  }

  enum class State { OPEN, FITTED, DONE };

  /** \brief What is being fitted in a lane. */
  struct Fit {
    index_t node = 0;
    ScaleFit* result = nullptr;
    std::vector<index_t> nodes;
    double radius = 0.0;
    Frame frame;
    /** sums over the neighbours of the kernel g, and of kernel squared times samples */
    double kernel = 0.0;
    double kernel_weight = 0.0;
    LocalCubic cubic;
    Principal principal;
    State state = State::DONE;

    Eigen::Vector3d
    normalOf (const LocalCubic& surface) const
    {
      return (frame.n - surface.p * frame.x - surface.q * frame.y).normalized();
    }
  };

  /** \brief Finds the nearest nodes of those that a walk over the surface reaches
   * first: a quarter more than are wanted, as rings are no circles. Returns false if
   * there are too few.
   */
  bool
  gather (index_t node, Fit& fit)
  {
    const Eigen::Vector3f& p = level_.positions[node];
    const Eigen::Vector3f& n = level_.normals[node];
    // Just beyond right angles, whose other face is part of the crest.
    constexpr float NO_OTHER_SHEET = -0.02F;
    const auto same_sheet = [&] (index_t q) {
      return level_.normals[q].dot (n) > NO_OTHER_SHEET;
    };
    const auto wanted = static_cast<std::size_t> (nearest_);
    const std::size_t enough = wanted + wanted / 4;
    walk_.start (node);
    for (std::size_t i = 0, ring = 1; i < walk_.size() && walk_.size() < enough;
         ring = walk_.size())
      for (; i < ring; ++i)
        walk_.expand (walk_[i], same_sheet);
    fit.node = node;
    const double farthest = takeNearest (p, fit.nodes);
    if (fit.nodes.size() < LEAST_NODES)
      return false;
    // A little more, so that the farthest node, too, has a weight.
    fit.radius = 1.02 * farthest;
    return fit.radius > 0.0;
  }

  /** \brief Takes the nearest nodes of the walk, of equally near ones those of lower
   * index.
   * \return the distance of the farthest of them
   */
  double
  takeNearest (const Eigen::Vector3f& p, std::vector<index_t>& nodes)
  {
    candidates_.resize (walk_.size());
    double farthest = 0.0;
    for (std::size_t i = 0; i < candidates_.size(); ++i) {
      const index_t q = walk_[i];
      const double squared = (level_.positions[q] - p).cast<double>().squaredNorm();
      candidates_[i] = {squared, q};
      farthest = std::max (farthest, squared);
    }
    // Ranking takes the square of what there is, which is few but around hubs.
    const auto wanted = static_cast<std::size_t> (nearest_);
    if (candidates_.size() > 4 * wanted) {
      std::nth_element (
          candidates_.begin(), candidates_.begin() + nearest_, candidates_.end());
      candidates_.resize (wanted);
    }
    const std::size_t count = candidates_.size();
    parts_.resize (count + KERNEL_SLACK);
    nodes_.resize (count + KERNEL_SLACK);
    ranks_.resize (count + KERNEL_SLACK);
    const double scale = farthest > 0.0 ? 1.0 / farthest : 0.0;
    for (std::size_t i = 0; i < count; ++i) {
      parts_[i] = static_cast<float> (scale * candidates_[i].first);
      nodes_[i] = candidates_[i].second;
    }
    const auto ranked = static_cast<int> (count);
    if (!search_kernels_.rankDistinct (parts_.data(), ranked, ranks_.data()))
      search_kernels_.rankTied (parts_.data(), nodes_.data(), ranked, ranks_.data());
    farthest = 0.0;
    nodes.clear();
    for (std::size_t i = 0; i < count; ++i)
      if (ranks_[i] < nearest_) {
        nodes.push_back (candidates_[i].second);
        farthest = std::max (farthest, candidates_[i].first);
      }
    return std::sqrt (farthest);
  }

  /** \brief One fit of each that is open; returns whether some have to be repeated with
   * the new normal.
   */
  bool
  fitInFrames (bool last)
  {
    const auto each = [this] (State state, const auto& work) {
      for (int lane = 0; lane < queued_; ++lane)
        if (fits_[lane].state == state)
          work (fits_[lane], lane);
    };
    each (State::OPEN, [this] (Fit& fit, int lane) { setSamples (fit, lane); });
    CubicSums sums;
    kernels_.addHeights (samples_.data(), static_cast<int> (samples_.size()), sums);
    CubicFit cubics;
    kernels_.fitCubics (sums, cubics);

    bool any_open = false;
    Lanes x = {};
    Lanes y = {};
    each (State::OPEN, [&] (Fit& fit, int lane) {
      const LocalCubic cubic (sums, cubics, lane);
      if (!cubic.valid)
        fit.state = State::DONE;
      else if (!last && cubic.p * cubic.p + cubic.q * cubic.q > LARGEST_SQUARED_SLOPE) {
        fit.frame = Frame (fit.normalOf (cubic));
        any_open = true;
      }
      else {
        fit.cubic = cubic;
        fit.principal = Principal (cubic);
        x[lane] = fit.principal.x;
        y[lane] = fit.principal.y;
        fit.state = State::FITTED;
      }
    });
    Lanes variances;
    kernels_.bendVariance (cubics, x, y, variances);
    each (State::FITTED, [&] (Fit& fit, int lane) {
      describe (fit, variances[lane]);
      fit.state = State::DONE;
    });
    return any_open;
  }

  /** \brief Sets the samples of a lane: lengths in units of the radius, weights are the
   * kernel's times the number of samples.
   */
  void
  setSamples (Fit& fit, int lane)
  {
    const Eigen::Vector3d p = level_.positions[fit.node].cast<double>();
    fit.kernel = 0.0;
    fit.kernel_weight = 0.0;
    for (std::size_t i = 0; i < fit.nodes.size(); ++i) {
      const index_t q = fit.nodes[i];
      const Eigen::Vector3d e = (level_.positions[q].cast<double>() - p) / fit.radius;
      const double g = 1.0 - e.squaredNorm();
      const double kernel = g * g;
      const double weight = kernel * level_.weights[q];
      LaneSample& sample = samples_[i];
      sample.u[lane] = e.dot (fit.frame.x);
      sample.v[lane] = e.dot (fit.frame.y);
      sample.value[lane] = e.dot (fit.frame.n);
      sample.weight[lane] = weight;
      fit.kernel += kernel;
      fit.kernel_weight += weight * kernel;
    }
    for (std::size_t i = fit.nodes.size(); i < samples_.size(); ++i)
      samples_[i].clear (lane);
  }

  /** \param[in] bend_variance that of the second derivative along the direction of k1
   */
  static void
  describe (const Fit& fit, double bend_variance)
  {
    const LocalCubic& c = fit.cubic;
    const Principal& principal = fit.principal;
    const Frame& frame = fit.frame;
    const double kappa = fit.kernel_weight / c.weight;
    const double freedom =
        std::max (fit.kernel - TAKEN_FREEDOM * kappa * TERMS, 0.1 * fit.kernel);
    const double variance = c.residual / freedom;
    const double k1_variance = variance * CURVATURE_VARIANCE * kappa * bend_variance;

    const Eigen::Vector3d t1 = principal.x * frame.x + principal.y * frame.y +
                               (c.p * principal.x + c.q * principal.y) * frame.n;
    const Eigen::Vector3d normal = fit.normalOf (c);
    ScaleFit& result = *fit.result;
    result.k1 = principal.k1 / fit.radius;
    result.k2 = principal.k2 / fit.radius;
    result.t1 = t1.normalized().cast<float>();
    result.normal = normal.cast<float>();
    result.offset = c.offset * fit.radius * frame.n.dot (normal);
    result.radius = fit.radius;
    result.noise = std::sqrt (variance) * fit.radius;
    result.k1_error = std::sqrt (std::max (0.0, k1_variance)) / fit.radius;
    result.valid = true;
  }

  const PyramidLevel& level_;
  const Kernels& search_kernels_ = kernelsFor (bestSimd());
  const FitKernels& kernels_ = fitKernels();
  int nearest_;
  NodeWalk walk_;
  /** what a walk has reached, with squared distances */
  std::vector<std::pair<double, index_t>> candidates_;
  /** of these as parts of the largest */
  std::vector<float> parts_;
  std::vector<std::int32_t> nodes_;
  std::vector<std::int32_t> ranks_;
  std::array<Fit, LANES> fits_;
  std::vector<LaneSample> samples_;
};

/** \brief Replaces each node's estimate of the noise by the mean over its star: one
 * alone, with some ten degrees of freedom, is too uncertain for a test.
 */
void
poolNoise (const PyramidLevel& level,
           std::vector<ScaleFit>& fits,
           const Workers& workers)
{
  std::vector<double> variance (fits.size());
  for (std::size_t i = 0; i < fits.size(); ++i)
    variance[i] = fits[i].noise * fits[i].noise;
  forEachBlock (
      fits.size(), workers, [&] (std::size_t, std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
          ScaleFit& fit = fits[i];
          if (!fit.valid || !(fit.noise > 0.0))
            continue;
          double sum = variance[i];
          int count = 1;
          for (const index_t q : level.graph.star (static_cast<index_t> (i)))
            if (fits[q].valid) {
              sum += variance[q];
              ++count;
            }
          const double pooled = std::sqrt (sum / count);
          fit.k1_error *= pooled / fit.noise;
          fit.noise = pooled;
        }
      });
}

} // namespace

std::vector<ScaleFit>
fitAtScale (const PyramidLevel& level,
            int nearest,
            const std::vector<std::uint8_t>& needed,
            const Workers& workers)
{
  std::vector<ScaleFit> fits = makeLarge (level.size(), ScaleFit());
  forEachBlock (
      level.size(), workers, [&] (std::size_t, std::size_t first, std::size_t last) {
        CubicFitter fitter (level, nearest);
        for (std::size_t i = first; i < last; ++i)
          if (needed[i] != 0)
            fitter.fit (static_cast<index_t> (i), fits[i]);
        fitter.finish();
      });
  poolNoise (level, fits, workers);
  return fits;
}

} // namespace crest
} // namespace pcl
