// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_crest/neighbor_search.h>

#include <pcl/search/kdtree.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

namespace pcl {
namespace crest {

NeighborSearch
kdTreeSearch (const OrientedPoints& points, const Parameters& parameters)
{
  const auto cloud = pcl::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
  cloud->reserve (points.size());
  for (const Eigen::Vector3f& p : points.positions)
    cloud->emplace_back (p.x(), p.y(), p.z());
  const auto tree = std::make_shared<pcl::search::KdTree<pcl::PointXYZ>> (false);
  if (!cloud->empty())
    tree->setInputCloud (cloud);
  return [tree, cloud, parameters] (index_t point, std::vector<index_t>& found) {
    findNeighbors<pcl::PointXYZ> (*tree, (*cloud)[point], parameters, found);
  };
}

} // namespace crest
} // namespace pcl
