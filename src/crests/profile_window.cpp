// SPDX-License-Identifier: BSD-3-Clause
#include "crests/profile_window.h"

#include <Eigen/Geometry>

#include "base/large_arrays.h"
#include "base/parallel.h"
#include "surface/node_walk.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace pcl {
namespace crest {

namespace {

/** \brief Least cosine between the normals of the fits that a profile is taken of. */
constexpr float SAME_SHEET_COSINE = 0.2F;

/** Half the window's width, in spacings of the nodes. */
constexpr double WINDOW = 2.5;

/** Fewer nodes than this tell nothing about a profile. */
constexpr std::size_t LEAST_NODES = 8;
/** A walk ends with the ring that makes it so many: some twenty are in a round window,
 * four times as many in a long one, but any number where a node has few beside it and a
 * denser part of the cloud is near. */
constexpr std::size_t MOST_NODES = 512;
/** Nearer than this nodes are not beside a place, in units of the window. */
constexpr double BESIDE = 0.3;

/** \brief A node's fit as walks see it. */
struct SeenFit {
  /** the place on the fitted surface */
  Eigen::Vector3d surface = Eigen::Vector3d::Zero();
  double k1 = 0.0, k2 = 0.0, k1_error = 0.0;
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();
  bool valid = false;
};

struct LoadFit {
  const PyramidLevel& level;
  const std::vector<ScaleFit>& fits;

  SeenFit
  operator() (index_t q) const
  {
    const ScaleFit& fit = fits[q];
    return {level.positions[q].cast<double>() + fit.offset * fit.normal.cast<double>(),
            fit.k1,
            fit.k2,
            fit.k1_error,
            fit.normal,
            fit.valid};
  }
};

/** \brief Fits the polynomials of some nodes at a time. */
class PolynomialFitter : public LaneBatch<PolynomialFitter> {
public:
  PolynomialFitter (const PyramidLevel& level,
                    const std::vector<ScaleFit>& fits,
                    double elongation)
  : fits_ (fits), elongation_ (elongation), walk_ (level.graph, {level, fits})
  {}

  /** \brief Fits a node together with others, at the latest when finish is called. */
  void
  fit (index_t node, double window, ProfilePolynomial& result)
  {
    if (!gather (node, window, queued_, result))
      return;
    results_[queued_] = &result;
    push();
  }

private:
  friend LaneBatch<PolynomialFitter>;

  void
  run ()
  {
    const int most = *std::max_element (counts_.begin(), counts_.begin() + queued_);
    for (int lane = 0; lane < queued_; ++lane)
      for (int i = counts_[lane]; i < most; ++i)
        samples_[i].clear (lane);
    ProfileFit fit;
    kernels_.fitProfiles (samples_.data(), most, elongation_ != 1.0, fit);
    for (int lane = 0; lane < queued_; ++lane) {
      ProfilePolynomial& result = *results_[lane];
      for (int i = 0; i < ProfileFit::TERMS; ++i)
        result.coefficients[i] =
            static_cast<float> (result.window * fit.coefficients[i][lane]);
      result.valid = result.coefficients.allFinite();
    }
  }

