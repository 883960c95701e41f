// SPDX-License-Identifier: BSD-3-Clause
// The solids that estimated normals are measured on, against areas and volumes that
// their faces know nothing of.
#include <gtest/gtest.h>

#include "support/prisms.h"
#include "support/solid_clouds.h"

#include <cmath>
#include <map>
#include <random>
#include <sstream>

namespace {

struct Measures {
  double area, volume;
};

/** \brief By the shoelace formula. */
Measures
ofPrism (const oracle::Outline& outline, double height)
{
  double end = 0.0;
  double around = 0.0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Eigen::Vector2d& a = outline[i];
    const Eigen::Vector2d& b = outline[(i + 1) % outline.size()];
    end += 0.5 * (a.x() * b.y() - a.y() * b.x());
    around += (b - a).norm();
  }
  return {2.0 * end + around * height, end * height};
}

/** \brief A strip of height 1 has as much area as its middle line is long. */
Measures
ofSheet (double length, double thickness)
{
  return {2.0 * length * thickness + 2.0 * (length + thickness), length * thickness};
}

Measures
ofPlate (double t)
{
  return {2.0 + 4.0 * t, t};
}

/** \brief Of the closed solids, with h as it came out. */
Measures
measuresOf (const std::string& name, double h)
{
  const double edge = std::sqrt (5.0) - 1.0;
  const std::map<std::string, Measures> of_fixed{
      {"dodecahedron",
       {3.0 * std::sqrt (25.0 + 10.0 * std::sqrt (5.0)) * edge * edge,
        (15.0 + 7.0 * std::sqrt (5.0)) / 4.0 * edge * edge * edge}},
      // Sides of cells: 21 outside on each side, 4 of each of 54 beams, of which 72 are
      // outside.
      {"cube with holes", {(6 * 21 + 4 * 54 - 72) / 25.0, 81.0 / 125.0}},
      {"gear", ofPrism (oracle::gearOutline (24), 0.4)},
      {"star", ofPrism (oracle::starOutline(), 0.4)},
      {"three bodies",
       {2.0 * M_PI * 0.4 * (1.0 + 0.4) + 2.0 * (0.8 + 0.6 + 0.48) + 2.0 * 0.36 +
            4.0 * 0.8,
        M_PI * 0.16 + 0.48 + 0.36 * 0.8}},
      {"torus", {4.0 * M_PI * M_PI * 0.4, 2.0 * M_PI * M_PI * 0.16}},
      {"hollow sphere", {4.0 * M_PI * (1.0 + 0.36), 4.0 / 3.0 * M_PI * (1.0 - 0.216)}},
      {"channel of 4 h", ofSheet (3.0, 4.0 * h)},
      {"zigzag of 5 h", ofSheet (4.0 * std::hypot (0.4, 0.5), 5.0 * h)}};
  const auto fixed = of_fixed.find (name);
  if (fixed != of_fixed.end())
    return fixed->second;
  std::istringstream words (name);
  std::string plate, of;
  double spacings = 0.0;
  words >> plate >> of >> spacings;
  return ofPlate (spacings * h);
}

/** \brief How often samples of even areas wind around a point: 1 in the material. */
double
windingNumber (const pcl::PointCloud<pcl::PointNormal>& cloud,
               double area,
               const Eigen::Vector3f& place)
{
  double sum = 0.0;
  for (const pcl::PointNormal& p : cloud) {
    const Eigen::Vector3d way = (p.getVector3fMap() - place).cast<double>();
    sum += way.dot (p.getNormalVector3fMap().cast<double>()) / std::pow (way.norm(), 3);
  }
  return sum * area / (4.0 * M_PI * static_cast<double> (cloud.size()));
}

std::vector<oracle::NamedSolid>
closedSolids ()
{
  std::vector<oracle::NamedSolid> closed;
  for (const oracle::NamedSolid& solid : oracle::namedSolids())
    if (solid.closed)
      closed.push_back (solid);
  return closed;
}

} // namespace

class Solids : public testing::TestWithParam<oracle::NamedSolid> {};

TEST_P (Solids, LookAwayFromTheMaterial)
{
  const oracle::SolidCloud solid = GetParam().sample (1);
  const Measures exact = measuresOf (GetParam().name, solid.spacing);
  // By the divergence theorem, of (x, y, z) and of constants.
  double volume = 0.0;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const pcl::PointNormal& p : *solid.cloud) {
    EXPECT_NEAR (p.getNormalVector3fMap().norm(), 1.0, 1e-5);
    sum += p.getNormalVector3fMap().cast<double>();
    volume += p.getVector3fMap().dot (p.getNormalVector3fMap()) / 3.0;
  }
  const double share = exact.area / static_cast<double> (solid.cloud->size());
  // Within what a surface that is some hundredths of h off encloses: disks lie a little
  // less densely along edges.
  EXPECT_NEAR (share * volume, exact.volume, 0.06 * solid.spacing * exact.area);
  EXPECT_LT (sum.norm() * share, 0.01 * exact.area);

  // No further from the surface than the thinnest plate is thick.
  constexpr int PROBES = 100;
  std::mt19937 random (1);
  int inside = 0;
  int outside = 0;
  for (int i = 0; i < PROBES; ++i) {
    const pcl::PointNormal& p = (*solid.cloud)[random() % solid.cloud->size()];
    const Eigen::Vector3f step =
        static_cast<float> (0.5 * solid.spacing) * p.getNormalVector3fMap();
    inside += windingNumber (*solid.cloud, exact.area, p.getVector3fMap() - step) > 0.5;
    outside +=
        windingNumber (*solid.cloud, exact.area, p.getVector3fMap() + step) < 0.5;
  }
  EXPECT_GE (inside, 95);
  EXPECT_GE (outside, 95);
}

INSTANTIATE_TEST_SUITE_P (Closed, Solids, testing::ValuesIn (closedSolids()));
