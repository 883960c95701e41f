// SPDX-License-Identifier: BSD-3-Clause
#include "normals/normal_estimation.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <tuple>

namespace pcl {
namespace crest {

namespace {

/** \brief The distinct finite points of a cloud, moved and scaled to the unit box,
 * where single precision does no harm.
 */
struct DistinctPoints {
  std::vector<Eigen::Vector3f> positions;
  /** for each point of the cloud its place among them, or -1 */
  std::vector<index_t> of_point;
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  double scale = 1.0;

  Eigen::Vector3f
  fromCloud (const Eigen::Vector3f& position) const
  {
    return ((position.cast<double>() - center) * scale).cast<float>();
  }
};

DistinctPoints
takeDistinct (const PointView& cloud)
{
  DistinctPoints distinct;
  distinct.of_point.assign (cloud.size, -1);
  std::vector<index_t> finite;
  Eigen::AlignedBox3d box;
  for (std::size_t i = 0; i < cloud.size; ++i)
    if (cloud.positionOf (i).allFinite()) {
      finite.push_back (static_cast<index_t> (i));
      box.extend (cloud.positionOf (i).cast<double>());
    }
  if (finite.empty())
    return distinct;
  distinct.center = box.center();
  if (box.sizes().maxCoeff() > 0.0)
    distinct.scale = 1.0 / box.sizes().maxCoeff();

  const auto key = [&cloud] (index_t i) {
    const Eigen::Vector3f p = cloud.positionOf (static_cast<std::size_t> (i));
    return std::make_tuple (p.x(), p.y(), p.z());
  };
  std::stable_sort (finite.begin(), finite.end(), [&key] (index_t a, index_t b) {
    return key (a) < key (b);
  });
  for (std::size_t i = 0; i < finite.size(); ++i) {
    if (i == 0 || key (finite[i - 1]) != key (finite[i]))
      distinct.positions.push_back (distinct.fromCloud (cloud.positionOf (finite[i])));
    distinct.of_point[finite[i]] = static_cast<index_t> (distinct.positions.size()) - 1;
  }
  return distinct;
}

} // namespace

Orientation
estimateNormals (const PointView& cloud,
                 const std::optional<Eigen::Vector3f>& viewpoint,
                 bool organized,
                 const PointLibrary& library,
                 int k,
                 unsigned threads,
                 std::vector<Eigen::Vector3f>& normals)
{
  const DistinctPoints distinct = takeDistinct (cloud);
  Orientation orientation;
  if (distinct.positions.empty()) {
    normals.assign (cloud.size, Eigen::Vector3f::Zero());
    return orientation;
  }
  std::vector<Eigen::Vector3f> found;
  library.fit_planes (distinct.positions, k, threads, found);
  std::optional<Eigen::Vector3f> seen_from;
  if (viewpoint)
    seen_from = distinct.fromCloud (*viewpoint);
  orientation = orientNormals (
      distinct.positions, seen_from, organized, library.find_nearest, threads, found);
  normals.assign (cloud.size, Eigen::Vector3f::Zero());
  for (std::size_t i = 0; i < cloud.size; ++i)
    if (distinct.of_point[i] >= 0)
      normals[i] = found[distinct.of_point[i]];
  return orientation;
}

} // namespace crest
} // namespace pcl
