// SPDX-License-Identifier: BSD-3-Clause
#include "crests/crest_profile.h"

#include "base/large_arrays.h"
#include "base/parallel.h"
#include "crests/profile_blend.h"
#include "curvature/scale_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

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
    {{0, FINEST_SCALE_NODES}, {1, 28}, {1, 44}, {1, 70}, {2, 28}, {2, 44}, {2, 70}}};
constexpr int COARSEST_LEVEL = SCALES.back().level;

/** Along the crest the elongated window is longer than it is wide by this. */
constexpr double ELONGATION = 4.0;

/** A profile is significantly not constant from this z on, with two degrees of freedom:
 * by chance in 3e-4 of the samples, each scale. */
constexpr double RESOLVING_Z = 4.0;
/** k1 itself has to be certain, or its direction is not. */
constexpr double CURVATURE_Z = 5.0;
/** And so far at least where a profile is only likely. */
constexpr double LIKELY_CURVATURE_Z = 3.0;
/** Less certain than this no coarser scale takes the place of the finest. */
constexpr double LIKELY_Z = 2.5;
/** Least change of k1 over the window, relative to it: below, the cubic's own error is
 * larger than any noise, unless even the least sharp crest would change by less. */
constexpr double LEAST_CHANGE = 0.02;
/** Standard error of the foot, in spacings, above which a coarser scale places it
 * better; of interest only for samples that the foot is near to. */
constexpr double LARGEST_FOOT_ERROR = 0.75;
constexpr double NEAR_FOOT = 3.0;
/** Above this a longer window of the same scale is asked for its place. */
constexpr double CERTAIN_FOOT = 0.2;
/** Flat is what turns by less than this over a spacing. */
constexpr double FLAT_TURN = 1e-4;
/** Certainly less sharp than this is of constant curvature for a person's eye. */
constexpr double LEAST_SHARPNESS = 0.3;

/** \brief What one scale has to say, and to which window. */
struct ScaleProfiles {
  int scale;
  ProfileErrors errors;
  const PyramidLevel& level;
  const std::vector<ScaleFit>& fits;
  const std::vector<ProfilePolynomial>& polynomials;
};

/** \brief Enters what the fit of the sample's node alone tells. */
void
describe (const ScaleFit& fit, double height, CrestProfile& profile)
{
  const PrincipalCurvature curvature{
      static_cast<float> (fit.k1), static_cast<float> (fit.k2), fit.t1, true};
  if (!profile.curvature.valid) {
    profile.noise = static_cast<float> (fit.noise);
    profile.finest = {curvature, static_cast<float> (fit.k1_error)};
  }
  profile.curvature = curvature;
  profile.normal = fit.normal;
  profile.height = static_cast<float> (height);
  profile.radius = static_cast<float> (fit.radius);
}

/** \brief What has to follow the profile of a sample. */
enum class Next : std::uint8_t {
  NOTHING,
  /** the longer window of the same scale may place the foot better */
  PLACE,
  /** a longer window or a coarser scale may resolve the profile */
  RESOLVE
};

/** \brief The standard error of k1 in a window: without any noise only rounding to
 * floats is left.
 */
double
curvatureError (const ProfilePolynomial& polynomial)
{
  return std::max (polynomial.k1_error, 1e-7F / polynomial.window);
}

double
standardErrorOfFoot (const ScaleProfiles& from,
                     const ProfilePolynomial& polynomial,
                     const ProfileParabola& profile)
{
  return polynomial.window * from.errors.slope * curvatureError (polynomial) /
         (2.0 * -profile.bend);
}

/** \brief Whether the window of a sample's node has nodes on both sides of the sample.
 */
bool
windowCovers (const OrientedPoints& points, const ScaleProfiles& from, index_t sample)
{
  const index_t node = from.level.node_of[sample];
  const ProfilePolynomial& polynomial = from.polynomials[node];
  const double u = (points.positions[sample].cast<double>() -
                    from.level.positions[node].cast<double>())
                       .dot (from.fits[node].t1.cast<double>());
  return polynomial.valid && polynomial.covers (u / polynomial.window);
}

/** \brief Moves the foot of a sample to where a longer window has it, if the two agree.
 * \param[in] foot_error standard error of the foot
 */
