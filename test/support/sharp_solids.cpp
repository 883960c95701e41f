// SPDX-License-Identifier: BSD-3-Clause
#include "sharp_solids.h"

#include <Eigen/Geometry>

#include "poisson_disks.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace oracle {

namespace {

using pcl::crest::CrestType;
using Polygon = std::vector<Eigen::Vector3d>;
constexpr double DEGREES = 180.0 / M_PI;

Eigen::Vector3d
normalOf (const Polygon& polygon)
{
  return (polygon[1] - polygon[0]).cross (polygon[2] - polygon[1]).normalized();
}

/** \brief A convex polygon, counterclockwise seen from outside. */
SolidFace
flatFace (const Polygon& polygon)
{
  Eigen::Vector3d normal = normalOf (polygon);
  const Eigen::Vector3d x = (polygon[1] - polygon[0]).normalized();
  const Eigen::Vector3d y = normal.cross (x);
  Eigen::Vector2d low (0.0, 0.0);
  Eigen::Vector2d high (0.0, 0.0);
  std::vector<Eigen::Vector2d> flat;
  for (const Eigen::Vector3d& vertex : polygon) {
    flat.emplace_back ((vertex - polygon[0]).dot (x), (vertex - polygon[0]).dot (y));
    low = low.cwiseMin (flat.back());
    high = high.cwiseMax (flat.back());
  }
  const Eigen::Vector3d origin = polygon[0] + low.x() * x + low.y() * y;
  const auto inside = [flat, low] (double u, double v) {
    const Eigen::Vector2d p = low + Eigen::Vector2d (u, v);
    for (std::size_t i = 0; i < flat.size(); ++i) {
      const Eigen::Vector2d side = flat[(i + 1) % flat.size()] - flat[i];
      const Eigen::Vector2d way = p - flat[i];
      if (side.x() * way.y() - side.y() * way.x() < 0.0)
        return false;
    }
    return true;
  };
  return {high.x() - low.x(),
          high.y() - low.y(),
          inside,
          [origin, x, y] (double u, double v) -> Eigen::Vector3d {
            return origin + u * x + v * y;
          },
          [normal] (double, double) { return normal; }};
}

/** \brief The solid of convex polygons that share their vertices where they meet. */
SharpSolid
polyhedron (const std::string& name, const std::vector<Polygon>& polygons)
{
  SharpSolid solid;
  solid.name = name;
  for (const Polygon& polygon : polygons)
    solid.faces.push_back (flatFace (polygon));
  const auto addEdge = [&] (const Polygon& one, std::size_t i, const Polygon& other) {
    const Eigen::Vector3d& a = one[i];
    const Eigen::Vector3d& b = one[(i + 1) % one.size()];
    const Eigen::Vector3d n = normalOf (one);
    const Eigen::Vector3d m = normalOf (other);
    if (n.dot (m) > 1.0 - 1e-9)
      return;
    // Convex where the other face turns away from the outside.
    const bool convex = n.cross (m).dot (b - a) > 0.0;
    solid.edges.push_back ({a,
                            b,
                            convex ? CrestType::RIDGE : CrestType::VALLEY,
                            std::acos (std::max (-1.0, n.dot (m))) * DEGREES});
  };
  const auto sharesSide =
      [] (const Polygon& polygon, const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
        for (std::size_t j = 0; j < polygon.size(); ++j)
          if (polygon[j].isApprox (b) && polygon[(j + 1) % polygon.size()].isApprox (a))
            return true;
        return false;
      };
  for (std::size_t p = 0; p < polygons.size(); ++p)
    for (std::size_t q = p + 1; q < polygons.size(); ++q)
      for (std::size_t i = 0; i < polygons[p].size(); ++i)
        if (sharesSide (
                polygons[q], polygons[p][i], polygons[p][(i + 1) % polygons[p].size()]))
          addEdge (polygons[p], i, polygons[q]);
  return solid;
}

/** \brief The sides of a prism over a profile in x and z, counterclockwise seen from
 * -y, of a width along y around 0.
 */
std::vector<Polygon>
prismSides (const std::vector<Eigen::Vector2d>& profile, double width)
{
  const auto at = [&] (std::size_t i, double y) {
    const Eigen::Vector2d& p = profile[i % profile.size()];
    return Eigen::Vector3d (p.x(), y, p.y());
  };
  const double y = 0.5 * width;
  std::vector<Polygon> sides;
  for (std::size_t i = 0; i < profile.size(); ++i)
    sides.push_back ({at (i, -y), at (i, y), at (i + 1, y), at (i + 1, -y)});
  return sides;
}

/** \brief The two ends of such a prism over a convex part of its profile. */
void
addEnds (const std::vector<Eigen::Vector2d>& part,
         double width,
         std::vector<Polygon>& polygons)
{
  const double y = 0.5 * width;
  Polygon front;
  Polygon back;
  for (const Eigen::Vector2d& p : part) {
    front.emplace_back (p.x(), -y, p.y());
    back.emplace_back (p.x(), y, p.y());
  }
  std::reverse (back.begin(), back.end());
  polygons.push_back (front);
  polygons.push_back (back);
}

double
areaOf (const SolidFace& face)
{
  constexpr int CELLS = 200;
  int inside = 0;
  for (int i = 0; i < CELLS; ++i)
    for (int j = 0; j < CELLS; ++j)
      if (face.inside (face.width * (i + 0.5) / CELLS, face.height * (j + 0.5) / CELLS))
        ++inside;
  return face.width * face.height * inside / (CELLS * CELLS);
}

double
areaOf (const SharpSolid& solid)
{
  double sum = 0.0;
  for (const SolidFace& face : solid.faces)
    sum += areaOf (face);
  return sum;
}

} // namespace

