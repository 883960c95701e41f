// SPDX-License-Identifier: BSD-3-Clause
#include "correlated_noise.h"

#include <pcl/search/kdtree.h>

#include <cmath>
#include <random>

namespace oracle {

std::vector<Eigen::Vector3f>
correlatedNoise (const pcl::PointCloud<pcl::PointNormal>& samples,
                 double spread,
                 unsigned seed)
{
  std::mt19937 random (seed);
  std::normal_distribution<float> noise (0.0F, 1.0F);
  std::vector<Eigen::Vector3f> rough (samples.size());
  for (Eigen::Vector3f& value : rough)
    for (float& x : value)
      x = noise (random);

  pcl::search::KdTree<pcl::PointNormal> tree;
  tree.setInputCloud (samples.makeShared());
  std::vector<Eigen::Vector3f> smooth (rough.size());
#pragma omp parallel for schedule(dynamic, 256)
  for (std::size_t i = 0; i < rough.size(); ++i) {
    pcl::Indices found;
    std::vector<float> squared;
    tree.radiusSearch (samples[i], 2.5 * spread, found, squared);
    Eigen::Vector3f sum = Eigen::Vector3f::Zero();
    float squares = 0.0F;
    for (std::size_t j = 0; j < found.size(); ++j) {
      const auto weight =
          static_cast<float> (std::exp (-squared[j] / (2.0 * spread * spread)));
      sum += weight * rough[found[j]];
      squares += weight * weight;
    }
    smooth[i] = sum / std::sqrt (squares);
  }
  return smooth;
}

} // namespace oracle
