// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_crest/impl/crest_line_estimation.hpp>

#include <pcl/search/kdtree.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

namespace pcl {
namespace crest {

NeighborSearch
kdTreeSearch (const std::vector<Eigen::Vector3f>& points, int k, double radius)
{
  const auto cloud = pcl::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
  cloud->reserve (points.size());
  for (const Eigen::Vector3f& p : points)
    cloud->emplace_back (p.x(), p.y(), p.z());
  const auto tree = std::make_shared<pcl::search::KdTree<pcl::PointXYZ>> (false);
  if (!cloud->empty())
    tree->setInputCloud (cloud);
  return [tree, cloud, k, radius] (index_t point, std::vector<index_t>& found) {
    findNeighbors<pcl::PointXYZ> (*tree, (*cloud)[point], k, radius, found);
  };
}

} // namespace crest
} // namespace pcl
