// SPDX-License-Identifier: BSD-3-Clause
// A flat face of a solid in its plane.
#pragma once

#include "sharp_solids.h"

namespace oracle {

struct FlatFace {
  SolidFace face;
  /** where the rectangle of the face begins, and its unit axes */
  Eigen::Vector3d origin, x, y;
  Eigen::Vector3d normal;

  explicit FlatFace (const SolidFace& flat)
  : face (flat)
  , origin (flat.position (0.0, 0.0))
  , x (flat.position (1.0, 0.0) - origin)
  , y (flat.position (0.0, 1.0) - origin)
  , normal (flat.normal (0.0, 0.0))
  {}

  /** \brief Whether a point of the plane is on the face. */
  bool
  contains (const Eigen::Vector3d& p) const
  {
    const double u = (p - origin).dot (x);
    const double v = (p - origin).dot (y);
    return u >= 0.0 && u <= face.width && v >= 0.0 && v <= face.height &&
           face.inside (u, v);
  }
};

} // namespace oracle
