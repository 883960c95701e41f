// SPDX-License-Identifier: BSD-3-Clause
#include "sensors.h"

#include "correlated_noise.h"
#include "noisy_cloud.h"

#include <random>

namespace oracle {

using Cloud = pcl::PointCloud<pcl::PointNormal>;

namespace {

/** \brief Without what is within balls around samples at random. */
Cloud
withHoles (const Cloud& cloud, double radius, double part, unsigned seed)
{
  pcl::search::KdTree<pcl::PointNormal> tree;
  tree.setInputCloud (cloud.makeShared());
  std::mt19937 random (seed);
  std::uniform_int_distribution<std::size_t> any (0, cloud.size() - 1);
  std::vector<bool> is_lost (cloud.size(), false);
  const auto most =
      static_cast<std::size_t> (part * static_cast<double> (cloud.size()));
  pcl::Indices found;
  std::vector<float> squared;
  for (std::size_t lost = 0; lost < most;) {
    tree.radiusSearch (cloud[any (random)], radius, found, squared);
    for (const pcl::index_t i : found) {
      lost += is_lost[static_cast<std::size_t> (i)] ? 0 : 1;
      is_lost[static_cast<std::size_t> (i)] = true;
    }
  }
  Cloud left;
  for (std::size_t i = 0; i < cloud.size(); ++i)
    if (!is_lost[i])
      left.push_back (cloud[i]);
  return left;
}

} // namespace

Cloud
accumulatedFrames (const Cloud& exact,
                   int frames,
                   double standard_deviation,
                   unsigned seed)
{
  std::mt19937 random (seed);
  std::normal_distribution<double> noise (0.0, standard_deviation);
  Cloud cloud;
  for (int frame = 0; frame < frames; ++frame)
    for (pcl::PointNormal point : exact) {
      for (float& x : point.getVector3fMap())
        x += static_cast<float> (noise (random));
      cloud.push_back (point);
    }
  return cloud;
}

Cloud
registeredScans (const Cloud& first,
                 const Cloud& second,
                 const Eigen::Vector3d& apart,
                 double standard_deviation,
                 unsigned seed)
{
  Cloud both = first;
  both += second;
  const Eigen::Vector3f half = (0.5 * apart).cast<float>();
  for (std::size_t i = 0; i < both.size(); ++i)
    both[i].getVector3fMap() += i < first.size() ? half : -half;
  return *addNoise (both, standard_deviation, seed);
}

Cloud
photogrammetry (const Cloud& exact, const Photogrammetry& how, unsigned seed)
{
  const double h = meanSpacing (exact);
  const std::vector<Eigen::Vector3f> noise =
      correlatedNoise (exact, 0.5 * how.correlation_length * h, seed);
  Cloud cloud = exact;
  for (std::size_t i = 0; i < cloud.size(); ++i)
    cloud[i].getVector3fMap() +=
        static_cast<float> (how.correlated_noise * h) * noise[i];
  return withHoles (*addNoise (cloud, how.own_noise * h, seed),
                    how.hole_radius * h,
                    how.part_in_holes,
                    seed);
}

} // namespace oracle
