// SPDX-License-Identifier: BSD-3-Clause
// Paper, section 3: how a surface bends.
#pragma once

#include <Eigen/Core>

namespace pcl {
namespace crest {

/** \brief The principal curvatures at a point, in 1 / (the cloud's unit).
 *
 * k1 is the larger in absolute value (section 3). Curvature is positive where the
 * surface is convex seen from the side that the normal points to, so that ridges are
 * positive with outward normals. t1 is the unit direction of k1 in the tangent plane;
 * its sign means nothing.
 */
struct PrincipalCurvature {
  float k1;
  float k2;
  Eigen::Vector3f t1;
  /** false where the surface around the point does not determine them; k1 and k2 are
   * then 0 */
  bool valid;
};

} // namespace crest
} // namespace pcl
