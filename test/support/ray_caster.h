// SPDX-License-Identifier: BSD-3-Clause
// What the rays of a sensor meet first.
#pragma once

#include "sharp_solids.h"

#include <functional>
#include <limits>

namespace oracle {

/** \brief Where a ray meets a surface, by the distance in its unit. */
struct Hit {
  /** infinite where there is nothing */
  double distance = std::numeric_limits<double>::infinity();
  /** of unit length, to either side */
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
};

/** \brief The first hit of the ray from an origin in a direction of unit length. */
using RayCaster = std::function<Hit (const Eigen::Vector3d& origin,
                                     const Eigen::Vector3d& direction)>;

/** \brief The points x of a plane: normal . x = offset. */
struct Plane {
  Eigen::Vector3d normal;
  double offset;
};

/** \brief Planes without end before the sensor, of which the nearest along each ray is
 * seen, or the farthest, as in the corner of a room.
 */
RayCaster
castPlanes (const std::vector<Plane>& planes, bool nearest = true);

/** \brief A solid whose faces are all flat; they are seen from both sides. */
RayCaster
castSolid (const SharpSolid& solid);

/** \brief A surface (u, v, z (u, v)), none of whose features is narrower than a
 * hundredth; seen from both sides.
 */
RayCaster
castHeightField (const AnalyticSurface& surface);

} // namespace oracle
