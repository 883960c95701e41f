// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_crest/impl/neighbor_search.hpp>

#include <pcl/search/kdtree.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

namespace pcl {
namespace crest {

NeighborSearch
kdTreeSearch (const OrientedPoints& points, const Parameters& parameters)
{
  const double scale = points.extent > 0.0 ? 1.0 / points.extent : 1.0;
  const auto cloud = pcl::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
  cloud->reserve (points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto p = static_cast<index_t> (i);
    const Eigen::Vector3f q = (scale * points.edge (0, p)).cast<float>();
    cloud->emplace_back (q.x(), q.y(), q.z());
  }
  const auto tree = std::make_shared<pcl::search::KdTree<pcl::PointXYZ>> (false);
  if (!cloud->empty())
    tree->setInputCloud (cloud);
  return [tree, cloud, k = parameters.k, radius = parameters.radius * scale] (
             index_t point, std::vector<index_t>& found) {
    findNeighbors<pcl::PointXYZ> (*tree, (*cloud)[point], k, radius, found);
  };
}

} // namespace crest
} // namespace pcl
