// SPDX-License-Identifier: BSD-3-Clause
// The errors of profiles against how profiles really scatter where curvature is
// constant.
#include <gtest/gtest.h>

#include "crests/profile_blend.h"
#include "support/noisy_cloud.h"
#include "support/scale_fits.h"

#include <cmath>

using namespace pcl::crest;

namespace {

struct Scatter {
  double slope;
  double bend;
};

/** \brief Variances of slope and bend in standard errors, away from the ends. */
Scatter
scatterOf (const oracle::ScaleFits& run, int nearest, bool elongated)
{
  const std::vector<std::uint8_t> all (run.level.size(), 1);
  const std::vector<ProfilePolynomial> polynomials =
      fitPolynomials (run.level, run.fits, all, nearest, elongated ? 4.0 : 1.0, 0);
  const ProfileErrors errors = profileErrors (nearest, elongated);
  std::vector<double> slope;
  std::vector<double> bend;
  for (std::size_t i = 0; i < run.stages.points.size(); ++i) {
    const Eigen::Vector3d p = run.stages.points.positions[i].cast<double>();
    const index_t node = run.level.node_of[i];
    if (!polynomials[node].valid || std::abs (p.z()) > 0.6)
      continue;
    const BlendedProfile blend =
        blendProfiles (p, node, run.level, run.fits, polynomials);
    const double error = polynomials[node].k1_error;
    slope.push_back (blend.profile.slope / (errors.slope * error));
    bend.push_back (blend.profile.bend / (errors.bend * error));
  }
  return {oracle::variance (slope), oracle::variance (bend)};
}

} // namespace

TEST (ProfileErrors, AreThoseOfNoisyCylinders)
{
  struct Case {
    int level, nearest;
    double noise;
  };
  // Noise small enough that k1 is certain, or the fit takes the larger of two that are
  // not, and large enough to hide what a cubic cannot follow.
  const auto exact = oracle::sample (oracle::cylinder (0.5), 20000);
  const double h = oracle::meanSpacing (*exact);
  for (const Case& c : {Case{0, 28, 0.01},
                        Case{1, 28, 0.1},
                        Case{1, 44, 0.2},
                        Case{1, 70, 0.4},
                        Case{2, 28, 0.6},
                        Case{2, 44, 0.8},
                        Case{2, 70, 1.0}}) {
    const auto cloud = oracle::withNoise (*exact, c.noise * h);
    const oracle::ScaleFits run = oracle::fitsAt (*cloud, c.level, c.nearest);
    for (const bool elongated : {false, true}) {
      if (elongated && c.level == 0)
        continue;
      SCOPED_TRACE (testing::Message() << "level " << c.level << ", " << c.nearest
                                       << " nodes, elongated " << elongated);
      const Scatter z = scatterOf (run, c.nearest, elongated);
      EXPECT_GT (z.slope, 0.7);
      EXPECT_LT (z.slope, 1.4);
      EXPECT_GT (z.bend, 0.7);
      EXPECT_LT (z.bend, 1.4);
    }
  }
}
