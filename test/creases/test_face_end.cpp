// SPDX-License-Identifier: BSD-3-Clause
// Ends of faces against holes, pins and steps that are known exactly.
#include <gtest/gtest.h>

#include "creases/face_end.h"

#include <cmath>
#include <functional>

using namespace pcl::crest;
using Eigen::Vector3d;

namespace {

/** Samples of the face z = 0 and of a wall beside it. */
using Samples = std::vector<Vector3d>;

/** \brief A face in rows, each moved against the last, where a condition holds. */
Samples
face (const std::function<bool (double x, double y)>& holds)
{
  Samples samples;
  for (int row = -8; row <= 8; ++row)
    for (int column = -8; column <= 8; ++column) {
      const double x = column + 0.5 * (row % 2);
      const double y = 0.866 * row;
      if (holds (x, y))
        samples.emplace_back (x, y, 0.0);
    }
  return samples;
}

/** \brief Adds a round wall through the origin that is tangent to the y axis there.
 * \param[in] radius positive if its axis is at positive x
 * \param[in] height of its end, negative below the face
 */
void
addRoundWall (double radius, double height, Samples& samples)
{
  const double size = std::abs (radius);
  const int around = static_cast<int> (std::lround (2.0 * M_PI * size));
  for (double level = 0.0; level <= std::abs (height); level += 0.9)
    for (int i = 0; i < around; ++i) {
      const double angle = 2.0 * M_PI * i / around;
      samples.emplace_back (radius - radius * std::cos (angle),
                            size * std::sin (angle),
                            std::copysign (level, height));
    }
}

std::optional<FaceEnd>
endAt (const Vector3d& place, const Samples& samples)
{
  Coordinates from_place;
  from_place.resize (samples.size());
  for (std::size_t i = 0; i < samples.size(); ++i)
    from_place.set (i, samples[i] - place);
  return fitFaceEnd (from_place, Vector3d::UnitZ());
}

constexpr double RADIUS = 2.0;

bool
outside (double x, double y)
{
  return std::hypot (x - RADIUS, y) > RADIUS + 0.2;
}

} // namespace

TEST (FaceEnd, IsTheRimOfAHoleOrOfAPin)
{
  for (const double height : {-4.0, 4.0}) {
    Samples samples = face (outside);
    addRoundWall (RADIUS, height, samples);
    const auto end = endAt (Vector3d::Zero(), samples);
    ASSERT_TRUE (end);
    EXPECT_LT (end->foot.norm(), 0.35);
    EXPECT_GT (std::abs (end->direction.y()), std::cos (0.2));
    EXPECT_EQ (height < 0.0, end->convex);
    EXPECT_NEAR (90.0, end->angle, 15.0);
    // What the face ends at looks to positive x below, to negative x above it.
    EXPECT_GT (end->normal.dot (Vector3d (height < 0.0 ? 1.0 : -1.0, 0.0, 1.0)), 1.2);
    EXPECT_LT (end->of_face, 1e-9);
    EXPECT_GT (end->of_all, 0.1);
  }
}

TEST (FaceEnd, IsTheEdgeOfAStepThatLeansOver)
{
  // Down a slope of 60 degrees.
  Samples samples = face ([] (double x, double) { return x < -0.2; });
  for (int row = 0; row < 8; ++row)
    for (int y = -8; y <= 8; ++y)
      samples.emplace_back (0.4 * row, y, -0.693 * row);
  const auto end = endAt (Vector3d::Zero(), samples);
  ASSERT_TRUE (end);
  EXPECT_TRUE (end->convex);
  EXPECT_LT (end->foot.norm(), 0.2);
  EXPECT_NEAR (60.0, end->angle, 10.0);
}

TEST (FaceEnd, IsTheSameOfNormalsTurnedOver)
{
  Samples samples = face (outside);
  addRoundWall (RADIUS, -4.0, samples);
  Coordinates positions;
  positions.resize (samples.size());
  for (std::size_t i = 0; i < samples.size(); ++i)
    positions.set (i, samples[i]);
  const Vector3d normal = Vector3d (0.01, -0.02, 1.0).normalized();
  const auto end = fitFaceEnd (positions, normal);
  const auto turned = fitFaceEnd (positions, -normal);
  ASSERT_TRUE (end && turned);
  EXPECT_EQ (end->foot, turned->foot);
  EXPECT_EQ (end->normal, -turned->normal);
  EXPECT_NE (end->convex, turned->convex);
}

TEST (FaceEnd, IsNotInsideNorAtABorder)
{
  const auto everywhere = [] (double, double) { return true; };
  EXPECT_FALSE (endAt (Vector3d::Zero(), face (everywhere)));
  EXPECT_FALSE (
      endAt (Vector3d::Zero(), face ([] (double x, double) { return x < 0.4; })));
  Samples samples = face (outside);
  addRoundWall (RADIUS, -4.0, samples);
  EXPECT_FALSE (endAt (Vector3d (-3.0, 0.0, 0.0), samples));
}

TEST (FaceEnd, IsNoneOfASheetBehindAFaceThatEnds)
{
  // Both go on to negative x, and neither beyond.
  Samples samples = face ([] (double x, double) { return x < 0.4; });
  const std::size_t count = samples.size();
  for (std::size_t i = 0; i < count; ++i)
    samples.emplace_back (samples[i] - Vector3d (0.0, 0.0, 1.0));
  EXPECT_FALSE (endAt (Vector3d::Zero(), samples));
}

TEST (FaceEnd, IsNoneOfRoundSurfaces)
{
  constexpr double SPHERE = 6.0;
  Samples samples = face ([] (double, double) { return true; });
  for (Vector3d& p : samples)
    p.z() = -SPHERE + std::sqrt (std::max (0.0, SPHERE * SPHERE - p.squaredNorm()));
  EXPECT_FALSE (endAt (Vector3d::Zero(), samples));
}
