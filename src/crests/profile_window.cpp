// SPDX-License-Identifier: BSD-3-Clause
#include "crests/profile_window.h"

#include "base/large_arrays.h"
#include "base/parallel.h"
#include "crests/profile_kernels.h"
#include "curvature/near_nodes.h"
#include "surface/node_walk.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace pcl {
namespace crest {

namespace {

/** Half the window's width, in spacings of the nodes. */
constexpr double WINDOW = 2.5;

/** Fewer nodes than this tell nothing about a profile. */
constexpr int LEAST_NODES = 8;
/** A walk ends with the ring that makes it so many: some twenty are in a round window,
 * four times as many in a long one, but any number where a node has few beside it and a
 * denser part of the cloud is near. */
constexpr int MOST_NODES = 512;
/** How far apart two nodes on one place of the surface hardly are, in standard
 * deviations of one. */
constexpr float HEIGHTS = 3.0F;
/** Nearer than this nodes are not beside a place, in units of the window. */
constexpr double BESIDE = 0.3;

/** \brief A node's fit as others see it; without one there is no normal. */
struct SeenFit {
  Eigen::Vector3f position = Eigen::Vector3f::Zero();
  /** from there to the surface */
  Eigen::Vector3f offset = Eigen::Vector3f::Zero();
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();
  float k1 = 0.0F, k2 = 0.0F, k1_error = 0.0F;
};

struct LoadFit {
  const PyramidLevel& level;
  const std::vector<ScaleFit>& fits;

  SeenFit
  operator() (index_t q) const
  {
    const ScaleFit& fit = fits[q];
    return {level.positions[q],
            fit.offset * fit.normal,
            fit.normal,
            fit.k1,
            fit.k2,
            fit.k1_error};
  }
};

/** \brief Fits the polynomials of some nodes at a time. */
class PolynomialFitter : public LaneBatch<PolynomialFitter, FLOAT_LANES> {
public:
  PolynomialFitter (const PyramidLevel& level,
                    const std::vector<ScaleFit>& fits,
                    int nodes_of_fit,
                    float elongation)
  : level_ (level)
  , fits_ (fits)
  , most_others_ (mostOthers (nodes_of_fit))
  , to_window_ (static_cast<float> (WINDOW / std::sqrt (nodes_of_fit / M_PI)))
  , elongation_ (elongation)
  , load_{level, fits}
  , walk_ (level.graph, load_)
  {}

  /** \brief Fits a node together with others, at the latest when finish is called, to
   * what is near, unless there may be something in the way to that.
   */
  void
  fit (index_t node, const NearNodes& near, ProfilePolynomial& result)
  {
    if (!start (node))
      return;
    if (!takeNear (near))
      takeWalked (node);
    end (result);
  }

  /** \brief The same to what a walk over the surface reaches within the window. */
  void
  fit (index_t node, ProfilePolynomial& result)
  {
    if (!start (node))
      return;
    takeWalked (node);
    end (result);
  }

private:
  friend LaneBatch<PolynomialFitter, FLOAT_LANES>;

  void
  run ()
  {
    int most = 0;
    for (int lane = 0; lane < queued_; ++lane)
      most = std::max (most, counts_[lane]);
    for (int lane = 0; lane < queued_; ++lane)
      for (int i = counts_[lane]; i < most; ++i)
        rows_[i].clear (lane);
    room_.resize (rows_.size());
    ProfileRow profiles;
    kernels_.fit (
        rows_.data(), most, normals_, t1_, elongation_, room_.data(), profiles);
    for (int lane = 0; lane < queued_; ++lane) {
      ProfilePolynomial& result = *results_[lane];
      for (int i = 0; i < ProfileRow::TERMS; ++i)
        result.coefficients[i] = profiles.coefficients[i][lane];
      result.window = windows_[lane];
      result.first_u = profiles.first_u[lane];
      result.last_u = profiles.last_u[lane];
      result.k1_error = std::sqrt (profiles.squared_error[lane]) / result.window;
      result.valid = profiles.count[lane] >= LEAST_NODES && result.covers (0.0F) &&
                     result.coefficients.allFinite();
    }
  }

  /** \brief Begins with a node; returns false if it has no fit. */
  bool
  start (index_t node)
  {
    const ScaleFit& fit = fits_[node];
    if (!fit.valid)
      return false;
    own_ = load_ (node);
    sign_ = own_.k1 > 0.0F ? 1.0F : -1.0F;
    window_ = to_window_ * fit.radius;
    per_window_ = 1.0F / window_;
    noise_ = fit.noise;
    const auto set = [this] (const Eigen::Vector3f& vector, FloatVectorRow& row) {
      row.x[queued_] = vector.x();
      row.y[queued_] = vector.y();
      row.z[queued_] = vector.z();
    };
    set (fit.normal, normals_);
    set (fit.t1, t1_);
    own_t1_ = fit.t1;
    count_ = 0;
    return true;
  }

  void
  end (ProfilePolynomial& result)
  {
    if (count_ < LEAST_NODES)
      return;
    counts_[queued_] = count_;
    windows_[queued_] = window_;
    results_[queued_] = &result;
    push();
  }

