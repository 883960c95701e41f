// SPDX-License-Identifier: BSD-3-Clause
#include "sampling.h"

#include "support/correlated_noise.h"
#include "support/noisy_cloud.h"

#include <cmath>
#include <functional>
#include <random>

namespace accuracy {

namespace {

using Cloud = pcl::PointCloud<pcl::PointNormal>;

Samples
keepIf (const Samples& all, const std::function<bool (const pcl::PointNormal&)>& keep)
{
  Samples kept{pcl::make_shared<Cloud>(), {}, 0.0};
  for (std::size_t i = 0; i < all.cloud->size(); ++i)
    if (keep ((*all.cloud)[i])) {
      kept.cloud->push_back ((*all.cloud)[i]);
      kept.parameters.push_back (all.parameters[i]);
    }
  return kept;
}

Samples
sampleEvenly (const oracle::AnalyticSurface& surface, std::size_t count, unsigned seed)
{
  Samples samples;
  samples.cloud = oracle::sample (surface, count, seed, &samples.parameters);
  return samples;
}

} // namespace

const std::vector<std::string>&
samplingNames ()
{
  static const std::vector<std::string> names{
      "even", "density", "scan_lines", "correlated", "exact_normals"};
  return names;
}

Samples
sampleAs (const std::string& sampling,
          const oracle::AnalyticSurface& surface,
          std::size_t count,
          unsigned seed)
{
  Samples samples;
  if (sampling == "density") {
    // What is kept of x from 0 to 1 is the integral of 10^-x, .39, if even.
    const Samples all = sampleEvenly (surface, count * 5 / 2, seed);
    float low = (*all.cloud)[0].x;
    float high = low;
    for (const pcl::PointNormal& p : *all.cloud) {
      low = std::min (low, p.x);
      high = std::max (high, p.x);
    }
    std::mt19937 random (seed + 9);
    std::uniform_real_distribution<double> chance (0.0, 1.0);
    samples = keepIf (all, [&] (const pcl::PointNormal& p) {
      return chance (random) < std::pow (10.0, -(p.x - low) / (high - low));
    });
  }
  else if (sampling == "scan_lines") {
    const Samples all = sampleEvenly (surface, count * 4, seed);
    const double period = 4.0 * oracle::meanSpacing (*all.cloud);
    samples = keepIf (all, [&] (const pcl::PointNormal& p) {
      const double place = p.x / period;
      return place - std::floor (place) < 0.25;
    });
  }
  else
    samples = sampleEvenly (surface, count, seed);
  samples.spacing = oracle::meanSpacing (*samples.cloud);
  return samples;
}

Cloud::Ptr
scan (const Cloud& exact, const Scan& how)
{
  Cloud::Ptr cloud;
  if (how.spread > 0.0) {
    Cloud moved = exact;
    const std::vector<Eigen::Vector3f> noise =
        oracle::correlatedNoise (exact, how.spread, how.seed);
    for (std::size_t i = 0; i < moved.size(); ++i)
      moved[i].getVector3fMap() += static_cast<float> (how.noise) * noise[i];
    cloud = oracle::withNoise (moved, 0.0);
  }
  else
    cloud = oracle::withNoise (exact, how.noise, how.seed);
  if (how.exact_normals)
    for (std::size_t i = 0; i < cloud->size(); ++i)
      (*cloud)[i].getNormalVector3fMap() = exact[i].getNormalVector3fMap();
  return cloud;
}

} // namespace accuracy
