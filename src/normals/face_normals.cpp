// SPDX-License-Identifier: BSD-3-Clause
#include "normals/face_normals.h"

#include <Eigen/Geometry>

namespace pcl {
namespace crest {

std::vector<Eigen::Vector3f>
faceNormals (const PointView& cloud, const Faces& faces)
{
  const auto position = [&] (std::size_t corner) -> Eigen::Vector3d {
    return cloud.positionOf (static_cast<std::size_t> (faces.corners[corner]))
        .cast<double>();
  };
  std::vector<Eigen::Vector3d> sums (cloud.size, Eigen::Vector3d::Zero());
  std::size_t first = 0;
  for (const std::size_t end : faces.ends) {
    // Newell's normal of a polygon, which need not be plane: as long as twice its area.
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();
    for (std::size_t i = first + 1; i + 1 < end; ++i)
      normal +=
          (position (i) - position (first)).cross (position (i + 1) - position (first));
    if (normal.allFinite())
      for (std::size_t i = first; i < end; ++i)
        sums[faces.corners[i]] += normal;
    first = end;
  }
  std::vector<Eigen::Vector3f> normals;
  normals.reserve (cloud.size);
  for (const Eigen::Vector3d& sum : sums)
    normals.emplace_back (sum.stableNormalized().cast<float>());
  return normals;
}

} // namespace crest
} // namespace pcl
