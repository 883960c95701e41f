// SPDX-License-Identifier: BSD-3-Clause
#include "normal_estimation.h"

#include <pcl/common/point_tests.h>

#include <Eigen/Geometry>

#include "load_modules.h"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace pcl {
namespace crest {

namespace {

/** \brief The distinct finite points of a cloud, moved and scaled to the unit box,
 * where the single precision of pcl::NormalEstimation does no harm.
 */
struct Samples {
  pcl::PointCloud<pcl::PointXYZ>::Ptr points{new pcl::PointCloud<pcl::PointXYZ>};
  /** for each point of the cloud its sample, or -1 */
  std::vector<index_t> of_point;
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  double scale = 1.0;

  Eigen::Vector3f
  fromCloud (const Eigen::Vector3f& position) const
  {
    return ((position.cast<double>() - center) * scale).cast<float>();
  }
};

Samples
takeSamples (const pcl::PointCloud<pcl::PointNormal>& cloud)
{
  Samples samples;
  samples.of_point.assign (cloud.size(), -1);
  pcl::Indices finite;
  Eigen::AlignedBox3d box;
  for (std::size_t i = 0; i < cloud.size(); ++i)
    if (pcl::isXYZFinite (cloud[i])) {
      finite.push_back (static_cast<index_t> (i));
      box.extend (cloud[i].getVector3fMap().cast<double>());
    }
  if (finite.empty())
    return samples;
  samples.center = box.center();
  if (box.sizes().maxCoeff() > 0.0)
    samples.scale = 1.0 / box.sizes().maxCoeff();

  const auto key = [&cloud] (index_t i) {
    return std::make_tuple (cloud[i].x, cloud[i].y, cloud[i].z);
  };
  std::stable_sort (finite.begin(), finite.end(), [&key] (index_t a, index_t b) {
    return key (a) < key (b);
  });
  for (std::size_t i = 0; i < finite.size(); ++i) {
    if (i == 0 || key (finite[i - 1]) != key (finite[i])) {
      pcl::PointXYZ sample;
      sample.getVector3fMap() = samples.fromCloud (cloud[finite[i]].getVector3fMap());
      samples.points->push_back (sample);
    }
    samples.of_point[finite[i]] = static_cast<index_t> (samples.points->size()) - 1;
  }
  return samples;
}

} // namespace

Orientation
estimateNormals (FileContent& content, int k, unsigned threads)
{
  pcl::PointCloud<pcl::PointNormal>& cloud = *content.points;
  const Samples samples = takeSamples (cloud);
  std::vector<Eigen::Vector3f> normals (samples.points->size(),
                                        Eigen::Vector3f::Zero());
  Orientation orientation;
  if (!normals.empty()) {
    pcl::PointCloud<pcl::Normal> estimated;
    loadNormalEstimator() (samples.points, k, threads, estimated);
    for (std::size_t i = 0; i < estimated.size(); ++i)
      if (pcl::isNormalFinite (estimated[i]))
        normals[i] = estimated[i].getNormalVector3fMap().stableNormalized();
    std::optional<Eigen::Vector3f> viewpoint;
    if (content.viewpoint)
      viewpoint = samples.fromCloud (*content.viewpoint);
    orientation =
        orientNormals (*samples.points, viewpoint, cloud.height > 1, threads, normals);
  }
  for (std::size_t i = 0; i < cloud.size(); ++i)
    cloud[i].getNormalVector3fMap() = samples.of_point[i] < 0
                                          ? Eigen::Vector3f (Eigen::Vector3f::Zero())
                                          : normals[samples.of_point[i]];
  return orientation;
}

} // namespace crest
} // namespace pcl
