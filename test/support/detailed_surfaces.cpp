// SPDX-License-Identifier: BSD-3-Clause
#include "detailed_surfaces.h"

#include <Eigen/Geometry>

#include "surface_formula.h"

#include <cmath>

namespace oracle {

namespace {

template <typename Formula>
AnalyticSurface
square (const std::string& name, Formula height)
{
  return make (name, 0.0, DETAIL_SIDE, 0.0, DETAIL_SIDE, [height] (auto u, auto v) {
    using T = decltype (u);
    return std::array<T, 3>{u, v, height (u, v)};
  });
}

/** \brief A train of waves of height 1 that runs in a direction in degrees. */
template <typename T>
T
train (const T& u, const T& v, double wavelength, double direction, double phase)
{
  const double angle = direction * PI / 180.0;
  return sin (2.0 * PI / wavelength * (std::cos (angle) * u + std::sin (angle) * v) +
              phase);
}

std::string
named (const std::string& what, double wavelength)
{
  return what + " of " + std::to_string (std::lround (wavelength)) + " h";
}

double
areaOf (const AnalyticSurface& surface)
{
  constexpr int CELLS = 400;
  const double step = DETAIL_SIDE / CELLS;
  double area = 0.0;
  for (int i = 0; i < CELLS; ++i)
    for (int j = 0; j < CELLS; ++j) {
      const Derivatives d = surface.derivatives ((i + 0.5) * step, (j + 0.5) * step);
      area += d.d[1][0].cross (d.d[0][1]).norm() * step * step;
    }
  return area;
}

} // namespace

AnalyticSurface
windingWaves (double wavelength)
{
  return square (named ("waves", wavelength), [wavelength] (auto u, auto v) {
    using T = decltype (u);
    const T across = u + sin (2.0 * PI / 40.0 * v);
    return T (0.08 * wavelength * sin (2.0 * PI / wavelength * across));
  });
}

AnalyticSurface
crossingWaves (double wavelength)
{
  return square (named ("crossing waves", wavelength), [wavelength] (auto u, auto v) {
    using T = decltype (u);
    return T (0.07 * wavelength *
              (train (u, v, wavelength, 20.0, 0.0) +
               0.7 * train (u, v, wavelength, 95.0, 1.0)));
  });
}

AnalyticSurface
waveMixture ()
{
  return square ("wave mixture", [] (auto u, auto v) {
    using T = decltype (u);
    return T (0.03 *
              (4.0 * train (u, v, 4.0, 10.0, 0.0) + 5.0 * train (u, v, 5.0, 75.0, 1.0) +
               6.0 * train (u, v, 6.0, 140.0, 2.0) +
               8.0 * train (u, v, 8.0, 40.0, 3.0) +
               12.0 * train (u, v, 12.0, 110.0, 4.0)));
  });
}

pcl::PointCloud<pcl::PointNormal>::Ptr
sampleOneApart (const AnalyticSurface& surface,
                unsigned seed,
                std::vector<Eigen::Vector2d>& parameters)
{
  // Of Poisson disks, for the mean distance to the 6 nearest; measured on a plane.
  constexpr double SAMPLES_OF_UNIT_SQUARE = 1.0;
  const double area = areaOf (surface);
  return sample (surface,
                 static_cast<std::size_t> (SAMPLES_OF_UNIT_SQUARE * area),
                 seed,
                 &parameters);
}

} // namespace oracle
