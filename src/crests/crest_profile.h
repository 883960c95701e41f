// SPDX-License-Identifier: BSD-3-Clause
// How curvature runs across each sample, at the scale where that can be told: sections
// 4.2 and 4.3 for the auto preset.
#pragma once

#include "curvature/quadric.h"

#include <limits>
#include <memory>

namespace pcl {
namespace crest {

/** The nodes of a fit at the finest scale. */
constexpr int FINEST_SCALE_NODES = 28;

/** \brief The curvature of a sample at the finest scale, beside that of its profile. */
struct FinestCurvature {
  PrincipalCurvature curvature{0.0F, 0.0F, Eigen::Vector3f::Zero(), false};
  /** standard error of k1 */
  float k1_error = 0.0F;
};

/** \brief The curvature profile of a sample: how k1 runs along t1, at the smallest
 * scale at which it is significantly not constant. Thresholds that users set come after
 * it.
 */
struct CrestProfile {
  PrincipalCurvature curvature{0.0F, 0.0F, Eigen::Vector3f::Zero(), false};
  /** not valid for what is at a sharp edge */
  FinestCurvature finest;
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();
  /** height of the surface over the sample, along the normal, in the cloud's unit */
  float height = 0.0F;
  /** where along t1 |k1| has its maximum, from the sample, in the cloud's unit;
   * infinite where it has none */
  float foot = std::numeric_limits<float>::infinity();
  /** how many standard errors the profile is from a constant one, with two degrees of
   * freedom; 0 where that is not even likely, or it has no maximum */
  float certainty = 0.0F;
  /** how many standard errors -k1'' is above zero, for the sign of k1 */
  float peak_z = 0.0F;
  /** q = -k1'' / |k1|^3, free of scale: 0 on a circle, about 3 on a gentle ridge */
  float sharpness = 0.0F;
  /** the same of the profile's fall in units of k1 and of the window: -c2 / |k1| */
  float fall = 0.0F;
  /** standard deviation of the samples from the surface, at the finest scale */
  float noise = 0.0F;
  /** of the neighbourhood that the curvature was fitted to, in the cloud's unit */
  float radius = 0.0F;
  /** whether the profile is significantly not constant */
  bool resolved = false;
  /** whether the scale is one of the coarsest level, where nothing is beside a crest */
  bool coarsest_level = false;
  /** whether it is that of a sharp edge (sharp_profiles.h) */
  bool sharp = false;
};

/** \brief Fits the profile of every sample, going from scale to scale, each larger than
 * the one before, until it is resolved, or the surface is flat, or of constant
 * curvature. Where it never is, the profile is that of the scale at which it is most
 * certain.
 *
 * At coarser levels each scale has a second try: a window that is four times as long
 * along the crest as across. What is seen in it is more certain, but has to be nearly
 * straight. At the second level it also moves feet that the first window left uncertain
 * by more than a fifth of a spacing, if the two windows agree within two standard
 * errors.
 *
 * The smallest significant scale keeps sharp features sharp, and noise silent: where
 * curvature is constant, as on planes, spheres, cylinders and tori, none is
 * significant.
 *
 * \param[in] tree over the points
 */
std::vector<CrestProfile>
profileCrests (const OrientedPoints& points,
               SurfaceGraph graph,
               std::shared_ptr<const PointTree> tree,
               const Workers& workers);

/** \brief The curvature of the surface at a sample, for those who ask for it rather
 * than for crests: wide windows smooth away what is narrower than they are.
 *
 * It is that of the profile, unless samples have little noise and the finest scale
 * either tells k1 to an eighth of it or contradicts the profile by three standard
 * errors (the bias of a wide window against the error of a narrow one: Lepskii 1990).
 *
 * \param[in] spacing of the samples
 */
PrincipalCurvature
surfaceCurvature (const CrestProfile& profile, float spacing);

/** \brief How far the surface turns across a crest of sharpness q, in degrees, at most
 * 180: the angle between the normals where the profile's curvature has dropped off,
 * 4/3 sqrt (2 / q), from the parabola k1 (1 - q (k1 s)^2 / 2) over its positive part.
 */
double
turningAngle (double sharpness);

} // namespace crest
} // namespace pcl
