// SPDX-License-Identifier: BSD-3-Clause
#include "meshes/triangle_shapes.h"

#include <Eigen/Geometry>

#include <algorithm>

namespace pcl {
namespace crest {

namespace {

using Eigen::Vector3d;

Vector3d
cornerOf (const PointView& cloud, const Faces& triangles, std::size_t corner)
{
  return cloud.positionOf (static_cast<std::size_t> (triangles.corners[corner]))
      .cast<double>();
}

/** \brief Of each triangle the one across its longest side; -1 where there is not one.
 */
std::vector<index_t>
acrossLongestSides (const PointView& cloud,
                    const Faces& triangles,
                    const EdgeTable& edges)
{
  std::vector<index_t> across (triangles.size(), -1);
  forEachEdge (edges, [&] (index_t smaller, const FaceEdge* edge, std::size_t sides) {
    if (sides != 2)
      return;
    const double length =
        (cloud.positionOf (smaller).cast<double>() -
         cloud.positionOf (static_cast<std::size_t> (edge->larger)).cast<double>())
            .norm();
    for (const std::size_t own : {0U, 1U})
      if (length >=
          longestSide (cloud, triangles, static_cast<std::size_t> (edge[own].face)))
        across[edge[own].face] = edge[1 - own].face;
  });
  return across;
}

} // namespace

double
longestSide (const PointView& cloud, const Faces& triangles, std::size_t triangle)
{
  double longest = 0.0;
  for (std::size_t i = 0; i < 3; ++i)
    longest = std::max (longest,
                        (cornerOf (cloud, triangles, 3 * triangle + i) -
                         cornerOf (cloud, triangles, 3 * triangle + (i + 1) % 3))
                            .norm());
  return longest;
}

double
extentOf (const PointView& cloud, const Faces& triangles)
{
  Eigen::AlignedBox3f box;
  for (const index_t corner : triangles.corners)
    box.extend (cloud.positionOf (static_cast<std::size_t> (corner)));
  return box.isEmpty() ? 0.0 : box.diagonal().cast<double>().norm();
}

TriangleShapes
measureTriangles (const PointView& cloud,
                  const Faces& triangles,
                  const EdgeTable& edges)
{
  // Corners are rounded to a twentieth of this, so that normals err by three degrees.
  constexpr double NARROW = 1e-5;
  constexpr int MOST_NEEDLES_ABREAST = 8;
  const double narrow = NARROW * extentOf (cloud, triangles);
  TriangleShapes shapes;
  std::vector<std::size_t> needles;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const Vector3d a = cornerOf (cloud, triangles, 3 * i);
    const Vector3d twice = (cornerOf (cloud, triangles, 3 * i + 1) - a)
                               .cross (cornerOf (cloud, triangles, 3 * i + 2) - a);
    const double length = twice.stableNorm();
    shapes.areas.push_back (0.5 * length);
    shapes.normals.push_back (Vector3d::Zero());
    if (length > narrow * longestSide (cloud, triangles, i))
      shapes.normals.back() = twice / length;
    else
      needles.push_back (i);
  }
  if (needles.empty())
    return shapes;
  const std::vector<index_t> across = acrossLongestSides (cloud, triangles, edges);
  for (int round = 0; round < MOST_NEEDLES_ABREAST; ++round)
    for (const std::size_t needle : needles)
      if (shapes.normals[needle].isZero (0.0) && across[needle] >= 0)
        shapes.normals[needle] = shapes.normals[across[needle]];
  return shapes;
}

} // namespace crest
} // namespace pcl
