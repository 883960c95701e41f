// SPDX-License-Identifier: BSD-3-Clause
// How the largest curvature runs around a node of a pyramid level.
#pragma once

#include "curvature/scale_fit.h"

namespace pcl {
namespace crest {

/** \brief The profile of |k1| along t1 at some place: c0 + slope u + bend u^2, u in
 * units of the window.
 */
struct ProfileParabola {
  double slope;
  double bend;
  /** the slope along t2 */
  double drift;

  /** \brief The bend along the line of curvature, which u follows at the place only:
   * it turns off by drift / (k1 - k2), the geodesic curvature that Codazzi's equation
   * gives it. Around an axis all points of a surface of revolution have a maximum along
   * u, and none along the line of curvature (P1 of Cazals and Pouget 2005).
   *
   * \param[in] drift_error standard error of the drift: its square is not drift
   */
  double
  bendOnCurvatureLine (double curvature_difference, double drift_error) const;
};

/** \brief The largest curvature of the sign of k1 around a node as a polynomial of u
 * along t1 and v along t2, both in units of the window.
 */
struct ProfilePolynomial {
  static constexpr int TERMS = 7;

  /** of 1, u, v, u^2, u v, v^2 and u v^2, the last 0 in a round window; times the
   * window, which leaves no unit. The first is what is more than k1. */
  Eigen::Matrix<float, TERMS, 1> coefficients = Eigen::Matrix<float, TERMS, 1>::Zero();
  /** half its width along t1, in the cloud's unit */
  float window = 0.0F;
  /** standard error of k1 in it */
  float k1_error = 0.0F;
  /** the second lowest and the second highest u of its nodes */
  float first_u = 0.0F;
  float last_u = 0.0F;
  bool valid = false;

  ProfileParabola
  at (double u, double v) const;

  /** \brief Whether there are at least two nodes on both sides of a place: else data
   * end there, and what the polynomial says of it is made up.
   */
  bool
  covers (double u) const;
};

/** \brief Fits the profile polynomial of each node that is needed, in a window of two
 * and a half spacings of the nodes to both sides. Not valid where the node's own fit is
 * not, or where there is not something on both sides.
 *
 * In two dimensions, as t1 turns quickly near umbilics, where a fit along t1 alone
 * finds ridges that are none.
 *
 * \param[in] nodes_of_fit how many nodes each of the fits has taken
 * \param[in] elongation how many times longer the window is along the crest than
 * across: 1, or what brings more nodes together where a crest is nearly straight
 */
std::vector<ProfilePolynomial>
fitPolynomials (const PyramidLevel& level,
                const std::vector<ScaleFit>& fits,
                const std::vector<std::uint8_t>& needed,
                int nodes_of_fit,
                double elongation,
                const Workers& workers);

/** \brief How many rings of nodes a window reaches. */
int
ringsOfWindow (double elongation);

} // namespace crest
} // namespace pcl