SharpSolid
box (double a, double b, double c)
{
  const std::vector<Eigen::Vector2d> profile{{-a / 2.0, -c / 2.0},
                                             {a / 2.0, -c / 2.0},
                                             {a / 2.0, c / 2.0},
                                             {-a / 2.0, c / 2.0}};
  std::vector<Polygon> polygons = prismSides (profile, b);
  addEnds (profile, b, polygons);
  return polyhedron ("box", polygons);
}

SharpSolid
lBracket (double size, double width, double thickness)
{
  const Eigen::Vector2d outer (0.0, 0.0);
  const Eigen::Vector2d inner (thickness, thickness);
  const Eigen::Vector2d right (size, 0.0);
  const Eigen::Vector2d right_top (size, thickness);
  const Eigen::Vector2d top (0.0, size);
  const Eigen::Vector2d top_right (thickness, size);
  std::vector<Polygon> polygons =
      prismSides ({outer, right, right_top, inner, top_right, top}, width);
  addEnds ({outer, right, right_top, inner}, width, polygons);
  addEnds ({outer, inner, top_right, top}, width, polygons);
  return polyhedron ("L-bracket", polygons);
}

SharpSolid
dodecahedron ()
{
  const double golden = (1.0 + std::sqrt (5.0)) / 2.0;
  std::vector<Eigen::Vector3d> vertices;
  for (const double x : {-1.0, 1.0})
    for (const double y : {-1.0, 1.0}) {
      for (const double z : {-1.0, 1.0})
        vertices.emplace_back (x, y, z);
      vertices.emplace_back (0.0, x / golden, y * golden);
      vertices.emplace_back (x / golden, y * golden, 0.0);
      vertices.emplace_back (y * golden, 0.0, x / golden);
    }
  std::vector<Polygon> polygons;
  for (const double a : {-1.0, 1.0})
    for (const double b : {-golden, golden})
      for (const Eigen::Vector3d& axis : {Eigen::Vector3d (a, 0.0, b),
                                          Eigen::Vector3d (b, a, 0.0),
                                          Eigen::Vector3d (0.0, b, a)}) {
        double farthest = 0.0;
        for (const Eigen::Vector3d& vertex : vertices)
          farthest = std::max (farthest, axis.dot (vertex));
        Polygon face;
        for (const Eigen::Vector3d& vertex : vertices)
          if (axis.dot (vertex) > farthest - 1e-9)
            face.push_back (vertex);
        const Eigen::Vector3d x = axis.cross (face[0]).normalized();
        const Eigen::Vector3d y = axis.normalized().cross (x);
        const auto turn = [&] (const Eigen::Vector3d& v) {
          return std::atan2 (v.dot (y), v.dot (x));
        };
        std::sort (face.begin(), face.end(), [&] (const auto& v, const auto& w) {
          return turn (v) < turn (w);
        });
        polygons.push_back (face);
      }
  return polyhedron ("dodecahedron", polygons);
}

