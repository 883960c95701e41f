// SPDX-License-Identifier: BSD-3-Clause
#include "meshes/triangulation.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <utility>

namespace pcl {
namespace crest {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/** \brief A corner of a polygon that is left. */
struct Corner {
  index_t point;
  /** in the plane of the polygon, which runs counter-clockwise there */
  Vector2d position;
};

/** \brief Twice the area of a triangle, negative where it runs clockwise. */
double
signedArea (const Vector2d& a, const Vector2d& b, const Vector2d& c)
{
  const Vector2d u = b - a;
  const Vector2d v = c - a;
  return u.x() * v.y() - u.y() * v.x();
}

std::vector<Corner>
flatten (const PointView& cloud, const index_t* corners, std::size_t count)
{
  const auto position = [&] (std::size_t i) -> Vector3d {
    return cloud.positionOf (static_cast<std::size_t> (corners[i])).cast<double>();
  };
  Vector3d normal = Vector3d::Zero();
  for (std::size_t i = 1; i + 1 < count; ++i)
    normal += (position (i) - position (0)).cross (position (i + 1) - position (0));
  const Vector3d u = normal.unitOrthogonal();
  const Vector3d v = normal.stableNormalized().cross (u);
  std::vector<Corner> flat;
  for (std::size_t i = 0; i < count; ++i) {
    const Vector3d step = position (i) - position (0);
    flat.push_back ({corners[i], {u.dot (step), v.dot (step)}});
  }
  return flat;
}

/** \brief Whether the triangle of a corner and the two beside it can be cut off. */
bool
isEar (const std::vector<Corner>& polygon, std::size_t at)
{
  const std::size_t count = polygon.size();
  const Corner& before = polygon[(at + count - 1) % count];
  const Corner& own = polygon[at];
  const Corner& after = polygon[(at + 1) % count];
  if (!(signedArea (before.position, own.position, after.position) > 0.0))
    return false;
  return std::none_of (polygon.begin(), polygon.end(), [&] (const Corner& other) {
    return other.point != before.point && other.point != own.point &&
           other.point != after.point &&
           signedArea (before.position, own.position, other.position) >= 0.0 &&
           signedArea (own.position, after.position, other.position) >= 0.0 &&
           signedArea (after.position, before.position, other.position) >= 0.0;
  });
}

void
cutEars (std::vector<Corner> polygon, Faces& triangles)
{
  std::size_t at = 0;
  std::size_t tried = 0;
  while (polygon.size() > 3) {
    const std::size_t count = polygon.size();
    at %= count;
    if (tried < count && !isEar (polygon, at)) {
      ++tried;
      ++at;
      continue;
    }
    triangles.corners.insert (triangles.corners.end(),
                              {polygon[(at + count - 1) % count].point,
                               polygon[at].point,
                               polygon[(at + 1) % count].point});
    triangles.close();
    polygon.erase (polygon.begin() + static_cast<std::ptrdiff_t> (at));
    tried = 0;
    ++at;
  }
  for (const Corner& corner : polygon)
    triangles.corners.push_back (corner.point);
  triangles.close();
}

/** \brief The triangles without those that are there before. */
Faces
withoutRepeated (const Faces& triangles)
{
  using Key = std::pair<std::array<index_t, 3>, std::size_t>;
  std::vector<Key> keys;
  keys.reserve (triangles.size());
  for (std::size_t face = 0; face < triangles.size(); ++face) {
    const index_t* const corner = &triangles.corners[3 * face];
    keys.push_back ({{corner[0], corner[1], corner[2]}, face});
    std::sort (keys.back().first.begin(), keys.back().first.end());
  }
  std::sort (keys.begin(), keys.end());
  const auto end =
      std::unique (keys.begin(), keys.end(), [] (const Key& a, const Key& b) {
        return a.first == b.first;
      });
  std::vector<std::size_t> kept;
  for (auto key = keys.begin(); key != end; ++key)
    kept.push_back (key->second);
  std::sort (kept.begin(), kept.end());
  Faces single;
  for (const std::size_t face : kept) {
    for (std::size_t i = 0; i < 3; ++i)
      single.corners.push_back (triangles.corners[3 * face + i]);
    single.close();
  }
  return single;
}

} // namespace

Faces
triangulate (const PointView& cloud, const Faces& faces)
{
  Faces triangles;
  for (std::size_t face = 0; face < faces.size(); ++face) {
    const index_t* const corners = &faces.corners[faces.begin (face)];
    const std::size_t count = faces.ends[face] - faces.begin (face);
    if (count > 3) {
      cutEars (flatten (cloud, corners, count), triangles);
      continue;
    }
    triangles.corners.insert (triangles.corners.end(), corners, corners + count);
    triangles.close();
  }
  return withoutRepeated (triangles);
}

} // namespace crest
} // namespace pcl
