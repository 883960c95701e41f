// SPDX-License-Identifier: BSD-3-Clause
// Samples of faces: even by comparing all with all, and on the faces.
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "meshes/face_samples.h"
#include "meshes/shared_corners.h"
#include "meshes/triangulation.h"
#include "support/polygon_mesh.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

using namespace pcl::crest;
using oracle::PolygonMesh;

namespace {

struct Sampled {
  Faces triangles;
  TriangleShapes shapes;
  FaceSamples samples;
};

Sampled
sample (const PolygonMesh& mesh, double spacing, unsigned threads = 1)
{
  Sampled result;
  result.triangles = triangulate (mesh.view(), shareCorners (mesh.view(), mesh.faces));
  result.shapes =
      measureTriangles (mesh.view(),
                        result.triangles,
                        tabulateEdges (result.triangles, mesh.points.size()));
  result.samples =
      sampleFaces (mesh.view(), result.triangles, result.shapes, spacing, threads);
  return result;
}

double
areaOf (const TriangleShapes& shapes)
{
  return std::accumulate (shapes.areas.begin(), shapes.areas.end(), 0.0);
}

/** \brief The distance to the nearest of some points that is not the same. */
double
nearestTo (const Eigen::Vector3f& place, const std::vector<Eigen::Vector3f>& points)
{
  float least = std::numeric_limits<float>::max();
  for (const Eigen::Vector3f& p : points)
    if (p != place)
      least = std::min (least, (p - place).squaredNorm());
  return std::sqrt (static_cast<double> (least));
}

/** \brief Two triangles for each square of a grid over the unit square. */
PolygonMesh
fineSquare (int side)
{
  PolygonMesh mesh;
  for (int i = 0; i <= side; ++i)
    for (int j = 0; j <= side; ++j)
      mesh.points.push_back (Eigen::Vector3f (i, j, 0) / static_cast<float> (side));
  for (int i = 0; i < side; ++i)
    for (int j = 0; j < side; ++j) {
      const int a = i * (side + 1) + j;
      const int b = a + side + 1;
      mesh.add ({a, b, b + 1});
      mesh.add ({a, b + 1, a + 1});
    }
  return mesh;
}

TEST (FaceSamples, AreEvenWithinFacesAndAcrossEdges)
{
  constexpr double SPACING = 0.04;
  // Of many triangles each gets less than a dart.
  for (const PolygonMesh& mesh :
       {oracle::cuboid (1.0F, 0.8F, 0.6F), fineSquare (100)}) {
    const Sampled sampled = sample (mesh, SPACING);
    const std::vector<Eigen::Vector3f>& positions = sampled.samples.positions;
    const double expected = areaOf (sampled.shapes) / (SPACING * SPACING);
    EXPECT_NEAR (static_cast<double> (positions.size()), expected, 0.05 * expected);
    for (const Eigen::Vector3f& p : positions) {
      const double nearest = nearestTo (p, positions);
      EXPECT_GT (nearest, 0.76 * SPACING);
      EXPECT_LT (nearest, 1.6 * SPACING);
    }
    // Nor is there room for another, as dense other samples of the faces tell.
    for (const Eigen::Vector3f& p : sample (mesh, 0.6 * SPACING).samples.positions)
      EXPECT_LT (nearestTo (p, positions), 1.15 * SPACING);
  }
}

TEST (FaceSamples, LieOnTheirFaces)
{
  const Sampled sampled = sample (oracle::cuboid (1.0F, 0.8F, 0.6F), 0.05);
  const Eigen::Vector3f size (1.0F, 0.8F, 0.6F);
  for (std::size_t i = 0; i < sampled.samples.positions.size(); ++i) {
    const Eigen::Vector3f& p = sampled.samples.positions[i];
    const Eigen::Vector3f& n = sampled.samples.normals[i];
    const Eigen::Vector3f out = (p - size / 2).cwiseQuotient (size / 2);
    Eigen::Index axis = 0;
    EXPECT_NEAR (out.cwiseAbs().maxCoeff (&axis), 1.0F, 1e-6F);
    EXPECT_NEAR (std::abs (n.dot (out)), 1.0F, 1e-5F);
    EXPECT_GT (n.dot (out), 0.0F);
  }
}

TEST (FaceSamples, BothSidesOfAPlateAreComplete)
{
  constexpr double SPACING = 0.05;
  const Sampled sampled = sample (oracle::cuboid (2.0F, 2.0F, 0.01F), SPACING);
  for (const float side : {-1.0F, 1.0F}) {
    const auto count = std::count_if (
        sampled.samples.normals.begin(),
        sampled.samples.normals.end(),
        [side] (const Eigen::Vector3f& n) { return n.z() * side > 0.5F; });
    // But for where those of the rim take room.
    EXPECT_NEAR (static_cast<double> (count), 4.0 / (SPACING * SPACING), 200.0);
  }
}

TEST (FaceSamples, AreTheSameForAnyNumberOfThreads)
{
  const PolygonMesh mesh = oracle::cylinder (24, 3.0F);
  const FaceSamples one = sample (mesh, 0.02, 1).samples;
  for (const unsigned threads : {2U, 5U}) {
    const FaceSamples several = sample (mesh, 0.02, threads).samples;
    EXPECT_EQ (one.positions, several.positions);
    EXPECT_EQ (one.normals, several.normals);
  }
}

TEST (Triangulation, CutsPolygonsThatAreNotConvex)
{
  const PolygonMesh mesh = oracle::lProfile();
  const Sampled sampled = sample (mesh, 1.0);
  // Caps of 4 and walls of 2 triangles.
  EXPECT_EQ (2 * 4 + 6 * 2U, sampled.triangles.size());
  EXPECT_NEAR (areaOf (sampled.shapes), 2 * 6.0 + 14 * 10.0, 1e-5);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < sampled.triangles.size(); ++i)
    sum += sampled.shapes.areas[i] * sampled.shapes.normals[i];
  EXPECT_LT (sum.norm(), 1e-5);
}

