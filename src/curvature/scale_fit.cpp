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
#include <tuple>

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

/** \brief A node as walks see it. */
struct SeenNode {
  Eigen::Vector3f position = Eigen::Vector3f::Zero();
  float weight = 0.0F;
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();
};

struct LoadNode {
  const PyramidLevel& level;

  SeenNode
  operator() (index_t q) const
  {
    return {level.positions[q], level.weights[q], level.normals[q]};
  }
};

/** \brief Fits some nodes at a time. */
class CubicFitter : public LaneBatch<CubicFitter> {
public:
  CubicFitter (const PyramidLevel& level, int nearest)
  : level_ (level)
  , nearest_ (nearest)
  , walk_ (level.graph, {level})
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

  /** \brief A node that is fitted. */
  struct Neighbor {
    Eigen::Vector3f position = Eigen::Vector3f::Zero();
    float weight = 0.0F;
  };

  /** \brief What is being fitted in a lane. */
  struct Fit {
    index_t node = 0;
    ScaleFit* result = nullptr;
    std::vector<Neighbor> neighbors;
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

  /** \brief What a walk has reached: squared distance, index, and which of it. */
  struct Candidate {
    double squared;
    index_t node;
    std::uint32_t at;

    bool
    operator<(const Candidate& o) const
    {
      return std::tie (squared, node) < std::tie (o.squared, o.node);
    }
  };

  /** \brief Finds the nearest nodes of those that a walk over the surface reaches
   * first: a quarter more than are wanted, as rings are no circles. Returns false if
   * there are too few.
   */
  bool
  gather (index_t node, Fit& fit)
  {
    const Eigen::Vector3f& n = level_.normals[node];
    // Just beyond right angles, whose other face is part of the crest.
    constexpr float NO_OTHER_SHEET = -0.02F;
    const auto same_sheet = [&n] (const SeenNode& q) {
      return q.normal.dot (n) > NO_OTHER_SHEET;
    };
    const auto wanted = static_cast<std::size_t> (nearest_);
    const std::size_t enough = wanted + wanted / 4;
    walk_.start (node);
    while (walk_.size() < enough && walk_.advance (same_sheet)) {
    }
    fit.node = node;
    const double farthest = takeNearest (level_.positions[node], fit.neighbors);
    if (fit.neighbors.size() < LEAST_NODES)
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
  takeNearest (const Eigen::Vector3f& p, std::vector<Neighbor>& neighbors)
  {
    candidates_.resize (walk_.size());
    double farthest = 0.0;
    for (std::size_t i = 0; i < candidates_.size(); ++i) {
      const double squared = (walk_[i].position - p).cast<double>().squaredNorm();
      candidates_[i] = {squared, walk_.node (i), static_cast<std::uint32_t> (i)};
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
    const double scale = farthest > 0.0 ? 1.0 / farthest : 0.0;
    for (std::size_t i = 0; i < count; ++i)
      parts_[i] = static_cast<float> (scale * candidates_[i].squared);
    const auto take = [&] (const auto& is_near) {
      // Which of them are is as good as random: there is no branch for it.
      neighbors.resize (count);
      farthest = 0.0;
      std::size_t taken = 0;
      for (std::size_t i = 0; i < count; ++i) {
        const SeenNode& node = walk_[candidates_[i].at];
        const bool near = is_near (i);
        neighbors[taken] = {node.position, node.weight};
        taken += near ? 1 : 0;
        farthest = std::max (farthest, near ? candidates_[i].squared : 0.0);
      }
      neighbors.resize (taken);
    };
    const float limit = limitOfNearest (count);
    if (limit >= 0.0F)
      take ([&] (std::size_t i) { return parts_[i] <= limit; });
    else {
      rank (count);
      take ([&] (std::size_t i) { return ranks_[i] < nearest_; });
    }
    return std::sqrt (farthest);
  }

  /** \brief A limit that as many parts as wanted, or all if they are fewer, are up to;
   * negative if none is found, as where some are equal.
   */
  float
  limitOfNearest (std::size_t count) const
  {
    constexpr int MOST_STEPS = 12;
    if (count <= static_cast<std::size_t> (nearest_))
      return 1.0F;
    // Their number grows about as the squared distance does.
    float low = 0.0F;
    float high = 1.0F;
    int low_count = 0;
    int high_count = static_cast<int> (count);
    for (int step = 0; step < MOST_STEPS; ++step) {
      const float part = step % 2 == 0
                             ? (static_cast<float> (nearest_ - low_count) + 0.5F) /
                                   (static_cast<float> (high_count - low_count) + 1.0F)
                             : 0.5F;
      const float middle = low + part * (high - low);
      int inside = 0;
      for (std::size_t i = 0; i < count; ++i)
        inside += parts_[i] <= middle ? 1 : 0;
      if (inside == nearest_)
        return middle;
      (inside < nearest_ ? low : high) = middle;
      (inside < nearest_ ? low_count : high_count) = inside;
    }
    return -1.0F;
  }

  /** \brief Ranks the parts. */
  void
  rank (std::size_t count)
  {
    nodes_.resize (count + KERNEL_SLACK);
    ranks_.resize (count + KERNEL_SLACK);
    for (std::size_t i = 0; i < count; ++i)
      nodes_[i] = candidates_[i].node;
    const auto ranked = static_cast<int> (count);
    if (!search_kernels_.rankDistinct (parts_.data(), ranked, ranks_.data()))
      search_kernels_.rankTied (parts_.data(), nodes_.data(), ranked, ranks_.data());
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
    for (std::size_t i = 0; i < fit.neighbors.size(); ++i) {
      const Neighbor& q = fit.neighbors[i];
      const Eigen::Vector3d e = (q.position.cast<double>() - p) / fit.radius;
      const double g = 1.0 - e.squaredNorm();
      const double kernel = g * g;
      const double weight = kernel * q.weight;
      LaneSample& sample = samples_[i];
      sample.u[lane] = e.dot (fit.frame.x);
      sample.v[lane] = e.dot (fit.frame.y);
      sample.value[lane] = e.dot (fit.frame.n);
      sample.weight[lane] = weight;
      fit.kernel += kernel;
      fit.kernel_weight += weight * kernel;
    }
    for (std::size_t i = fit.neighbors.size(); i < samples_.size(); ++i)
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
  NodeWalk<LoadNode> walk_;
  /** what a walk has reached */
  std::vector<Candidate> candidates_;
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
