// SPDX-License-Identifier: BSD-3-Clause
// Solids of cubes on a lattice.
#pragma once

#include "sharp_solids.h"

namespace oracle {

/** \brief Which cells of the lattice are filled. No two of them may touch at an edge
 * without one that shares a face with both.
 */
using CellFilling = std::function<bool (const Eigen::Vector3i& cell)>;

/** \brief The faces of the filled cells from `low` to before `high`. Cells that are
 * filled beyond these have no faces and hide those beside them, so that the surface is
 * open there.
 * \param[in] side of a cell
 */
SharpSolid
cellSolid (const std::string& name,
           const CellFilling& filled,
           const Eigen::Vector3i& low,
           const Eigen::Vector3i& high,
           double side);

/** \brief A cube of 5 cells a side and side 1, with four square holes through it along
 * each axis, which cross each other: 81 cells.
 */
SharpSolid
piercedCube ();
/** \brief 16 blocks of 3 x 3 cells and different heights, with streets of 2 cells
 * between; open below and at the sides.
 */
SharpSolid
city ();

} // namespace oracle