TEST (Triangulation, TakesEachTriangleOnce)
{
  PolygonMesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.add ({0, 1, 2});
  mesh.add ({1, 2, 0});
  mesh.add ({2, 1, 0});
  const Faces triangles = triangulate (mesh.view(), mesh.faces);
  EXPECT_EQ (std::vector<index_t> ({0, 1, 2}), triangles.corners);
}

TEST (SharedCorners, AreThoseOfTheSamePlaceUpToRounding)
{
  const PolygonMesh whole = oracle::cuboid (1.0F, 0.8F, 0.6F);
  PolygonMesh soup;
  float rounding = 0.0F;
  for (std::size_t face = 0; face < whole.faces.size(); ++face) {
    std::vector<index_t> corners;
    for (std::size_t i = whole.faces.begin (face); i < whole.faces.ends[face]; ++i) {
      corners.push_back (static_cast<index_t> (soup.points.size()));
      rounding = 2e-7F - rounding;
      soup.points.push_back (whole.points[whole.faces.corners[i]] +
                             Eigen::Vector3f::Constant (rounding));
    }
    soup.add (corners);
  }
  // Faces of a point that is nowhere, and of two corners, are none.
  soup.points.emplace_back (std::numeric_limits<float>::quiet_NaN(), 0.0F, 0.0F);
  soup.add ({0, 1, 24});
  soup.add ({0, 0, 1});
  const Faces shared = shareCorners (soup.view(), soup.faces);
  EXPECT_EQ (6U, shared.size());
  std::vector<index_t> corners = shared.corners;
  std::sort (corners.begin(), corners.end());
  corners.erase (std::unique (corners.begin(), corners.end()), corners.end());
  EXPECT_EQ (8U, corners.size());
}

TEST (TriangleShapes, ANeedleLooksWhereItsNeighbourDoes)
{
  PolygonMesh mesh;
  // One side of a square has a vertex in the middle, on one of its sides only.
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0.5F, 1e-7F, 0}, {0.5F, 0, -1}};
  mesh.add ({0, 1, 2});
  mesh.add ({1, 0, 3});
  const EdgeTable edges = tabulateEdges (mesh.faces, mesh.points.size());
  const TriangleShapes shapes = measureTriangles (mesh.view(), mesh.faces, edges);
  EXPECT_LT ((shapes.normals[1] - Eigen::Vector3d::UnitZ()).norm(), 1e-12);
}

} // namespace
