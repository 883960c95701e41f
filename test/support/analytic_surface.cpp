// SPDX-License-Identifier: BSD-3-Clause
#include "analytic_surface.h"

#include <pcl/search/kdtree.h>

#include <Eigen/Geometry>

#include "poisson_disks.h"
#include "surface_formula.h"

#include <array>
#include <cmath>
#include <random>

namespace oracle {

AnalyticSurface
sphere (double radius)
{
  return makeRadial (
      "sphere", 1.5, [radius] (auto x, auto, auto) { return 0.0 * x + radius; });
}

AnalyticSurface
plane ()
{
  return make ("plane", -1.0, 1.0, -1.0, 1.0, [] (auto u, auto v) {
    using T = decltype (u);
    return std::array<T, 3>{u, v, 0.0 * u};
  });
}

AnalyticSurface
cylinder (double radius)
{
  return make ("cylinder", -PI, PI, -1.0, 1.0, [radius] (auto u, auto v) {
    using T = decltype (u);
    return std::array<T, 3>{radius * cos (u), radius * sin (u), v};
  });
}

AnalyticSurface
torus (double large_radius, double small_radius)
{
  return make ("torus", -PI, PI, -PI, PI, [=] (auto u, auto v) {
    using T = decltype (u);
    const T r = large_radius + small_radius * cos (v);
    return std::array<T, 3>{r * cos (u), r * sin (u), small_radius * sin (v)};
  });
}

AnalyticSurface
ellipsoid (double a, double b, double c)
{
  return make ("ellipsoid", -PI, PI, -1.45, 1.45, [=] (auto u, auto v) {
    using T = decltype (u);
    return std::array<T, 3>{a * cos (u) * cos (v), b * sin (u) * cos (v), c * sin (v)};
  });
}

AnalyticSurface
wavyRidge ()
{
  return make ("wavy ridge", -1.0, 1.0, -0.8, 0.8, [] (auto u, auto v) {
    using T = decltype (u);
    const T across = v - 0.25 * sin (3.0 * u);
    return std::array<T, 3>{u, v, 0.18 * exp (-across * across / (2.0 * 0.12 * 0.12))};
  });
}

AnalyticSurface
bumpySphere ()
{
  return makeRadial ("bumpy sphere", 1.3, [] (auto x, auto y, auto z) {
    const auto bump = [] (auto across, auto along) {
      return 0.25 * exp (-across * across / (2.0 * 0.1 * 0.1) -
                         along * along / (2.0 * 0.3 * 0.3));
    };
    return 1.0 + bump (x, y) + bump (y, z) + bump (z, x);
  });
}

AnalyticSurface
roundedBox ()
{
  return makeRadial ("rounded box", 1.3, [] (auto x, auto y, auto z) {
    const auto sixth_power = [] (auto a) { return a * a * a * a * a * a; };
    return exp (-log (sixth_power (x) + sixth_power (y) + sixth_power (z)) / 6.0);
  });
}

AnalyticSurface
ellipticTorus ()
{
  return make ("elliptic torus", -PI, PI, -PI, PI, [] (auto u, auto v) {
    using T = decltype (u);
    const T r = 1.0 + 0.22 * cos (v);
    return std::array<T, 3>{r * cos (u), r * sin (u), 0.42 * sin (v)};
  });
}

AnalyticSurface
ridgeAndValley ()
{
  return make ("ridge and valley", -1.0, 1.0, -0.9, 0.9, [] (auto u, auto v) {
    using T = decltype (u);
    const T from_ridge = v - 0.4 - 0.08 * cos (3.0 * u);
    const T from_valley = v + 0.35 + 0.12 * sin (2.5 * u);
    const T z =
        0.16 * exp (-from_ridge * from_ridge / (2.0 * 0.10 * 0.10)) -
        (0.14 + 0.05 * u) * exp (-from_valley * from_valley / (2.0 * 0.13 * 0.13));
    return std::array<T, 3>{u, v, z};
  });
}

Eigen::Vector3d
unitNormal (const AnalyticSurface& surface, double u, double v)
{
  const Derivatives x = surface.derivatives (u, v);
  return x.d[1][0].cross (x.d[0][1]).normalized();
}

pcl::PointCloud<pcl::PointNormal>::Ptr
sample (const AnalyticSurface& surface,
        std::size_t count,
        unsigned seed,
        std::vector<Eigen::Vector2d>* parameters)
{
  std::mt19937 random (seed);
  std::uniform_real_distribution<double> in_u (surface.u_min, surface.u_max);
  std::uniform_real_distribution<double> in_v (surface.v_min, surface.v_max);
  const auto areaElement = [&] (double u, double v) {
    constexpr double STEP = 1e-4;
    const Eigen::Vector3d along_u =
        surface.position (u + STEP, v) - surface.position (u - STEP, v);
    const Eigen::Vector3d along_v =
        surface.position (u, v + STEP) - surface.position (u, v - STEP);
    return along_u.cross (along_v).norm() / (4.0 * STEP * STEP);
  };

  double largest = 0.0;
  double mean = 0.0;
  constexpr int PROBES = 20000;
  for (int i = 0; i < PROBES; ++i) {
    const double element = areaElement (in_u (random), in_v (random));
    largest = std::max (largest, element);
    mean += element / PROBES;
  }
  const double area =
      mean * (surface.u_max - surface.u_min) * (surface.v_max - surface.v_min);
  PoissonDisks disks (area, count);

  auto cloud = pcl::make_shared<pcl::PointCloud<pcl::PointNormal>>();
  std::uniform_real_distribution<double> in_area (0.0, largest);
  for (std::size_t thrown = 0; thrown < 30 * count;) {
    const double u = in_u (random);
    const double v = in_v (random);
    if (areaElement (u, v) < in_area (random))
      continue;
    ++thrown;
    const Eigen::Vector3d p = surface.position (u, v);
    if (!disks.take (p))
      continue;
    pcl::PointNormal point;
    point.getVector3fMap() = p.cast<float>();
    point.getNormalVector3fMap() = unitNormal (surface, u, v).cast<float>();
    cloud->push_back (point);
    if (parameters != nullptr)
      parameters->emplace_back (u, v);
  }
  return cloud;
}

double
meanSpacing (const pcl::PointCloud<pcl::PointNormal>& cloud)
{
  pcl::search::KdTree<pcl::PointNormal> tree;
  tree.setInputCloud (cloud.makeShared());
  pcl::Indices found;
  std::vector<float> squared;
  double sum = 0.0;
  for (const pcl::PointNormal& point : cloud) {
    tree.nearestKSearch (point, 7, found, squared);
    for (std::size_t i = 1; i < squared.size(); ++i)
      sum += std::sqrt (squared[i]) / 6.0;
  }
  return sum / static_cast<double> (cloud.size());
}

} // namespace oracle
