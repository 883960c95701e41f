// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <map>
#include <random>
#include <vector>

namespace oracle {

struct TriangleMesh {
  std::vector<Eigen::Vector3f> points;
  /** counter-clockwise from outside */
  std::vector<std::array<int, 3>> triangles;
};

/** \brief A unit sphere from a cube whose faces are grids of n x n squares, its points
 * in random order, so that a reader that sorts or splits them is found out.
 */
inline TriangleMesh
cubeSphere (int n)
{
  std::map<std::array<int, 3>, int> index_of;
  TriangleMesh mesh;
  const auto pointAt = [&] (const std::array<int, 3>& lattice) {
    const auto [place, is_new] =
        index_of.emplace (lattice, static_cast<int> (mesh.points.size()));
    if (is_new)
      mesh.points.push_back (
          (Eigen::Vector3f (lattice[0], lattice[1], lattice[2]) * (2.0F / n) -
           Eigen::Vector3f::Ones())
              .normalized());
    return place->second;
  };
  for (int axis = 0; axis < 3; ++axis)
    for (const int side : {0, n})
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
          const auto corner = [&] (int di, int dj) {
            std::array<int, 3> lattice{};
            lattice[axis] = side;
            lattice[(axis + 1) % 3] = i + di;
            lattice[(axis + 2) % 3] = j + dj;
            return pointAt (lattice);
          };
          std::array<int, 4> c{
              corner (0, 0), corner (1, 0), corner (1, 1), corner (0, 1)};
          if (side == 0)
            std::swap (c[1], c[3]);
          mesh.triangles.push_back ({c[0], c[1], c[2]});
          mesh.triangles.push_back ({c[0], c[2], c[3]});
        }
  std::vector<int> place (mesh.points.size());
  for (std::size_t i = 0; i < place.size(); ++i)
    place[i] = static_cast<int> (i);
  std::shuffle (place.begin(), place.end(), std::mt19937 (7));
  TriangleMesh shuffled = mesh;
  for (std::size_t i = 0; i < place.size(); ++i)
    shuffled.points[place[i]] = mesh.points[i];
  for (std::array<int, 3>& triangle : shuffled.triangles)
    for (int& corner : triangle)
      corner = place[corner];
  return shuffled;
}

} // namespace oracle
