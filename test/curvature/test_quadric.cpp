// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "curvature/quadric.h"
#include "support/stage_inputs.h"

#include <cmath>
#include <functional>
#include <random>

using namespace pcl::crest;

namespace {

/** \brief A point of a surface and eight samples around it, `spacing` away in the
 * parameter domain, as the filter would choose them; the star of point 0.
 */
struct Patch {
  OrientedPoints points;
  std::vector<index_t> neighbors;

  Star
  star () const
  {
    return {neighbors.data(), neighbors.data() + neighbors.size()};
  }
};

Patch
patchOf (const std::function<Eigen::Vector3d (double, double)>& surface,
         double u,
         double v,
         double spacing,
         const Eigen::Vector3d& normal)
{
  Patch patch;
  std::vector<Eigen::Vector3f> positions{surface (u, v).cast<float>()};
  for (const int i : {-1, 0, 1})
    for (const int j : {-1, 0, 1})
      if (i != 0 || j != 0) {
        patch.neighbors.push_back (static_cast<index_t> (positions.size()));
        positions.push_back (surface (u + i * spacing, v + j * spacing).cast<float>());
      }
  patch.points = oracle::pointsAt (positions);
  patch.points.normals[0] = normal.normalized().cast<float>();
  return patch;
}

void
expectCurvature (const Patch& patch, double k1, double k2, const Eigen::Vector3d& t1)
{
  const PrincipalCurvature c = fitQuadric (patch.points, 0, patch.star());
  ASSERT_TRUE (c.valid);
  EXPECT_NEAR (c.k1, k1, 1e-3 * std::abs (k1));
  EXPECT_NEAR (c.k2, k2, 1e-3 * std::abs (k1));
  if (!t1.isZero()) {
    EXPECT_NEAR (std::abs (c.t1.cast<double>().dot (t1)), 1.0, 1e-5);
  }
}

Eigen::Vector3d
onCylinder (double u, double v)
{
  return {2.0 * std::cos (u), 2.0 * std::sin (u), v};
}

Eigen::Vector3d
onTorus (double u, double v)
{
  const double r = 3.0 + std::cos (v);
  return {r * std::cos (u), r * std::sin (u), std::sin (v)};
}

Eigen::Vector3d
onSphere (double u, double v)
{
  return 0.5 * Eigen::Vector3d (std::cos (u) * std::cos (v),
                                std::sin (u) * std::cos (v),
                                std::sin (v));
}

Eigen::Vector3d
onSaddle (double u, double v)
{
  return {u, v, 0.5 * (3.0 * u * u - v * v)};
}

} // namespace

TEST (Curvature, SphereIsUmbilicAndPositiveSeenFromOutside)
{
  const Eigen::Vector3d p = onSphere (0.3, 0.4);
  expectCurvature (
      patchOf (onSphere, 0.3, 0.4, 0.03, p), 2.0, 2.0, Eigen::Vector3d::Zero());
  expectCurvature (
      patchOf (onSphere, 0.3, 0.4, 0.03, -p), -2.0, -2.0, Eigen::Vector3d::Zero());
}

TEST (Curvature, CylinderBendsAround)
{
  const Eigen::Vector3d around (-std::sin (0.7), std::cos (0.7), 0.0);
  const Eigen::Vector3d out (std::cos (0.7), std::sin (0.7), 0.0);
  expectCurvature (patchOf (onCylinder, 0.7, 0.0, 0.02, out), 0.5, 0.0, around);
}

TEST (Curvature, TorusOutsideAndInside)
{
  const Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  expectCurvature (
      patchOf (onTorus, 0.0, 0.0, 0.02, Eigen::Vector3d::UnitX()), 1.0, 0.25, up);
  expectCurvature (
      patchOf (onTorus, 0.0, M_PI, 0.02, -Eigen::Vector3d::UnitX()), 1.0, -0.5, up);
}

