// SPDX-License-Identifier: BSD-3-Clause
#include "cell_solids.h"

#include <Eigen/Geometry>

namespace oracle {

namespace {

using Eigen::Vector3d;
using Eigen::Vector3i;
using pcl::crest::CrestType;

/** \brief The cell's side that looks along the axis in a direction, 1 or -1. */
SolidFace
faceOf (const Vector3i& cell, int axis, int direction, double side)
{
  Vector3d normal = direction * Vector3d::Unit (axis);
  const Vector3d x = Vector3d::Unit ((axis + 1) % 3);
  const Vector3d y = Vector3d::Unit ((axis + 2) % 3);
  Vector3d origin = side * cell.cast<double>();
  if (direction > 0)
    origin += side * normal;
  return {side,
          side,
          [] (double, double) { return true; },
          [origin, x, y] (double u, double v) -> Vector3d {
            return origin + u * x + v * y;
          },
          [normal] (double, double) { return normal; }};
}

/** \brief Appends the edge of the cell's origin along the axis, if it is one. */
void
addEdge (const CellFilling& filled,
         const Vector3i& cell,
         int axis,
         double side,
         std::vector<SharpEdge>& edges)
{
  const Vector3i x = Vector3i::Unit ((axis + 1) % 3);
  const Vector3i y = Vector3i::Unit ((axis + 2) % 3);
  int around = 0;
  for (const Vector3i& one : {cell, Vector3i (cell - x)})
    for (const Vector3i& other : {one, Vector3i (one - y)})
      around += filled (other) ? 1 : 0;
  if (around != 1 && around != 3)
    return;
  const Vector3d a = side * cell.cast<double>();
  edges.push_back ({a,
                    a + side * Vector3d::Unit (axis),
                    around == 1 ? CrestType::RIDGE : CrestType::VALLEY,
                    90.0});
}

} // namespace

SharpSolid
cellSolid (const std::string& name,
           const CellFilling& filled,
           const Vector3i& low,
           const Vector3i& high,
           double side)
{
  SharpSolid solid;
  solid.name = name;
  // The last planes of edges are the origins of cells one further.
  for (int i = low.x(); i <= high.x(); ++i)
    for (int j = low.y(); j <= high.y(); ++j)
      for (int k = low.z(); k <= high.z(); ++k) {
        const Vector3i cell (i, j, k);
        const bool has_faces = (cell.array() < high.array()).all() && filled (cell);
        for (int axis = 0; axis < 3; ++axis) {
          addEdge (filled, cell, axis, side, solid.edges);
          for (const int direction : {-1, 1})
            if (has_faces && !filled (cell + direction * Vector3i::Unit (axis)))
              solid.faces.push_back (faceOf (cell, axis, direction, side));
        }
      }
  return solid;
}

SharpSolid
piercedCube ()
{
  constexpr int CELLS = 5;
  const auto filled = [] (const Vector3i& cell) {
    int odd = 0;
    for (const int place : cell) {
      if (place < 0 || place >= CELLS)
        return false;
      odd += place % 2;
    }
    return odd < 2;
  };
  return cellSolid ("cube with holes",
                    filled,
                    Vector3i::Zero(),
                    Vector3i::Constant (CELLS),
                    1.0 / CELLS);
}

SharpSolid
city ()
{
  constexpr int STREET = 2;
  constexpr int PERIOD = STREET + 3;
  constexpr int WIDTH = 4 * PERIOD + STREET;
  constexpr int TALLEST = 6;
  const auto filled = [] (const Vector3i& cell) {
    if (cell.z() < 0)
      return true;
    const auto isBuilt = [] (int place) {
      return place >= 0 && place < WIDTH && place % PERIOD >= STREET;
    };
    if (!isBuilt (cell.x()) || !isBuilt (cell.y()))
      return false;
    const int block = cell.x() / PERIOD + 4 * (cell.y() / PERIOD);
    return cell.z() < 1 + 7 * block % TALLEST;
  };
  return cellSolid ("city", filled, {0, 0, -1}, {WIDTH, WIDTH, TALLEST}, 1.0 / WIDTH);
}

} // namespace oracle
