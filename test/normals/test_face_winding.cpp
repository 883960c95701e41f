// SPDX-License-Identifier: BSD-3-Clause
// Faces whose corners run the wrong way round, put right.
#include <gtest/gtest.h>

#include "normals/face_winding.h"
#include "support/polygon_mesh.h"
#include "support/sphere_mesh.h"

#include <cmath>

using namespace pcl::crest;
using Mesh = oracle::PolygonMesh;

namespace {

/** \brief A sphere some of whose triangles run clockwise. */
template <typename IsTurned>
Mesh
sphere (const IsTurned& is_turned)
{
  const oracle::TriangleMesh exact = oracle::cubeSphere (10);
  Mesh mesh;
  mesh.points = exact.points;
  for (const auto& [a, b, c] : exact.triangles)
    if (is_turned())
      mesh.add ({a, c, b});
    else
      mesh.add ({a, b, c});
  return mesh;
}

/** \brief Of the sphere's faces how many look outward. */
std::size_t
outward (const Mesh& mesh)
{
  std::size_t count = 0;
  for (std::size_t i = 0; i < mesh.faces.corners.size(); i += 3) {
    const auto point = [&] (std::size_t corner) {
      return mesh.points[mesh.faces.corners[i + corner]];
    };
    count +=
        (point (1) - point (0)).cross (point (2) - point (0)).dot (point (0)) > 0.0F
            ? 1
            : 0;
  }
  return count;
}

TEST (FaceWinding, TheFewAreTurnedAsTheMany)
{
  std::mt19937 random (1);
  for (const double part : {0.0, 0.05, 0.25}) {
    std::bernoulli_distribution coin (part);
    Mesh mesh = sphere ([&] { return coin (random); });
    const std::size_t all = mesh.faces.ends.size();
    const std::size_t wrong = all - outward (mesh);
    const FaceWinding winding = unifyWinding (mesh.view(), mesh.faces);
    EXPECT_EQ (winding.turned, wrong);
    EXPECT_EQ (winding.contradictory, 0U);
    EXPECT_EQ (outward (mesh), all);
  }
  // What agrees stays, whichever way it looks.
  Mesh inward = sphere ([] { return true; });
  EXPECT_EQ (unifyWinding (inward.view(), inward.faces).turned, 0U);
  EXPECT_EQ (outward (inward), 0U);
}

TEST (FaceWinding, WhereNobodyIsInTheMajorityItIsOutward)
{
  for (const unsigned seed : {1U, 2U, 3U}) {
    std::mt19937 random (seed);
    std::bernoulli_distribution coin (0.5);
    Mesh mesh = sphere ([&] { return coin (random); });
    unifyWinding (mesh.view(), mesh.faces);
    EXPECT_EQ (outward (mesh), mesh.faces.ends.size());
  }
}

TEST (FaceWinding, QuadsOfAStripAgreeButForAHalfTwist)
{
  constexpr int COUNT = 30;
  for (const bool twisted : {false, true}) {
    Mesh mesh;
    for (int i = 0; i < COUNT; ++i) {
      const double a = 2.0 * M_PI * i / COUNT;
      const double lean = twisted ? 0.5 * a : 0.0;
      const Eigen::Vector3d out (std::cos (a), std::sin (a), 0.0);
      const Eigen::Vector3d half =
          0.3 * (std::cos (lean) * Eigen::Vector3d::UnitZ() + std::sin (lean) * out);
      mesh.points.emplace_back ((out - half).cast<float>());
      mesh.points.emplace_back ((out + half).cast<float>());
    }
    for (int i = 0; i < COUNT; ++i) {
      const index_t a = 2 * i;
      index_t b = 2 * (i + 1) % (2 * COUNT);
      index_t c = b + 1;
      if (twisted && b == 0)
        std::swap (b, c);
      if (i == 5)
        mesh.add ({a, a + 1, c, b});
      else
        mesh.add ({a, b, c, a + 1});
    }
    const FaceWinding winding = unifyWinding (mesh.view(), mesh.faces);
    EXPECT_EQ (winding.contradictory, twisted ? 1U : 0U);
    if (!twisted) {
      EXPECT_EQ (winding.turned, 1U);
    }
  }
}

} // namespace
