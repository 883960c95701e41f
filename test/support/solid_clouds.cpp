// SPDX-License-Identifier: BSD-3-Clause
#include "solid_clouds.h"

#include "benchmark_surfaces.h"
#include "cell_solids.h"
#include "prisms.h"

#include <cmath>
#include <sstream>
#include <utility>

namespace oracle {

namespace {

constexpr std::size_t USUAL_COUNT = 40000;

SolidCloud
withSpacing (const pcl::PointCloud<pcl::PointNormal>::Ptr& cloud,
             std::vector<SharpEdge> edges)
{
  return {cloud, std::move (edges), meanSpacing (*cloud)};
}

NamedSolid
sharp (const SharpSolid& solid, bool is_closed, std::size_t count = USUAL_COUNT)
{
  return {solid.name, is_closed, [=] (unsigned seed) {
            return withSpacing (sample (solid, count, seed), solid.edges);
          }};
}

NamedSolid
smooth (const AnalyticSurface& surface, bool is_closed)
{
  return {surface.name, is_closed, [=] (unsigned seed) {
            return withSpacing (sample (surface, USUAL_COUNT, seed), {});
          }};
}

/** \brief A solid that is so many h thick, whatever h comes to for that thickness. */
NamedSolid
thin (const std::string& name,
      double spacings,
      const std::function<SharpSolid (double thickness)>& make)
{
  return {name, true, [=] (unsigned seed) {
            SolidCloud result;
            // Of two sides of a unit square, nearly.
            result.spacing = std::sqrt (2.0 / USUAL_COUNT);
            constexpr int ROUNDS = 3;
            for (int round = 0; round < ROUNDS; ++round) {
              const SharpSolid solid = make (spacings * result.spacing);
              result = withSpacing (sample (solid, USUAL_COUNT, seed), solid.edges);
            }
            return result;
          }};
}

NamedSolid
plate (double spacings)
{
  std::ostringstream name;
  name << "plate of " << spacings << " h";
  return thin (name.str(), spacings, [] (double thickness) {
    return box (1.0, 1.0, thickness);
  });
}

/** \brief A sheet bent along the corners of a line. */
NamedSolid
bentSheet (const std::string& name,
           double spacings,
           const std::vector<Eigen::Vector2d>& line)
{
  return thin (name, spacings, [=] (double thickness) {
    return prism (name, stripOutline (line, thickness), 1.0);
  });
}

/** \brief Solids beside each other along x, none of them larger than 1. */
SharpSolid
inARow (const std::string& name, const std::vector<SharpSolid>& solids)
{
  SharpSolid all;
  all.name = name;
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();
  for (const SharpSolid& solid : solids) {
    for (SolidFace face : solid.faces) {
      face.position = [old = face.position, offset] (double x, double y) {
        return Eigen::Vector3d (old (x, y) + offset);
      };
      all.faces.push_back (face);
    }
    for (SharpEdge edge : solid.edges) {
      edge.a += offset;
      edge.b += offset;
      all.edges.push_back (edge);
    }
    offset.x() += 1.5;
  }
  return all;
}

/** \brief From a latitude on to the pole. */
AnalyticSurface
sphereFrom (double latitude, double radius)
{
  AnalyticSurface surface = sphere (radius);
  surface.v_min = latitude;
  surface.v_max = 0.5 * M_PI;
  return surface;
}

AnalyticSurface
named (const std::string& name, AnalyticSurface surface)
{
  surface.name = name;
  return surface;
}

/** \brief Of radius 1 with a cavity of .6. */
SolidCloud
sampleHollowSphere (unsigned seed)
{
  constexpr double INNER = 0.6;
  constexpr double OUTER_SHARE = 1.0 / (1.0 + INNER * INNER);
  const auto shell = [&] (double radius, double share) {
    return sample (sphereFrom (-0.5 * M_PI, radius),
                   static_cast<std::size_t> (share * USUAL_COUNT),
                   seed);
  };
  auto cloud = shell (1.0, OUTER_SHARE);
  auto cavity = shell (INNER, 1.0 - OUTER_SHARE);
  for (pcl::PointNormal& point : *cavity)
    point.getNormalVector3fMap() *= -1.0F;
  *cloud += *cavity;
  return withSpacing (cloud, {});
}

std::vector<NamedSolid>
makeAll ()
{
  std::vector<NamedSolid> all{
      sharp (dodecahedron(), true, 100000),
      sharp (piercedCube(), true),
      sharp (prism ("gear", gearOutline (24), 0.4), true),
      sharp (prism ("star", starOutline(), 0.4), true),
      sharp (
          inARow ("three bodies",
                  {roundBar (0.4, 1.0), box (1.0, 0.8, 0.6), lBracket (1.0, 0.8, 0.2)}),
          true),
      smooth (torus (1.0, 0.4), true),
      {"hollow sphere", true, sampleHollowSphere},
      bentSheet (
          "channel of 4 h", 4.0, {{-0.5, 1.0}, {-0.5, 0.0}, {0.5, 0.0}, {0.5, 1.0}}),
      bentSheet ("zigzag of 5 h",
                 5.0,
                 {{0.0, 0.0}, {0.4, 0.5}, {0.8, 0.0}, {1.2, 0.5}, {1.6, 0.0}})};
  for (const double spacings : {1.0, 1.5, 2.0, 3.0, 4.0, 6.0})
    all.push_back (plate (spacings));
  all.push_back (smooth (named ("terrain", crossingRidges()), false));
  all.push_back (smooth (named ("hemisphere", sphereFrom (0.0, 1.0)), false));
  all.push_back (sharp (city(), false));
  return all;
}

} // namespace

const std::vector<NamedSolid>&
namedSolids ()
{
  static const std::vector<NamedSolid> all = makeAll();
  return all;
}

} // namespace oracle
