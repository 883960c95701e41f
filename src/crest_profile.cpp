// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_crest/crest_profile.h>
#include <pcl_crest/scale_fit.h>

#include <Eigen/Dense>

#include "node_walk.h"
#include "parallel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace pcl {
namespace crest {

namespace {

/** \brief A scale: nodes of a level of the pyramid that a fit takes. Radii are about
 * 2.7, 6.5, 8.2, 10.4, 15, 19 and 24 spacings.
 */
struct Scale {
  int level;
  int nodes;
};
constexpr std::array<Scale, 7> SCALES{
    {{0, 28}, {1, 28}, {1, 44}, {1, 70}, {2, 28}, {2, 44}, {2, 70}}};
constexpr int COARSEST_LEVEL = SCALES.back().level;

/** The profile's window, in spacings of the nodes. */
constexpr double WINDOW = 2.5;

/** \brief Standard errors of the profile's slope and curvature against the standard
 * error of k1. Neighbouring fits share most of their nodes, so that the ratio cannot be
 * had from the profile's own fit; these make both z have unit variance on noisy
 * cylinders: powers of the number of nodes through what was measured there on levels 1
 * and 2, for c1 1.5, 1.7, 1.7 and for c2 3.4, 3.1, 2.5 with 28, 44 and 70 nodes.
 */
double
slopeError (int nodes)
{
  return 1.55 * std::pow (nodes / 28.0, 0.1);
}
double
peakError (int nodes)
{
  return 3.45 * std::pow (28.0 / nodes, 0.35);
}

/** A profile is significantly not constant from this z on, with two degrees of freedom:
 * by chance in 3e-4 of the samples, each scale. */
constexpr double RESOLVING_Z = 4.0;
/** k1 itself has to be certain, or its direction is not. */
constexpr double CURVATURE_Z = 6.0;
/** Least change of k1 over the window, relative to it: below, the cubic's own error is
 * larger than any noise. */
constexpr double LEAST_CHANGE = 0.01;
/** Standard error of the foot, in spacings, above which a coarser scale places it
 * better; of interest only for samples that the foot is near to. */
constexpr double LARGEST_FOOT_ERROR = 0.5;
constexpr double NEAR_FOOT = 3.0;
/** Flat is what turns by less than this over a spacing. */
constexpr double FLAT_TURN = 1e-4;
/** Certainly less sharp than this is of constant curvature for a person's eye. */
constexpr double LEAST_SHARPNESS = 0.3;

/** \brief Fits profiles at one scale. */
class ProfileFitter {
public:
  ProfileFitter (const OrientedPoints& points,
                 const SurfaceGraph& graph,
                 const PyramidLevel& level,
                 const std::vector<ScaleFit>& fits,
                 int scale)
  : points_ (points)
  , graph_ (graph)
  , level_ (level)
  , fits_ (fits)
  , scale_ (scale)
  , slope_error_ (slopeError (SCALES[scale].nodes))
  , peak_error_ (peakError (SCALES[scale].nodes))
  , walk_ (level.graph)
  {}

