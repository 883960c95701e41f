// SPDX-License-Identifier: BSD-3-Clause
// Upright solids over outlines in the plane.
#pragma once

#include "sharp_solids.h"

namespace oracle {

/** \brief Corners, counterclockwise; not closed by a copy of the first. */
using Outline = std::vector<Eigen::Vector2d>;

/** \brief Over an outline, convex or not, from z = 0 to the height. */
SharpSolid
prism (const std::string& name, const Outline& outline, double height);

/** \brief Whether a point is within. */
bool
contains (const Outline& outline, const Eigen::Vector2d& p);

/** \brief A wheel of radius 1 with teeth down to .8. */
Outline
gearOutline (int teeth);
/** \brief A pentagram of radius 1: five wedges of 36 degrees. */
Outline
starOutline ();
/** \brief What is within half a thickness of a line, its corners mitred. */
Outline
stripOutline (const std::vector<Eigen::Vector2d>& line, double thickness);

} // namespace oracle
