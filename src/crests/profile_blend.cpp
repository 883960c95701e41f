// SPDX-License-Identifier: BSD-3-Clause
#include "crests/profile_blend.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace pcl {
namespace crest {

BlendedProfile
blendProfiles (const Eigen::Vector3d& sample,
               index_t node,
               const PyramidLevel& level,
               const std::vector<ScaleFit>& fits,
               const std::vector<ProfilePolynomial>& polynomials)
{
  // In half widths of the window: one and a quarter spacings of the nodes.
  constexpr double REACH = 0.5;
  constexpr double SAME_DIRECTION = 0.8;
  // The own node counts wherever its sample is.
  constexpr double LEAST_WEIGHT = 1e-3;

  const ScaleFit& own = fits[node];
  const double window = polynomials[node].window;
  const double per_squared_reach = 1.0 / (REACH * window * REACH * window);
  BlendedProfile sum{Eigen::Vector3d::Zero(), 0.0, {0.0, 0.0, 0.0}};
  double weights = 0.0;
  const auto add = [&] (index_t q, double least_weight) {
    const Eigen::Vector3d e = sample - level.positions[q].cast<double>();
    const double g = std::max (0.0, 1.0 - e.squaredNorm() * per_squared_reach);
    const double w = std::max (g * g, least_weight);
    // Most are too far.
    if (w == 0.0)
      return;
    const ScaleFit& fit = fits[q];
    const ProfilePolynomial& polynomial = polynomials[q];
    if (!polynomial.valid)
      return;
    const double turn = fit.t1.dot (own.t1);
    const Eigen::Vector3d normal = fit.normal.cast<double>();
    const Eigen::Vector3d t1 = fit.t1.cast<double>();
    if (static_cast<double> (fit.k1) * own.k1 <= 0.0 ||
        std::abs (turn) < SAME_DIRECTION)
      return;
    const double sign = turn > 0.0 ? 1.0 : -1.0;
    const double u = e.dot (t1);
    const double v = e.dot (normal.cross (t1));
    const double per_window = 1.0 / polynomial.window;
    const ProfileParabola at = polynomial.at (per_window * u, per_window * v);
    const double unit = per_window * window;
    sum.profile.slope += w * sign * unit * at.slope;
    sum.profile.bend += w * unit * unit * at.bend;
    sum.profile.drift += w * sign * unit * at.drift;
    sum.t1 += w * sign * t1;
    sum.height +=
        w * (fit.offset - 0.5 * (fit.k1 * u * u + fit.k2 * v * v) - e.dot (normal));
    weights += w;
  };
  add (node, LEAST_WEIGHT);
  for (const index_t q : level.graph.star (node))
    add (q, 0.0);
  const Eigen::Vector3d normal = own.normal.cast<double>();
  const Eigen::Vector3d along = sum.t1 - sum.t1.dot (normal) * normal;
  return {along.normalized(),
          sum.height / weights,
          {sum.profile.slope / weights,
           sum.profile.bend / weights,
           sum.profile.drift / weights}};
}

ProfileErrors
profileErrors (int nodes_of_fit, bool elongated)
{
  const ProfileErrors round{1.65 * std::pow (nodes_of_fit / 28.0, 0.1),
                            2.35 * std::pow (28.0 / nodes_of_fit, 0.15)};
  return elongated ? ProfileErrors{0.68 * round.slope, 0.6 * round.bend} : round;
}

} // namespace crest
} // namespace pcl