  /** \brief From the surface of the node to that of another, in units of the window.
   */
  Eigen::Vector3f
  edgeTo (const SeenFit& q) const
  {
    return ((q.position - own_.position) + (q.offset - own_.offset)) * per_window_;
  }

  /** \brief Enters a fit, which counts if that is accepted. Whether it is is as good as
   * random: there is no branch for it.
   */
  void
  enter (const SeenFit& q, const Eigen::Vector3f& edge, bool is_accepted)
  {
    if (count_ == static_cast<int> (rows_.size()))
      rows_.resize (2 * rows_.size() + 1);
    NearFitRow& row = rows_[count_];
    const float error = window_ * q.k1_error;
    row.edge.x[queued_] = edge.x();
    row.edge.y[queued_] = edge.y();
    row.edge.z[queued_] = edge.z();
    row.value[queued_] =
        window_ * (std::max (sign_ * q.k1, sign_ * q.k2) - sign_ * own_.k1);
    row.squared_error[queued_] = error * error;
    count_ += is_accepted ? 1 : 0;
  }

  bool
  takeNear (const NearNodes& near)
  {
    // Nodes whose surfaces are in the window may be above and below each other.
    const float reach = std::hypot (window_, HEIGHTS * noise_);
    const auto limit = static_cast<float> (reach / level_.tree->unit);
    enter (own_, Eigen::Vector3f::Zero(), true);
    int others = 0;
    for (std::size_t i = 0; i < near.count; ++i) {
      const index_t node = near.indexOf (i);
      const SeenFit q = load_ (node);
      const bool same_sheet = q.normal.dot (own_.normal) >= SAME_SHEET_COSINE;
      enter (q, edgeTo (q), same_sheet);
      if (!same_sheet && near.squared_distances[i] < limit * limit) {
        ++others;
        if (level_.graph.star (node).size() == 0)
          return false;
      }
    }
    return others <= most_others_ && near.count > 0 &&
           near.squared_distances[near.count - 1] >= limit * limit;
  }

  void
  takeWalked (index_t node)
  {
    const float squared_shortening = 1.0F / (elongation_ * elongation_);
    count_ = 0;
    const auto accept = [&] (const SeenFit& q) {
      const Eigen::Vector3f edge = edgeTo (q);
      const float u = edge.dot (own_t1_);
      const float g = 1.0F - u * u - (edge.squaredNorm() - u * u) * squared_shortening;
      const bool is_inside =
          (static_cast<int> (q.normal.dot (own_.normal) >= SAME_SHEET_COSINE) &
           static_cast<int> (g > 0.0F)) != 0;
      enter (q, edge, is_inside);
      return is_inside;
    };
    walk_.start (node);
    accept (walk_[0]);
    while (count_ < MOST_NODES && walk_.advance (accept)) {
    }
  }

  const PyramidLevel& level_;
  const std::vector<ScaleFit>& fits_;
  const ProfileKernels& kernels_ = profileKernels();
  int most_others_;
  /** from the radius of a fit to half the width of a window */
  float to_window_;
  float elongation_;
  LoadFit load_;
  NodeWalk<LoadFit> walk_;
  /** the node that is next, and how many fits are entered for it */
  SeenFit own_;
  Eigen::Vector3f own_t1_ = Eigen::Vector3f::Zero();
  float sign_ = 1.0F;
  float window_ = 0.0F;
  float per_window_ = 0.0F;
  float noise_ = 0.0F;
  int count_ = 0;
  std::vector<NearFitRow> rows_;
  std::vector<FrameRow> room_;
  FloatVectorRow normals_;
  FloatVectorRow t1_;
  std::array<int, FLOAT_LANES> counts_{};
  std::array<float, FLOAT_LANES> windows_{};
  std::array<ProfilePolynomial*, FLOAT_LANES> results_{};
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
  const double per_window = 1.0 / window;
  const Eigen::Matrix<double, TERMS, 1> c = per_window * coefficients.cast<double>();
  return {c[1] + 2.0 * c[3] * u + c[4] * v + c[6] * v * v,
          c[3],
          c[2] + c[4] * u + 2.0 * c[5] * v + 2.0 * c[6] * u * v};
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
  const bool is_round = elongation == 1.0;
  const int others = nodes_of_fit - 1 + mostOthers (nodes_of_fit);
  forEachBlock (
      level.size(), workers, [&] (std::size_t, std::size_t first, std::size_t last) {
        PolynomialFitter fitter (
            level, fits, nodes_of_fit, static_cast<float> (elongation));
        if (is_round)
          visitNearNodes (*level.tree,
                          needed,
                          others,
                          first,
                          last,
                          [&] (std::int32_t, index_t node, const NearNodes& near) {
                            fitter.fit (node, near, polynomials[node]);
                          });
        else
          for (auto node = static_cast<index_t> (first);
               node < static_cast<index_t> (last);
               ++node)
            if (needed[node] != 0)
              fitter.fit (node, polynomials[node]);
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