  /** \brief Sets the samples of a lane to what is in a node's window, and all of the
   * result but its coefficients. Returns false if there is too little.
   */
  bool
  gather (index_t node, double window, int lane, ProfilePolynomial& result)
  {
    const ScaleFit& own = fits_[node];
    const double sign = own.k1 > 0.0 ? 1.0 : -1.0;
    const Eigen::Vector3d normal = own.normal.cast<double>();
    const Eigen::Vector3d t1 = own.t1.cast<double>() / window;
    const Eigen::Vector3d t2 = normal.cross (t1);
    const double squared_unit = 1.0 / (window * window);
    const double squared_shortening = 1.0 / (elongation_ * elongation_);

    double weight = 0.0;
    double variance = 0.0;
    std::size_t count = 0;
    double lowest_u = 1.0;
    double highest_u = -1.0;
    double first_u = 1.0;
    double last_u = -1.0;
    walk_.start (node);
    const Eigen::Vector3d origin = walk_[0].surface;
    // Whether a node is in the window is as good as random: there is no branch for it.
    const auto enter = [&] (const SeenFit& fit) {
      const Eigen::Vector3d d = fit.surface - origin;
      const double u = d.dot (t1);
      const double g =
          1.0 - u * u - (d.squaredNorm() * squared_unit - u * u) * squared_shortening;
      const bool is_inside =
          (static_cast<int> (fit.valid) &
           static_cast<int> (fit.normal.dot (own.normal) >= SAME_SHEET_COSINE) &
           static_cast<int> (g > 0.0)) != 0;
      if (count == samples_.size())
        samples_.resize (2 * count + 1);
      LaneSample& sample = samples_[count];
      sample.u[lane] = u;
      sample.v[lane] = d.dot (t2);
      sample.value[lane] = std::max (sign * fit.k1, sign * fit.k2);
      sample.weight[lane] = g * g;
      count += is_inside ? 1 : 0;
      const double w = is_inside ? g * g : 0.0;
      weight += w;
      variance += w * fit.k1_error * fit.k1_error;
      const double low = is_inside ? u : 1.0;
      first_u = std::min (first_u, std::max (low, lowest_u));
      lowest_u = std::min (lowest_u, low);
      const double high = is_inside ? u : -1.0;
      last_u = std::max (last_u, std::min (high, highest_u));
      highest_u = std::max (highest_u, high);
      return is_inside;
    };
    enter (walk_[0]);
    while (count < MOST_NODES && walk_.advance (enter)) {
    }
    result.window = window;
    result.first_u = static_cast<float> (first_u);
    result.last_u = static_cast<float> (last_u);
    if (!result.covers (0.0) || count < LEAST_NODES)
      return false;
    counts_[lane] = static_cast<int> (count);
    result.k1_error = std::sqrt (variance / weight);
    return true;
  }

  const std::vector<ScaleFit>& fits_;
  const FitKernels& kernels_ = fitKernels();
  double elongation_;
  NodeWalk<LoadFit> walk_;
  std::vector<LaneSample> samples_;
  std::array<int, LANES> counts_{};
  std::array<ProfilePolynomial*, LANES> results_{};
};

} // namespace

double
ProfileParabola::bendOnCurvatureLine (double curvature_difference,
                                      double drift_error) const
{
  // A half more than it is: what is left of a maximum that the turn nearly undoes is
  // within the error of both.
  constexpr double CAUTION = 1.5;
  const double squared_drift =
      std::max (0.0, drift * drift - drift_error * drift_error);
  return bend + CAUTION * squared_drift / (2.0 * curvature_difference);
}

ProfileParabola
ProfilePolynomial::at (double u, double v) const
{
  const Eigen::Matrix<double, TERMS, 1> c = coefficients.cast<double>() / window;
  return {c[1] + 2.0 * c[2] * u + c[4] * v + c[6] * v * v,
          c[2],
          c[3] + c[4] * u + 2.0 * c[5] * v + 2.0 * c[6] * u * v};
}

bool
ProfilePolynomial::covers (double u) const
{
  return first_u < u - BESIDE && last_u > u + BESIDE;
}

std::vector<ProfilePolynomial>
fitPolynomials (const PyramidLevel& level,
                const std::vector<ScaleFit>& fits,
                const std::vector<std::uint8_t>& needed,
                int nodes_of_fit,
                double elongation,
                const Workers& workers)
{
  std::vector<ProfilePolynomial> polynomials =
      makeLarge (level.size(), ProfilePolynomial());
  forEachBlock (
      level.size(), workers, [&] (std::size_t, std::size_t first, std::size_t last) {
        PolynomialFitter fitter (level, fits, elongation);
        for (std::size_t i = first; i < last; ++i)
          if (needed[i] != 0 && fits[i].valid) {
            const double spacing = fits[i].radius / std::sqrt (nodes_of_fit / M_PI);
            fitter.fit (static_cast<index_t> (i), WINDOW * spacing, polynomials[i]);
          }
        fitter.finish();
      });
  return polynomials;
}

int
ringsOfWindow (double elongation)
{
  return static_cast<int> (std::ceil (WINDOW * elongation));
}

} // namespace crest
} // namespace pcl
