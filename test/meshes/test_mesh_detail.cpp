// SPDX-License-Identifier: BSD-3-Clause
// Which meshes need samples of their faces, and how fine ones.
#include <gtest/gtest.h>

#include "meshes/mesh_detail.h"
#include "meshes/shared_corners.h"
#include "meshes/triangulation.h"
#include "support/polygon_mesh.h"
#include "support/sphere_mesh.h"

#include <cmath>
#include <random>

using namespace pcl::crest;
using oracle::PolygonMesh;

namespace {

MeshDetail
detailOf (const PolygonMesh& mesh)
{
  const Faces triangles =
      triangulate (mesh.view(), shareCorners (mesh.view(), mesh.faces));
  const EdgeTable edges = tabulateEdges (triangles, mesh.points.size());
  return measureDetail (mesh.view(),
                        triangles,
                        edges,
                        measureTriangles (mesh.view(), triangles, edges),
                        1);
}

/** \brief A sphere as a scanner sees it.
 * \param[in] noise standard deviation, as a part of the sides of triangles
 */
PolygonMesh
scannedSphere (double noise)
{
  constexpr int SIDE = 24;
  const oracle::TriangleMesh exact = oracle::cubeSphere (SIDE);
  std::mt19937 random (1);
  std::normal_distribution<float> step (0.0F, static_cast<float> (noise * 1.6 / SIDE));
  PolygonMesh mesh;
  for (const Eigen::Vector3f& p : exact.points)
    mesh.points.emplace_back (
        noise == 0.0
            ? p
            : p + Eigen::Vector3f (step (random), step (random), step (random)));
  for (const auto& [a, b, c] : exact.triangles)
    mesh.add ({a, b, c});
  return mesh;
}

/** \brief The middle of a cap is a vertex of all its triangles. */
PolygonMesh
cylinderWithFans (int facets)
{
  PolygonMesh mesh = oracle::cylinder (facets, 1.0F);
  mesh.faces.corners.resize (4 * static_cast<std::size_t> (facets));
  mesh.faces.ends.resize (facets);
  for (const int level : {0, 1}) {
    mesh.points.emplace_back (0.0F, 0.0F, static_cast<float> (level));
    const auto middle = static_cast<index_t> (mesh.points.size()) - 1;
    for (int i = 0; i < facets; ++i) {
      const int from = level * facets + i;
      const int to = level * facets + (i + 1) % facets;
      if (level == 0)
        mesh.add ({middle, to, from});
      else
        mesh.add ({middle, from, to});
    }
  }
  return mesh;
}

TEST (MeshDetail, VerticesOnEdgesAloneDoNotTellFaces)
{
  for (const PolygonMesh& mesh : {oracle::cuboid (1.0F, 0.8F, 0.6F),
                                  oracle::lProfile(),
                                  oracle::cylinder (24, 5.0F),
                                  oracle::cylinder (64, 0.1F),
                                  cylinderWithFans (32)})
    EXPECT_TRUE (detailOf (mesh).needsSamples());
}

TEST (MeshDetail, ScansAreSamplesByThemselves)
{
  for (const double noise : {0.0, 0.1, 0.2, 0.4})
    EXPECT_FALSE (detailOf (scannedSphere (noise)).needsSamples()) << noise;
}

TEST (MeshDetail, APlaneHasNothingToFind)
{
  PolygonMesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  mesh.add ({0, 1, 2, 3});
  EXPECT_FALSE (detailOf (mesh).needsSamples());
}

TEST (MeshDetail, SpacingTellsTheNarrowestFeature)
{
  // The walls, which are the narrowest: 2 area over outline.
  const MeshDetail plate = detailOf (oracle::cuboid (4.0F, 4.0F, 0.1F));
  const double walls = 2.0 * 4.0 * 0.1 / (2.0 * 4.1);
  EXPECT_NEAR (plate.feature_width, 0.1 / (7.0 / 4.0), 1e-6);
  EXPECT_LT (plate.feature_width, walls);
  EXPECT_NEAR (plate.resolvingSpacing(), plate.feature_width / 4.0, 1e-6);
  EXPECT_FALSE (plate.isFinerThanSamples());
  // The rims of a bar are rings of radius 1.
  EXPECT_NEAR (detailOf (oracle::cylinder (64, 5.0F)).feature_width, 1.0, 0.01);
  // A cube needs no finer ones than lines that look smooth do.
  const MeshDetail cube = detailOf (oracle::cuboid (1.0F, 1.0F, 1.0F));
  EXPECT_NEAR (cube.resolvingSpacing(), std::sqrt (6.0 / 4e4), 1e-6);
  // Around a rod samples have to tell its sides apart.
  const MeshDetail rod = detailOf (oracle::cuboid (20.0F, 0.3F, 0.3F));
  EXPECT_NEAR (rod.region_width, 2.0 * 20.0 * 0.3 / (2.0 * 20.3), 1e-5);
  EXPECT_NEAR (rod.resolvingSpacing(), rod.region_width / 20.0, 1e-6);
  // Too narrow for a million samples.
  const MeshDetail sheet = detailOf (oracle::cuboid (100.0F, 100.0F, 0.02F));
  EXPECT_TRUE (sheet.isFinerThanSamples());
  EXPECT_NEAR (sheet.area / std::pow (sheet.resolvingSpacing(), 2.0), 1e6, 1.0);
}

} // namespace