SharpSolid
roundBar (double radius, double height)
{
  constexpr int PIECES = 256;
  SharpSolid solid;
  solid.name = "round bar";
  const double half = 0.5 * height;
  const auto radial = [] (double angle) {
    return Eigen::Vector3d (std::cos (angle), std::sin (angle), 0.0);
  };
  solid.faces.push_back ({2.0 * M_PI * radius,
                          height,
                          [] (double, double) { return true; },
                          [=] (double x, double y) -> Eigen::Vector3d {
                            return radius * radial (x / radius) +
                                   (y - half) * Eigen::Vector3d::UnitZ();
                          },
                          [=] (double x, double) { return radial (x / radius); }});
  for (const double side : {-1.0, 1.0}) {
    Eigen::Vector3d up = side * Eigen::Vector3d::UnitZ();
    solid.faces.push_back ({2.0 * radius,
                            2.0 * radius,
                            [=] (double x, double y) {
                              return std::hypot (x - radius, y - radius) < radius;
                            },
                            [=] (double x, double y) -> Eigen::Vector3d {
                              return Eigen::Vector3d (x - radius, y - radius, 0.0) +
                                     half * up;
                            },
                            [=] (double, double) { return up; }});
    for (int i = 0; i < PIECES; ++i)
      solid.edges.push_back (
          {radius * radial (2.0 * M_PI * i / PIECES) + half * up,
           radius * radial (2.0 * M_PI * (i + 1) / PIECES) + half * up,
           CrestType::RIDGE,
           90.0});
  }
  return solid;
}

SharpSolid
wedge (double angle, pcl::crest::CrestType type)
{
  const double slope = 0.5 * angle / DEGREES;
  const double up = type == CrestType::RIDGE ? -1.0 : 1.0;
  const Eigen::Vector3d right (std::cos (slope), 0.0, up * std::sin (slope));
  const Eigen::Vector3d left (-right.x(), 0.0, right.z());
  const Eigen::Vector3d along = Eigen::Vector3d::UnitY();
  const Eigen::Vector3d middle = -0.5 * along;
  const auto face = [&] (const Eigen::Vector3d& away) {
    Polygon square{middle, middle + away, middle + away + along, middle + along};
    if (normalOf (square).z() < 0.0)
      std::reverse (square.begin(), square.end());
    return square;
  };
  return polyhedron ("wedge", {face (right), face (left)});
}

pcl::PointCloud<pcl::PointNormal>::Ptr
sample (const SharpSolid& solid, std::size_t count, unsigned seed)
{
  std::vector<double> shares;
  for (const SolidFace& face : solid.faces)
    shares.push_back (face.width * face.height);
  std::mt19937 random (seed);
  std::discrete_distribution<std::size_t> any_face (shares.begin(), shares.end());
  std::uniform_real_distribution<double> unit (0.0, 1.0);

  PoissonDisks disks (areaOf (solid), count);
  auto cloud = pcl::make_shared<pcl::PointCloud<pcl::PointNormal>>();
  for (std::size_t thrown = 0; thrown < 30 * count;) {
    const SolidFace& face = solid.faces[any_face (random)];
    const double x = face.width * unit (random);
    const double y = face.height * unit (random);
    if (!face.inside (x, y))
      continue;
    ++thrown;
    const Eigen::Vector3d p = face.position (x, y);
    if (!disks.take (p))
      continue;
    pcl::PointNormal point;
    point.getVector3fMap() = p.cast<float>();
    point.getNormalVector3fMap() = face.normal (x, y).cast<float>();
    cloud->push_back (point);
  }
  return cloud;
}

pcl::PointCloud<pcl::PointNormal>::Ptr
sampleOnGrids (const SharpSolid& solid, std::size_t count)
{
  const double step = std::sqrt (areaOf (solid) / static_cast<double> (count));
  auto cloud = pcl::make_shared<pcl::PointCloud<pcl::PointNormal>>();
  for (const SolidFace& face : solid.faces) {
    const int columns =
        std::max (1, static_cast<int> (std::lround (face.width / step)));
    const int rows = std::max (1, static_cast<int> (std::lround (face.height / step)));
    for (int i = 0; i < columns; ++i)
      for (int j = 0; j < rows; ++j) {
        const double x = face.width * (i + 0.5) / columns;
        const double y = face.height * (j + 0.5) / rows;
        if (!face.inside (x, y))
          continue;
        pcl::PointNormal point;
        point.getVector3fMap() = face.position (x, y).cast<float>();
        point.getNormalVector3fMap() = face.normal (x, y).cast<float>();
        cloud->push_back (point);
      }
  }
  return cloud;
}

std::vector<TruthSegment>
trueCrestLines (const SharpSolid& solid)
{
  std::vector<TruthSegment> truth;
  // Lines are scored by the middles of the segments: these have to be short.
  constexpr double LONGEST = 0.004;
  for (const SharpEdge& edge : solid.edges) {
    const double angle = edge.angle / DEGREES;
    const double sharpness = 32.0 / (9.0 * angle * angle);
    const Eigen::Vector3d along = edge.b - edge.a;
    const int pieces = static_cast<int> (std::ceil (along.norm() / LONGEST));
    for (int i = 0; i < pieces; ++i)
      truth.push_back ({edge.a + along * i / pieces,
                        edge.a + along * (i + 1) / pieces,
                        edge.type,
                        1.0,
                        sharpness});
  }
  return truth;
}

} // namespace oracle
