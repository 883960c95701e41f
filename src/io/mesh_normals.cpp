// SPDX-License-Identifier: BSD-3-Clause
#include "mesh_normals.h"

#include <Eigen/Geometry>

namespace pcl {
namespace crest {

std::size_t
computeMeshNormals (FileContent& content)
{
  pcl::PointCloud<pcl::PointNormal>& points = *content.points;
  const Faces& faces = content.faces;
  const auto position = [&] (std::size_t corner) -> Eigen::Vector3d {
    return points[faces.corners[corner]].getVector3fMap().cast<double>();
  };
  std::vector<Eigen::Vector3d> sums (points.size(), Eigen::Vector3d::Zero());
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
  std::size_t with_normal = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3d normal = sums[i].stableNormalized();
    points[i].getNormalVector3fMap() = normal.cast<float>();
    if (!normal.isZero (0.0))
      ++with_normal;
  }
  return with_normal;
}

} // namespace crest
} // namespace pcl
