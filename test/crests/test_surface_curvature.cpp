// SPDX-License-Identifier: BSD-3-Clause
// Which scale the curvature of a sample is of.
#include <gtest/gtest.h>

#include "crests/crest_profile.h"

using namespace pcl::crest;

namespace {

CrestProfile
profile (float k1, float finest_k1, float finest_error, float noise)
{
  CrestProfile result;
  result.curvature = {k1, 0.0F, Eigen::Vector3f::UnitX(), true};
  result.finest = {{finest_k1, 0.0F, Eigen::Vector3f::UnitY(), true}, finest_error};
  result.noise = noise;
  return result;
}

} // namespace

TEST (SurfaceCurvature, IsThatOfTheFinestScaleWhereItIsCertain)
{
  EXPECT_EQ (surfaceCurvature (profile (0.9F, 1.0F, 0.1F, 0.0F), 1.0F).k1, 1.0F);
  EXPECT_EQ (surfaceCurvature (profile (0.9F, 1.0F, 0.2F, 0.0F), 1.0F).k1, 0.9F);
}

TEST (SurfaceCurvature, IsThatOfTheFinestScaleWhereAWideOneIsBiased)
{
  EXPECT_EQ (surfaceCurvature (profile (0.5F, 0.1F, 0.1F, 0.0F), 1.0F).k1, 0.1F);
  EXPECT_EQ (surfaceCurvature (profile (0.3F, 0.1F, 0.1F, 0.0F), 1.0F).k1, 0.3F);
}

TEST (SurfaceCurvature, IsThatOfTheProfileInNoise)
{
  const CrestProfile noisy = profile (0.5F, 1.0F, 0.1F, 0.2F);
  EXPECT_EQ (surfaceCurvature (noisy, 1.0F).k1, 0.5F);
  EXPECT_EQ (surfaceCurvature (noisy, 2.0F).k1, 1.0F);
}

TEST (SurfaceCurvature, OfTheFinestProfileHasItsDirection)
{
  EXPECT_EQ (surfaceCurvature (profile (1.0F, 1.0F, 0.0F, 0.0F), 1.0F).t1,
             Eigen::Vector3f::UnitX());
}
