// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl/kdtree/kdtree_flann.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <Eigen/Core>

#include <tuple>
#include <vector>

namespace pcl {
namespace crest {

/** \brief An edge that a sign can be carried along. */
struct NormalEdge {
  /** 0 where the normals agree but for the sign */
  float weight;
  index_t a;
  index_t b;
  /** whether one of the normals has to be turned */
  bool opposite;

  bool
  operator<(const NormalEdge& other) const
  {
    return std::tie (weight, a, b) < std::tie (other.weight, other.a, other.b);
  }
};

/** \brief The graph of nearest neighbours of points with normals. */
class NormalEdges {
public:
  explicit NormalEdges (const pcl::PointCloud<pcl::PointXYZ>& points);

  /** \brief The edges from some points to their nearest neighbours, the surest first.
   * \param[in] normals of all points, of unit length or zero
   * \param[in] from which points
   * \param[in] threads 0 for all processors
   * \param[out] areas how much of the surface each of these stands for, up to a
   * factor: the squared distance to the last of the neighbours
   */
  std::vector<NormalEdge>
  find (const std::vector<Eigen::Vector3f>& normals,
        const std::vector<index_t>& from,
        unsigned threads,
        std::vector<double>& areas) const;

  /** How many neighbours. */
  static constexpr int NEIGHBORS = 12;

private:
  const pcl::PointCloud<pcl::PointXYZ>& points_;
  pcl::KdTreeFLANN<pcl::PointXYZ> tree_;
};

} // namespace crest
} // namespace pcl
