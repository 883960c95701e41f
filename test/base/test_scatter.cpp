// SPDX-License-Identifier: BSD-3-Clause
// Axes of scattered points against Eigen's iterative solver.
#include <gtest/gtest.h>

#include "base/scatter.h"

#include <random>

using namespace pcl::crest;

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr std::size_t COUNT = 40;

/** \brief Points around a center that spread by these lengths along three axes. */
Coordinates
cloud (const Vector3d& spread, unsigned seed)
{
  std::mt19937 random (seed);
  std::normal_distribution<double> normal;
  const auto vector = [&] {
    return Vector3d (normal (random), normal (random), normal (random));
  };
  const Eigen::Quaterniond turn =
      Eigen::Quaterniond (normal (random), normal (random), normal (random), 1.0)
          .normalized();
  const Vector3d center = spread.maxCoeff() * vector();
  Coordinates points;
  points.resize (COUNT);
  for (std::size_t i = 0; i < COUNT; ++i)
    points.set (i, center + turn * spread.cwiseProduct (vector()));
  return points;
}

Scatter
scatterOf (const Coordinates& points)
{
  Scatter scatter;
  scatter.add (points, 0, COUNT, [] (std::size_t) { return 1.0; });
  return scatter;
}

/** \brief The matrix of the sums of products from the center, done one by one. */
Matrix3d
productsOf (const Coordinates& points)
{
  Vector3d center = Vector3d::Zero();
  for (std::size_t i = 0; i < COUNT; ++i)
    center += points[i] / static_cast<double> (COUNT);
  Matrix3d products = Matrix3d::Zero();
  for (std::size_t i = 0; i < COUNT; ++i)
    products += (points[i] - center) * (points[i] - center).transpose();
  return products;
}

class ScatterAxes : public testing::TestWithParam<Vector3d> {};

} // namespace

TEST_P (ScatterAxes, AreThoseOfEigen)
{
  for (unsigned seed = 0; seed < 200; ++seed) {
    const Coordinates points = cloud (GetParam(), seed);
    const Matrix3d products = productsOf (points);
    const Eigen::SelfAdjointEigenSolver<Matrix3d> solver (products);
    const Vector3d& expected = solver.eigenvalues();
    const double total = products.trace();
    const Scatter scatter = scatterOf (points);
    const Vector3d squares = scatter.axes();
    EXPECT_LE (squares[0], squares[1]);
    EXPECT_LE (squares[1], squares[2]);
    for (int i = 0; i < 3; ++i)
      EXPECT_NEAR (squares[i], expected[i], 1e-9 * total) << seed;

    double square = 0.0;
    const Vector3d longest = scatter.longestAxis (square);
    EXPECT_NEAR (square, expected[2], 1e-9 * total) << seed;
    EXPECT_NEAR (longest.norm(), 1.0, 1e-12);
    EXPECT_LE ((products * longest - expected[2] * longest).norm(), 1e-7 * total)
        << seed;

    Plane plane;
    plane.normal = -solver.eigenvectors().col (0);
    ASSERT_EQ (scatter.fitPlane (plane), expected[1] >= 0.04 * expected[2]) << seed;
    if (expected[1] < 0.04 * expected[2])
      continue;
    EXPECT_NEAR (plane.residual, expected[0], 1e-9 * total) << seed;
    EXPECT_LE ((products * plane.normal - expected[0] * plane.normal).norm(),
               1e-7 * total)
        << seed;
    // On the side that it had.
    EXPECT_LT (plane.normal.dot (solver.eigenvectors().col (0)), 0.0) << seed;
  }
}

INSTANTIATE_TEST_SUITE_P (Spreads,
                          ScatterAxes,
                          testing::Values (Vector3d (1.0, 0.7, 0.4),
                                           Vector3d (1.0, 0.8, 0.02),
                                           Vector3d (1.0, 0.8, 0.0),
                                           Vector3d (1.0, 0.01, 0.01),
                                           Vector3d (1.0, 0.0, 0.0),
                                           Vector3d (1e25, 0.7e25, 0.1e25),
                                           Vector3d (1e-25, 0.7e-25, 0.1e-25)));

// All directions are as good: one of unit length is enough.
TEST (Scatter, HasAnAxisWhereAllAreEqual)
{
  Coordinates points;
  points.resize (6);
  for (int i = 0; i < 6; ++i)
    points.set (i, (i % 2 == 0 ? 1.0 : -1.0) * Vector3d::Unit (i / 2));
  Scatter scatter;
  scatter.add (points, 0, 6, [] (std::size_t) { return 1.0; });
  double square = 0.0;
  EXPECT_NEAR (scatter.longestAxis (square).norm(), 1.0, 1e-9);
  // A thousandth of the sum of all three: Newton's method is slow at triple roots.
  EXPECT_NEAR (square, 2.0, 6e-3);
}

TEST (Scatter, IsNoPlaneInOnePlace)
{
  Coordinates points;
  points.resize (COUNT);
  for (std::size_t i = 0; i < COUNT; ++i)
    points.set (i, Vector3d (1.0, 2.0, 3.0));
  Plane plane;
  plane.normal = Vector3d::UnitZ();
  EXPECT_FALSE (scatterOf (points).fitPlane (plane));
}

TEST (Scatter, PartsAreThoseOfTheSides)
{
  const Coordinates points = cloud ({1.0, 0.7, 0.4}, 1);
  const auto side = [] (std::size_t i) { return i % 3 == 0 ? 1.0 : -1.0; };
  Scatter differences;
  differences.add (points, 0, COUNT, side);
  const Scatter all = scatterOf (points);
  for (const double wanted : {1.0, -1.0}) {
    Scatter expected;
    expected.add (points, 0, COUNT, [&] (std::size_t i) {
      return side (i) == wanted ? 1.0 : 0.0;
    });
    const Scatter part = all.part (differences, wanted);
    EXPECT_LE ((part.center() - expected.center()).norm(), 1e-12);
    EXPECT_LE ((part.axes() - expected.axes()).norm(), 1e-9);
  }
}