TEST (Curvature, SaddleHasBothSigns)
{
  // Along x the surface rises: concave seen from above.
  expectCurvature (patchOf (onSaddle, 0.0, 0.0, 0.02, Eigen::Vector3d::UnitZ()),
                   -3.0,
                   1.0,
                   Eigen::Vector3d::UnitX());
}

TEST (Curvature, PlaneHasNone)
{
  const auto plane = [] (double u, double v) { return Eigen::Vector3d (u, v, 0.0); };
  const Patch patch = patchOf (plane, 0.0, 0.0, 1.0, Eigen::Vector3d::UnitZ());
  const PrincipalCurvature c = fitQuadric (patch.points, 0, patch.star());
  EXPECT_TRUE (c.valid);
  EXPECT_EQ (c.k1, 0.0F);
  EXPECT_EQ (c.k2, 0.0F);
}

TEST (Curvature, ScalesWithTheInverseOfLength)
{
  for (const double scale : {1e-6, 1e6}) {
    const auto scaled = [scale] (double u, double v) {
      return Eigen::Vector3d (scale * onTorus (u, v));
    };
    const Patch patch = patchOf (scaled, 0.0, 0.0, 0.02, Eigen::Vector3d::UnitX());
    const PrincipalCurvature c = fitQuadric (patch.points, 0, patch.star());
    EXPECT_NEAR (c.k1 * scale, 1.0, 1e-3);
    EXPECT_NEAR (c.k2 * scale, 0.25, 1e-3);
  }
}

TEST (Curvature, FlippedNormalFlipsTheSignExactly)
{
  const Patch patch = patchOf (onTorus, 0.2, 0.9, 0.1, Eigen::Vector3d (0.6, 0.2, 0.8));
  Patch flipped = patch;
  flipped.points.normals[0] *= -1.0F;
  const PrincipalCurvature a = fitQuadric (patch.points, 0, patch.star());
  const PrincipalCurvature b = fitQuadric (flipped.points, 0, flipped.star());
  EXPECT_EQ (a.k1, -b.k1);
  EXPECT_EQ (a.k2, -b.k2);
  EXPECT_EQ (std::abs (a.t1.dot (b.t1)), a.t1.squaredNorm());
}

TEST (Curvature, StarThatDoesNotDetermineAQuadricIsInvalid)
{
  const auto fit = [] (const std::vector<Eigen::Vector3f>& positions) {
    const OrientedPoints points = oracle::pointsAt (positions);
    std::vector<index_t> star (positions.size() - 1);
    std::iota (star.begin(), star.end(), 1);
    return fitQuadric (points, 0, {star.data(), star.data() + star.size()}).valid;
  };
  EXPECT_FALSE (fit ({{0, 0, 0}}));
  EXPECT_FALSE (fit ({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
  // On one line, and on two lines, through the point.
  EXPECT_FALSE (fit ({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {-1, 0, 0}, {-3, 0, 1}}));
  EXPECT_FALSE (fit ({{0, 0, 0}, {1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 1}}));
  EXPECT_TRUE (fit ({{0, 0, 0}, {1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {1, 1, 0}}));
}

TEST (Curvature, PointsOfOneLineAreOnOneLineHoweverItLies)
{
  // Rounding puts points beside a line that is not parallel to an axis.
  std::mt19937 random (2);
  std::uniform_real_distribution<double> any (-1.0, 1.0);
  for (int i = 0; i < 500; ++i) {
    const Eigen::Vector3d through (any (random), any (random), any (random));
    const Eigen::Vector3d along (any (random), any (random), any (random));
    std::vector<Eigen::Vector3f> positions (9);
    for (Eigen::Vector3f& position : positions)
      position = (through + 1e-3 * any (random) * along.normalized()).cast<float>();
    OrientedPoints points = oracle::pointsAt (positions);
    points.normals[0] = along.unitOrthogonal().cast<float>();
    const std::vector<index_t> star{1, 2, 3, 4, 5, 6, 7, 8};
    EXPECT_FALSE (fitQuadric (points, 0, {star.data(), star.data() + 8}).valid) << i;
  }
}
