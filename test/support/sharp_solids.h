// SPDX-License-Identifier: BSD-3-Clause
// Solids with sharp edges, which are known exactly.
#pragma once

#include "crest_truth.h"

namespace oracle {

/** \brief A face that can be unrolled into the plane: points of the rectangle
 * [0, width] x [0, height] that are inside, mapped without stretching.
 */
struct SolidFace {
  double width, height;
  std::function<bool (double x, double y)> inside;
  std::function<Eigen::Vector3d (double x, double y)> position;
  /** outward */
  std::function<Eigen::Vector3d (double x, double y)> normal;
};

/** \brief A piece of a sharp edge. Ridges are convex, valleys concave edges. */
struct SharpEdge {
  Eigen::Vector3d a, b;
  pcl::crest::CrestType type;
  /** between the normals of the two faces, in degrees */
  double angle;
};

struct SharpSolid {
  std::string name;
  std::vector<SolidFace> faces;
  std::vector<SharpEdge> edges;
};

/** \brief Sides a, b, c: 12 ridges, 8 corners. A plate where one is small. */
SharpSolid
box (double a, double b, double c);
/** \brief Two plates at a right angle: 17 ridges and one valley, whose two ends are
 * ends of two ridges each.
 */
SharpSolid
lBracket (double size, double width, double thickness);
/** \brief 30 ridges of 63 degrees, 20 corners. */
SharpSolid
dodecahedron ();
/** \brief A round bar: two closed rims of 90 degrees. */
SharpSolid
roundBar (double radius, double height);
/** \brief Two unit squares that meet at an edge along y in the origin, where the
 * surface turns by an angle in degrees; a ridge, or a valley. The other sides are open.
 */
SharpSolid
wedge (double angle, pcl::crest::CrestType type);

/** \brief About `count` points spread evenly at random (Poisson disks), with exact
 * normals. The same seed gives the same cloud.
 */
pcl::PointCloud<pcl::PointNormal>::Ptr
sample (const SharpSolid& solid, std::size_t count, unsigned seed = 1);

/** \brief About `count` points on a square grid of each face, half a step from its
 * rectangle's sides, with exact normals.
 */
pcl::PointCloud<pcl::PointNormal>::Ptr
sampleOnGrids (const SharpSolid& solid, std::size_t count);

/** \brief The edges as truth to score lines by, in short pieces; an edge is as sharp as
 * a crest across which the surface turns by its angle.
 */
std::vector<TruthSegment>
trueCrestLines (const SharpSolid& solid);

} // namespace oracle
