// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "crests/crest_points.h"
#include "support/stage_inputs.h"

using namespace pcl::crest;

namespace {

/** \brief A point with one neighbour in each of the directions given, in degrees, and
 * curvatures to be set by hand; t1 of the point is the x axis.
 */
struct Scene {
  explicit Scene (const std::vector<double>& directions)
  {
    std::vector<Eigen::Vector3f> positions{Eigen::Vector3f::Zero()};
    std::vector<std::pair<int, int>> edges;
    for (const double degrees : directions) {
      const double a = degrees * M_PI / 180.0;
      edges.emplace_back (0, static_cast<int> (positions.size()));
      positions.emplace_back (
          static_cast<float> (std::cos (a)), static_cast<float> (std::sin (a)), 0.0F);
    }
    points = oracle::pointsAt (positions);
    graph = oracle::graphOf (positions.size(), edges);
    curvature.assign (positions.size(), {0.0F, 0.0F, Eigen::Vector3f::UnitX(), true});
  }

  CrestType
  classify (double m) const
  {
    return classify (PerType<double>{m, m});
  }

  CrestType
  classify (const PerType<double>& m) const
  {
    return classifyCrestPoints (
        curvature, measureMaximality (points, graph, curvature, 1), m)[0];
  }

  OrientedPoints points;
  SurfaceGraph graph;
  std::vector<PrincipalCurvature> curvature;
};

/** \brief Neighbours every 45 degrees; the first is ahead, the fifth behind. */
Scene
eightAround (float k1, float ahead, float behind, float elsewhere)
{
  Scene scene ({0, 45, 90, 135, 180, 225, 270, 315});
  for (PrincipalCurvature& c : scene.curvature)
    c.k1 = elsewhere;
  scene.curvature[0].k1 = k1;
  scene.curvature[1].k1 = ahead;
  scene.curvature[5].k1 = behind;
  return scene;
}

} // namespace

TEST (CrestPoints, MaximumAcrossIsACrestWhateverIsAlong)
{
  EXPECT_EQ (eightAround (2, 1, 1.5F, 9).classify (0.01), CrestType::RIDGE);
  EXPECT_EQ (eightAround (-2, 1, -1.5F, 9).classify (0.01), CrestType::VALLEY);
}

TEST (CrestPoints, BothSidesHaveToBeLower)
{
  EXPECT_EQ (eightAround (2, 3, 1, 0).classify (0.01), CrestType::NONE);
  EXPECT_EQ (eightAround (2, 1, 3, 0).classify (0.01), CrestType::NONE);
  // It is the square that counts, not the sign.
  EXPECT_EQ (eightAround (2, -3, 1, 0).classify (0.01), CrestType::NONE);
}

TEST (CrestPoints, TheDifferenceOfSquaresHasToExceedM)
{
  const Scene scene = eightAround (2, 1, 1, 0);
  EXPECT_EQ (scene.classify (2.999), CrestType::RIDGE);
  EXPECT_EQ (scene.classify (3.0), CrestType::NONE);
}

TEST (CrestPoints, RidgesAndValleysHaveEachTheirM)
{
  const PerType<double> m{1.0, 100.0};
  EXPECT_EQ (eightAround (2, 1, 1, 0).classify (m), CrestType::RIDGE);
  EXPECT_EQ (eightAround (-2, 1, 1, 0).classify (m), CrestType::NONE);
}

TEST (CrestPoints, TheNeighbourClosestInAngleIsTheOneAcross)
{
  // 20 degrees off is closer than 30, though both are of the same distance.
  Scene scene ({20, -30, 170, 150});
  scene.curvature[0].k1 = 2;
  scene.curvature[2].k1 = 3;
  scene.curvature[4].k1 = 3;
  EXPECT_EQ (scene.classify (0.01), CrestType::RIDGE);
  scene.curvature[1].k1 = 3;
  EXPECT_EQ (scene.classify (0.01), CrestType::NONE);
}

TEST (CrestPoints, OfEquallyCloseNeighboursTheLowerIndexCounts)
{
  Scene scene ({30, -30, 150, -150});
  scene.curvature[0].k1 = 2;
  scene.curvature[2].k1 = 3;
  scene.curvature[4].k1 = 3;
  EXPECT_EQ (scene.classify (0.01), CrestType::RIDGE);
  scene.curvature[1].k1 = 3;
  EXPECT_EQ (scene.classify (0.01), CrestType::NONE);
  scene.curvature[1].k1 = 0;
  scene.curvature[3].k1 = 3;
  EXPECT_EQ (scene.classify (0.01), CrestType::NONE);
}

TEST (CrestPoints, AnglesAreThoseInTheTangentPlane)
{
  // Far below the plane but straight ahead in it: closer in angle than 20 degrees off.
  Scene scene ({0, 20, 180});
  scene.points.positions[1].z() = -2.0F;
  scene.curvature[0].k1 = 2;
  scene.curvature[2].k1 = 3;
  EXPECT_EQ (scene.classify (0.01), CrestType::RIDGE);
}

TEST (CrestPoints, WhereTheSurfaceEndsThereIsNoMaximum)
{
  Scene scene ({20, -30, 80, -85});
  scene.curvature[0].k1 = 2;
  EXPECT_EQ (scene.classify (0.01), CrestType::NONE);
}

TEST (CrestPoints, NoneWhereNoCurvatureIsTheLargest)
{
  Scene scene = eightAround (2, 1, 1, 0);
  scene.curvature[0].k2 = -2;
  EXPECT_EQ (scene.classify (0.01), CrestType::NONE);
}

TEST (CrestPoints, UndeterminedCurvatureIsNeitherCrestNorLower)
{
  Scene own = eightAround (2, 1, 1, 0);
  own.curvature[0].valid = false;
  EXPECT_EQ (own.classify (0.01), CrestType::NONE);
  Scene other = eightAround (2, 0, 1, 0);
  other.curvature[1].valid = false;
  EXPECT_EQ (other.classify (0.01), CrestType::NONE);
}

TEST (CrestPoints, RelativeMIsMeasuredInTenthsOfTheExtent)
{
  OrientedPoints points;
  points.extent = 50.0;
  Parameters parameters;
  parameters.maximality = {0.5, 2.0};
  EXPECT_DOUBLE_EQ (absoluteMaximality (parameters, points.extent).ridge, 0.5 / 25.0);
  EXPECT_DOUBLE_EQ (absoluteMaximality (parameters, points.extent).valley, 2.0 / 25.0);
  parameters.absolute_maximality = true;
  EXPECT_DOUBLE_EQ (absoluteMaximality (parameters, points.extent).ridge, 0.5);
}
