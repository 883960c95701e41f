// SPDX-License-Identifier: BSD-3-Clause
// What a quartic leaves, of points whose heights are known.
#include <gtest/gtest.h>

#include "creases/quartic_residual.h"

#include <cmath>
#include <random>

using namespace pcl::crest;

namespace {

/** \brief Points of a sunflower one apart, nearest first, with heights along z. */
template <typename Height>
Coordinates
points (const Height& height)
{
  Coordinates result;
  result.resize (QUARTIC_POINTS);
  for (std::size_t i = 0; i < QUARTIC_POINTS; ++i) {
    const double radius = std::sqrt (static_cast<double> (i) / M_PI);
    const double angle = static_cast<double> (i) * M_PI * (3.0 - std::sqrt (5.0));
    const double x = radius * std::cos (angle);
    const double y = radius * std::sin (angle);
    result.set (i, {x, y, height (x, y)});
  }
  return result;
}

} // namespace

TEST (QuarticResidual, OfAQuarticIsNothing)
{
  const auto quartic = [] (double x, double y) {
    return 0.3 - x + 0.5 * x * y + y * y - 0.2 * x * x * x + 0.1 * x * x * y * y -
           0.05 * y * y * y * y;
  };
  EXPECT_LT (quarticResidual (points (quartic), Eigen::Vector3d::UnitZ()), 1e-20);
}

TEST (QuarticResidual, OfNoiseIsItsVariance)
{
  std::mt19937 random (1);
  std::normal_distribution<double> noise (0.0, 0.2);
  constexpr int WINDOWS = 2000;
  double sum = 0.0;
  for (int i = 0; i < WINDOWS; ++i)
    sum +=
        quarticResidual (points ([&] (double x, double) { return x + noise (random); }),
                         Eigen::Vector3d::UnitZ());
  EXPECT_NEAR (sum / WINDOWS, 0.04, 0.002);
}

TEST (QuarticResidual, TellsAWaveFromAnEdge)
{
  // The wave is five spacings long and as high as the edge.
  const auto wave = [] (double x, double) {
    return 0.4 * std::cos (2.0 * M_PI / 5.0 * x);
  };
  const auto edge = [] (double x, double) { return -0.32 * std::abs (x); };
  const Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  EXPECT_LT (4.0 * quarticResidual (points (wave), up),
             quarticResidual (points (edge), up));
}
