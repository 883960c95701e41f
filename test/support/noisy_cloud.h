// SPDX-License-Identifier: BSD-3-Clause
// Samples as a scanner gives them: with noise, and normals that have to be estimated.
#pragma once

#include <pcl/features/normal_3d_omp.h>
#include <pcl/search/kdtree.h>

#include "analytic_surface.h"

#include <random>

namespace oracle {

/** \brief Adds normal noise to all coordinates; the normals stay. */
inline pcl::PointCloud<pcl::PointNormal>::Ptr
addNoise (const pcl::PointCloud<pcl::PointNormal>& exact,
          double standard_deviation,
          unsigned seed = 1)
{
  auto cloud = pcl::make_shared<pcl::PointCloud<pcl::PointNormal>> (exact);
  std::mt19937 random (seed);
  std::normal_distribution<double> noise (0.0, 1.0);
  for (pcl::PointNormal& point : *cloud)
    for (float& x : point.getVector3fMap())
      x += static_cast<float> (standard_deviation * noise (random));
  return cloud;
}

/** \brief Adds normal noise to all coordinates and replaces the normals by those of a
 * plane through 16 neighbours (PCA), on the side of the exact ones. The caller says how
 * large a spacing is, so that a noise is the same for all seeds of a surface.
 */
inline pcl::PointCloud<pcl::PointNormal>::Ptr
withNoise (const pcl::PointCloud<pcl::PointNormal>& exact,
           double standard_deviation,
           unsigned seed = 1)
{
  auto cloud = addNoise (exact, standard_deviation, seed);
  pcl::NormalEstimationOMP<pcl::PointNormal, pcl::Normal> estimation (2);
  estimation.setInputCloud (cloud);
  estimation.setKSearch (16);
  pcl::PointCloud<pcl::Normal> normals;
  estimation.compute (normals);
  for (std::size_t i = 0; i < cloud->size(); ++i) {
    const auto n = normals[i].getNormalVector3fMap();
    const bool same_side = n.dot (exact[i].getNormalVector3fMap()) >= 0.0F;
    (*cloud)[i].getNormalVector3fMap() = same_side ? n : (-n).eval();
  }
  return cloud;
}

} // namespace oracle
