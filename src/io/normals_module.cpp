// SPDX-License-Identifier: BSD-3-Clause
#include "io/normals_module.h"

#include <pcl/common/point_tests.h>
#include <pcl/features/normal_3d_omp.h>
#include <pcl/kdtree/kdtree_flann.h>

namespace pcl {
namespace crest {

namespace {

pcl::PointCloud<pcl::PointXYZ>::Ptr
cloudOf (const std::vector<Eigen::Vector3f>& points)
{
  auto cloud = pcl::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
  cloud->reserve (points.size());
  for (const Eigen::Vector3f& p : points)
    cloud->emplace_back (p.x(), p.y(), p.z());
  return cloud;
}

void
fitPlanes (const std::vector<Eigen::Vector3f>& points,
           int k,
           unsigned threads,
           std::vector<Eigen::Vector3f>& normals)
{
  pcl::NormalEstimationOMP<pcl::PointXYZ, pcl::Normal> estimation (threads);
  estimation.setInputCloud (cloudOf (points));
  estimation.setKSearch (k);
  pcl::PointCloud<pcl::Normal> estimated;
  estimation.compute (estimated);
  normals.assign (points.size(), Eigen::Vector3f::Zero());
  for (std::size_t i = 0; i < estimated.size(); ++i)
    if (pcl::isNormalFinite (estimated[i]))
      normals[i] = estimated[i].getNormalVector3fMap().stableNormalized();
}

NearestSearch
findNearest (const std::vector<Eigen::Vector3f>& points, int k)
{
  const auto cloud = cloudOf (points);
  const auto tree = std::make_shared<pcl::KdTreeFLANN<pcl::PointXYZ>>();
  tree->setInputCloud (cloud);
  return [cloud, tree, k] (index_t point,
                           std::vector<index_t>& found,
                           std::vector<float>& distances) {
    tree->nearestKSearch ((*cloud)[point], k, found, distances);
  };
}

} // namespace

} // namespace crest
} // namespace pcl

void
pcl_crest_normal_library (pcl::crest::PointLibrary& library)
{
  library = {pcl::crest::fitPlanes, pcl::crest::findNearest};
}
