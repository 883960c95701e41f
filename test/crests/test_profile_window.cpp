// SPDX-License-Identifier: BSD-3-Clause
// Profiles along lines of curvature against a surface whose k1 is constant along them.
#include <gtest/gtest.h>

#include "crests/profile_window.h"
#include "support/analytic_surface.h"
#include "support/scale_fits.h"

#include <cmath>

using namespace pcl::crest;

TEST (Profiles, OfASurfaceOfRevolutionHaveNoMaximumAlongLinesOfCurvature)
{
  // z = (x^2 + y^2) / 2: the larger curvature runs around the axis, where it does not
  // change, and falls off on the straight way, which leads away from the axis.
  const auto cloud = oracle::sample (oracle::plane(), 8000);
  for (pcl::PointNormal& p : *cloud) {
    p.z = 0.5F * (p.x * p.x + p.y * p.y);
    p.getNormalVector3fMap() = Eigen::Vector3f (-p.x, -p.y, 1.0F).normalized();
  }
  constexpr int NEAREST = 44;
  const oracle::ScaleFits run = oracle::fitsAt (*cloud, 1, NEAREST);
  const std::vector<std::uint8_t> all (run.level.size(), 1);
  const std::vector<ProfilePolynomial> polynomials =
      fitPolynomials (run.level, run.fits, all, NEAREST, 1.0, 0);

  std::vector<double> straight;
  std::vector<double> on_line_of_curvature;
  for (std::size_t i = 0; i < polynomials.size(); ++i) {
    const Eigen::Vector3f& p = run.level.positions[i];
    const double radius = std::hypot (p.x(), p.y());
    // Not near the umbilic, nor where data end within a fit.
    if (!polynomials[i].valid || radius < 0.3 || radius > 0.6)
      continue;
    const ProfileParabola profile = polynomials[i].at (0.0, 0.0);
    const double difference = std::abs (run.fits[i].k1 - run.fits[i].k2);
    straight.push_back (profile.bend);
    on_line_of_curvature.push_back (profile.bendOnCurvatureLine (difference, 0.0));
  }
  ASSERT_GT (straight.size(), 100U);
  const double bend = oracle::median (straight);
  EXPECT_LT (bend, 0.0);
  // None is left, but no more is added than the caution against one.
  EXPECT_GT (oracle::median (on_line_of_curvature), 0.0);
  EXPECT_LT (oracle::median (on_line_of_curvature), -bend);
}

TEST (Profiles, KeepMaximaThatTheirTurnIsNoReasonOf)
{
  const ProfileParabola straight{0.0, -0.4, 0.0};
  EXPECT_DOUBLE_EQ (straight.bendOnCurvatureLine (1.0, 0.1), -0.4);
  const ProfileParabola noisy{0.0, -0.4, 0.1};
  EXPECT_DOUBLE_EQ (noisy.bendOnCurvatureLine (1.0, 0.1), -0.4);
}