void
placeFoot (const OrientedPoints& points,
           const ScaleProfiles& from,
           index_t sample,
           double foot_error,
           CrestProfile& profile)
{
  constexpr double AGREE_Z = 2.0;
  if (!windowCovers (points, from, sample))
    return;
  const index_t node = from.level.node_of[sample];
  const ProfilePolynomial& polynomial = from.polynomials[node];
  const Eigen::Vector3d p = points.positions[sample].cast<double>();
  const ProfileParabola c =
      blendProfiles (p, node, from.level, from.fits, from.polynomials).profile;
  const double foot = -c.slope / (2.0 * c.bend) * polynomial.window;
  if (c.bend < 0.0 && standardErrorOfFoot (from, polynomial, c) < foot_error &&
      std::abs (foot - profile.foot) < AGREE_Z * foot_error)
    profile.foot = static_cast<float> (foot);
}

/** \brief Takes in the profile of a sample where that is more certain than the one
 * that it has.
 * \param[out] foot_error standard error of the foot of a sample that is near to it
 */
Next
readProfile (const OrientedPoints& points,
             double spacing,
             const ScaleProfiles& from,
             index_t sample,
             CrestProfile& profile,
             float& foot_error)
{
  const index_t node = from.level.node_of[sample];
  const ProfilePolynomial& polynomial = from.polynomials[node];
  const ScaleFit& own = from.fits[node];
  const Eigen::Vector3d p = points.positions[sample].cast<double>();
  if (!windowCovers (points, from, sample)) {
    // Where data end there is no profile, but the surface has its curvature.
    if (own.valid && !profile.curvature.valid)
      describe (own, 0.0, profile);
    return Next::RESOLVE;
  }
  const double k1 = std::abs (own.k1);
  const double error = curvatureError (polynomial);
  const bool flat = (k1 + 2.0 * error) * spacing < FLAT_TURN;
  if (k1 == 0.0) {
    // What is exactly flat has no profile.
    if (!profile.curvature.valid)
      describe (own, 0.0, profile);
    return flat ? Next::NOTHING : Next::RESOLVE;
  }
  const BlendedProfile blend =
      blendProfiles (p, node, from.level, from.fits, from.polynomials);
  const ProfileParabola& c = blend.profile;
  const double window = polynomial.window;
  // The maximum along u is what is measured, and how certainly; how sharp it is takes
  // the line of curvature.
  const double bend = c.bendOnCurvatureLine (
      std::max<double> (std::abs (own.k1 - own.k2), error), from.errors.slope * error);
  const double slope_z = c.slope / (from.errors.slope * error);
  const double peak_z = -c.bend / (from.errors.bend * error);
  const double z = std::hypot (slope_z, peak_z);
  const double foot = bend < 0.0 ? -c.slope / (2.0 * c.bend) * window
                                 : std::numeric_limits<double>::infinity();
  const double to_second_derivative = 2.0 / (window * window);
  const double sharpness = -bend * to_second_derivative / (k1 * k1 * k1);
  const double sharpness_error =
      2.0 * from.errors.bend * error * to_second_derivative / (k1 * k1 * k1);

  const double least_crest_change = 0.5 * LEAST_SHARPNESS * k1 * k1 * window * window;
  const bool changes =
      std::hypot (c.slope, c.bend) > std::min (LEAST_CHANGE, least_crest_change) * k1;
  bool resolved = z > RESOLVING_Z && k1 > CURVATURE_Z * error && changes;
  foot_error = 0.0F;
  if (resolved && std::abs (foot) < NEAR_FOOT * spacing) {
    foot_error = static_cast<float> (standardErrorOfFoot (from, polynomial, c));
    resolved = foot_error <= LARGEST_FOOT_ERROR * spacing;
  }
  const bool constant = k1 > CURVATURE_Z * error &&
                        std::abs (sharpness) + sharpness_error < LEAST_SHARPNESS &&
                        std::abs (c.slope) < 0.5 * LEAST_SHARPNESS * k1 * k1 * window;
  const double certainty =
      bend < 0.0 && k1 > LIKELY_CURVATURE_Z * error && changes && z > LIKELY_Z ? z
                                                                               : 0.0;
  if (!profile.curvature.valid || resolved || certainty > profile.certainty) {
    describe (own, blend.height, profile);
    profile.curvature.t1 = blend.t1.cast<float>();
    profile.foot = static_cast<float> (foot);
    profile.certainty = static_cast<float> (certainty);
    profile.peak_z = static_cast<float> (peak_z);
    profile.sharpness = static_cast<float> (sharpness);
    profile.fall = static_cast<float> (-bend / k1);
    profile.resolved = resolved;
    profile.coarsest_level = SCALES[from.scale].level == COARSEST_LEVEL;
  }
  if (resolved)
    return foot_error > CERTAIN_FOOT * spacing ? Next::PLACE : Next::NOTHING;
  return flat || constant ? Next::NOTHING : Next::RESOLVE;
}

