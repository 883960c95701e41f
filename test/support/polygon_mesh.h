// SPDX-License-Identifier: BSD-3-Clause
// Meshes of a few large faces.
#pragma once

#include <pcl_crest/input.h>

#include "meshes/faces.h"

#include <cmath>
#include <vector>

namespace oracle {

struct PolygonMesh {
  std::vector<Eigen::Vector3f> points;
  pcl::crest::Faces faces;

  void
  add (const std::vector<pcl::crest::index_t>& corners)
  {
    faces.corners.insert (faces.corners.end(), corners.begin(), corners.end());
    faces.close();
  }

  pcl::crest::PointView
  view () const
  {
    return {points.front().data(), nullptr, 3, points.size()};
  }
};

/** \brief An outline in the plane z = 0, counter-clockwise, drawn up to a height: two
 * caps of all its corners, and a rectangle for each side.
 */
inline PolygonMesh
extruded (const std::vector<Eigen::Vector2f>& outline, float height)
{
  PolygonMesh mesh;
  const auto count = static_cast<pcl::crest::index_t> (outline.size());
  for (const float z : {0.0F, height})
    for (const Eigen::Vector2f& p : outline)
      mesh.points.emplace_back (p.x(), p.y(), z);
  std::vector<pcl::crest::index_t> bottom;
  std::vector<pcl::crest::index_t> top;
  for (pcl::crest::index_t i = 0; i < count; ++i) {
    const pcl::crest::index_t next = (i + 1) % count;
    mesh.add ({i, next, next + count, i + count});
    bottom.push_back (count - 1 - i);
    top.push_back (count + i);
  }
  mesh.add (bottom);
  mesh.add (top);
  return mesh;
}

inline PolygonMesh
cuboid (float a, float b, float c)
{
  return extruded ({{0, 0}, {a, 0}, {a, b}, {0, b}}, c);
}

inline PolygonMesh
lProfile ()
{
  return extruded ({{0, 0}, {4, 0}, {4, 1}, {1, 1}, {1, 3}, {0, 3}}, 10);
}

/** \brief A tessellated cylinder of radius 1. */
inline PolygonMesh
cylinder (int facets, float height)
{
  std::vector<Eigen::Vector2f> outline;
  for (int i = 0; i < facets; ++i) {
    const double angle = 2.0 * M_PI * i / facets;
    outline.emplace_back (static_cast<float> (std::cos (angle)),
                          static_cast<float> (std::sin (angle)));
  }
  return extruded (outline, height);
}

} // namespace oracle