  /** \brief Fits the profile of a sample; returns whether a coarser scale has to. */
  bool
  fit (index_t sample, CrestProfile& profile)
  {
    const index_t node = level_.node_of[sample];
    const ScaleFit& own = fits_[node];
    if (!own.valid)
      return true;
    const double node_spacing = own.radius / std::sqrt (SCALES[scale_].nodes / M_PI);
    const double window = WINDOW * node_spacing;
    const Eigen::Vector3d x = onSurface (sample, node);
    Coefficients c;
    double error = 0.0;
    if (!fitWindow (node, x, window, c, error)) {
      if (!profile.curvature.valid)
        describe (sample, own, x, profile);
      return true;
    }

    const double spacing = graph_.spacing[sample];
    const double k1 = std::abs (own.k1);
    // Without any noise only rounding is left.
    error = std::max (error, 1e-9 / window);
    const double slope_z = c[1] / (slope_error_ * error);
    const double peak_z = -c[2] / (peak_error_ * error);
    const double foot = c[2] < 0.0 ? -c[1] / (2.0 * c[2]) * window
                                   : std::numeric_limits<double>::infinity();
    const double to_second_derivative = 2.0 / (window * window);
    const double sharpness = -c[2] * to_second_derivative / (k1 * k1 * k1);
    const double sharpness_error =
        2.0 * peak_error_ * error * to_second_derivative / (k1 * k1 * k1);

    bool resolved = std::hypot (slope_z, peak_z) > RESOLVING_Z &&
                    k1 > CURVATURE_Z * error &&
                    std::hypot (c[1], c[2]) > LEAST_CHANGE * k1;
    if (resolved && std::abs (foot) < NEAR_FOOT * spacing) {
      const double foot_error = window * slope_error_ * error / (2.0 * -c[2]);
      resolved = foot_error <= LARGEST_FOOT_ERROR * spacing;
    }
    const bool flat = (k1 + 2.0 * error) * spacing < FLAT_TURN;
    const bool constant = k1 > CURVATURE_Z * error &&
                          std::abs (sharpness) + sharpness_error < LEAST_SHARPNESS &&
                          std::abs (c[1]) < 0.5 * LEAST_SHARPNESS * k1 * k1 * window;

    if (resolved || profile.scale == CrestProfile::NO_SCALE) {
      if (profile.scale == CrestProfile::NO_SCALE)
        profile.noise = static_cast<float> (own.noise);
      describe (sample, own, x, profile);
      profile.foot = static_cast<float> (foot);
      profile.peak_z = static_cast<float> (peak_z);
      profile.sharpness = static_cast<float> (sharpness);
      profile.fall = static_cast<float> (-c[2] / k1);
      profile.scale = scale_;
      profile.resolved = resolved;
      profile.coarsest_level = SCALES[scale_].level == COARSEST_LEVEL;
    }
    return !resolved && !flat && !constant;
  }

private:
  static constexpr int TERMS = 6;
  using Coefficients = Eigen::Matrix<double, TERMS, 1>;
  using NormalMatrix = Eigen::Matrix<double, TERMS, TERMS>;

  /** \brief Enters what the fit alone tells, the surface being at x. */
  void
  describe (index_t sample,
            const ScaleFit& own,
            const Eigen::Vector3d& x,
            CrestProfile& profile) const
  {
    const Eigen::Vector3d p = points_.positions[sample].cast<double>();
    profile.curvature = {static_cast<float> (own.k1),
                         static_cast<float> (own.k2),
                         own.t1.cast<float>(),
                         true};
    profile.normal = own.normal.cast<float>();
    profile.height = static_cast<float> ((x - p).dot (own.normal));
    profile.radius = static_cast<float> (own.radius);
  }

  /** \brief Where the node's paraboloid passes the sample. */
  Eigen::Vector3d
  onSurface (index_t sample, index_t node) const
  {
    const ScaleFit& own = fits_[node];
    const Eigen::Vector3d t2 = own.normal.cross (own.t1);
    const Eigen::Vector3d origin = level_.positions[node].cast<double>();
    const Eigen::Vector3d e = points_.positions[sample].cast<double>() - origin;
    const double u = e.dot (own.t1);
    const double v = e.dot (t2);
    return origin + u * own.t1 + v * t2 +
           (own.offset - 0.5 * (own.k1 * u * u + own.k2 * v * v)) * own.normal;
  }