/** \brief The nodes of samples that something follows for, with some rings of nodes
 * around them. */
std::vector<std::uint8_t>
neededNodes (const PyramidLevel& level, const std::vector<Next>& next, int rings)
{
  if (std::find (next.begin(), next.end(), Next::NOTHING) == next.end())
    return std::vector<std::uint8_t> (level.size(), 1);
  std::vector<std::uint8_t> needed (level.size(), 0);
  for (std::size_t i = 0; i < next.size(); ++i)
    if (next[i] != Next::NOTHING)
      needed[level.node_of[i]] = 1;
  for (int ring = 0; ring < rings; ++ring) {
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
               SurfaceGraph graph,
               std::shared_ptr<const PointTree> tree,
               const Workers& workers)
{
  std::vector<CrestProfile> profiles = makeLarge (points.size(), CrestProfile());
  std::vector<Next> next (points.size(), Next::RESOLVE);
  std::vector<float> foot_errors = makeLarge (points.size(), 0.0F);
  const std::vector<float> spacing = std::move (graph.spacing);
  PyramidLevel level = finestLevel (points, std::move (graph), std::move (tree));
  int at_level = 0;
  for (int scale = 0; scale < static_cast<int> (SCALES.size()); ++scale) {
    if (workers.progress != nullptr)
      workers.progress->beginPart (scale, static_cast<int> (SCALES.size()));
    for (; at_level < SCALES[scale].level; ++at_level)
      level = coarserLevel (level, workers);
    const int nodes = SCALES[scale].nodes;
    const bool samples = at_level == 0;
    // Half a window, and one more ring for blending.
    const int rings = ringsOfWindow (samples ? 1.0 : ELONGATION) + 1;
    const std::vector<ScaleFit> fits =
        fitAtScale (level, nodes, neededNodes (level, next, rings), workers);

    const auto readAll = [&] (bool elongated) {
      // The longest windows see crests bend.
      const bool places = !samples && !elongated && at_level < COARSEST_LEVEL;
      const std::vector<ProfilePolynomial> polynomials =
          fitPolynomials (level,
                          fits,
                          neededNodes (level, next, 1),
                          nodes,
                          elongated ? ELONGATION : 1.0,
                          workers);
      const ScaleProfiles from{
          scale, profileErrors (nodes, elongated), level, fits, polynomials};
      const auto read = [&] (std::size_t i) {
        const auto sample = static_cast<index_t> (i);
        if (next[i] == Next::PLACE) {
          placeFoot (points, from, sample, foot_errors[i], profiles[i]);
          return Next::NOTHING;
        }
        const Next wanted =
            readProfile (points, spacing[i], from, sample, profiles[i], foot_errors[i]);
        return wanted == Next::PLACE && !places ? Next::NOTHING : wanted;
      };
      forEachBlock (points.size(),
                    workers,
                    [&] (std::size_t, std::size_t first, std::size_t last) {
                      for (std::size_t i = first; i < last; ++i)
                        if (next[i] != Next::NOTHING)
                          next[i] = read (i);
                    });
    };
    readAll (false);
    if (!samples)
      readAll (true);
  }
  return profiles;
}

PrincipalCurvature
surfaceCurvature (const CrestProfile& profile, float spacing)
{
  // In spacings.
  constexpr float LITTLE_NOISE = 0.15F;
  constexpr float CERTAIN_Z = 8.0F;
  constexpr float CONTRADICTING_Z = 3.0F;
  const FinestCurvature& finest = profile.finest;
  const float k1 = std::abs (finest.curvature.k1);
  const float bias = std::abs (finest.curvature.k1 - profile.curvature.k1);
  // Where the profile is of the finest scale, its direction is the blended one.
  const bool is_better =
      finest.curvature.valid && bias > 0.0F && profile.noise < LITTLE_NOISE * spacing &&
      (k1 > CERTAIN_Z * finest.k1_error || bias > CONTRADICTING_Z * finest.k1_error);
  return is_better ? finest.curvature : profile.curvature;
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