  /** \brief Fits c0 + c1 u + c2 u^2 + c3 v + c4 u v + c5 v^2 to the largest curvature
   * of the sign of k1 in a window around x, u along t1, in units of the window. In two
   * dimensions, as t1 turns quickly near umbilics, where a fit along t1 alone finds
   * ridges that are none. Returns whether there is something on both sides.
   */
  bool
  fitWindow (index_t node,
             const Eigen::Vector3d& x,
             double window,
             Coefficients& c,
             double& k1_error)
  {
    constexpr int RINGS = 3;
    constexpr int LEAST_NODES = 8;
    constexpr int LEAST_BESIDE = 2;
    constexpr double BESIDE = 0.1;

    const ScaleFit& own = fits_[node];
    const double sign = own.k1 > 0.0 ? 1.0 : -1.0;
    const Eigen::Vector3d t2 = own.normal.cross (own.t1);
    NormalMatrix matrix = NormalMatrix::Zero();
    Coefficients right_side = Coefficients::Zero();
    double weight = 0.0;
    double variance = 0.0;
    int count = 0;
    int ahead = 0;
    int behind = 0;

    const auto any = [] (index_t) { return true; };
    walk_.start (node);
    const std::vector<index_t>& reached = walk_.reached();
    std::size_t i = 0;
    for (int ring = 0; ring < RINGS; ++ring)
      for (const std::size_t end = reached.size(); i < end; ++i) {
        const index_t q = reached[i];
        const ScaleFit& fit = fits_[q];
        if (!fit.valid || fit.normal.dot (own.normal) < SAME_SHEET_COSINE)
          continue;
        const Eigen::Vector3d d =
            (level_.positions[q].cast<double>() + fit.offset * fit.normal - x) / window;
        const double g = 1.0 - d.squaredNorm();
        if (g > 0.0) {
          const double u = d.dot (own.t1);
          const double v = d.dot (t2);
          const double w = g * g;
          const double row[TERMS] = {1.0, u, u * u, v, u * v, v * v};
          const double k = std::max (sign * fit.k1, sign * fit.k2);
          for (int a = 0; a < TERMS; ++a) {
            right_side[a] += w * row[a] * k;
            for (int b = 0; b <= a; ++b)
              matrix (a, b) += w * row[a] * row[b];
          }
          weight += w;
          variance += w * fit.k1_error * fit.k1_error;
          ++count;
          ahead += u > BESIDE ? 1 : 0;
          behind += u < -BESIDE ? 1 : 0;
        }
        // The window may lie beside its own node, but else ends where it ends.
        if ((g > 0.0 && ring + 1 < RINGS) || ring == 0)
          walk_.expand (q, any);
      }
    if (ahead < LEAST_BESIDE || behind < LEAST_BESIDE || count < LEAST_NODES)
      return false;
    matrix.diagonal().array() += 1e-5 * weight;
    const Eigen::LLT<NormalMatrix, Eigen::Lower> solver (matrix);
    c = solver.solve (right_side);
    k1_error = std::sqrt (variance / weight);
    return c.allFinite();
  }

  const OrientedPoints& points_;
  const SurfaceGraph& graph_;
  const PyramidLevel& level_;
  const std::vector<ScaleFit>& fits_;
  int scale_;
  double slope_error_;
  double peak_error_;
  NodeWalk walk_;
};

/** \brief The nodes of active samples with the two rings around them, which profiles
 * look at.
 */
std::vector<std::uint8_t>
neededNodes (const PyramidLevel& level, const std::vector<std::uint8_t>& active)
{
  std::vector<std::uint8_t> needed (level.size(), 0);
  for (std::size_t i = 0; i < active.size(); ++i)
    if (active[i] != 0)
      needed[level.node_of[i]] = 1;
  for (int ring = 0; ring < 2; ++ring) {
    const std::vector<std::uint8_t> inner = needed;
    for (std::size_t i = 0; i < inner.size(); ++i)
      if (inner[i] != 0)
        for (const index_t q : level.graph.star (static_cast<index_t> (i)))
          needed[q] = 1;
  }
  return needed;
}

} // namespace

std::vector<CrestProfile>
profileCrests (const OrientedPoints& points,
               const SurfaceGraph& graph,
               unsigned threads)
{
  std::vector<CrestProfile> profiles (points.size());
  std::vector<std::uint8_t> active (points.size(), 1);
  PyramidLevel level = finestLevel (points, graph);
  int at_level = 0;
  for (int scale = 0; scale < static_cast<int> (SCALES.size()); ++scale) {
    for (; at_level < SCALES[scale].level; ++at_level)
      level = coarserLevel (level, threads);
    const std::vector<ScaleFit> fits =
        fitAtScale (level, SCALES[scale].nodes, neededNodes (level, active), threads);
    forEachBlock (
        points.size(), threads, [&] (std::size_t, std::size_t first, std::size_t last) {
          ProfileFitter fitter (points, graph, level, fits, scale);
          for (std::size_t i = first; i < last; ++i)
            if (active[i] != 0)
              active[i] = fitter.fit (static_cast<index_t> (i), profiles[i]) ? 1 : 0;
        });
  }
  return profiles;
}

double
turningAngle (double sharpness)
{
  constexpr double DEGREES = 180.0 / M_PI;
  return sharpness > 0.0
             ? std::min (180.0, 4.0 / 3.0 * std::sqrt (2.0 / sharpness) * DEGREES)
             : 180.0;
}

} // namespace crest
} // namespace pcl
