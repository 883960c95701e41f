// SPDX-License-Identifier: BSD-3-Clause
// The edge of a flat face, whatever it ends at.
#pragma once

#include "base/scatter.h"

#include <optional>

namespace pcl {
namespace crest {

/** \brief The edge of a flat face; lengths and the origin are those of the points. */
struct FaceEnd {
  /** point of the edge nearest to the origin */
  Eigen::Vector3d foot;
  /** unit vectors: along the edge; in the middle of the normals of the face and of what
   * it ends at */
  Eigen::Vector3d direction;
  Eigen::Vector3d normal;
  /** between these two normals, in degrees */
  double angle;
  /** whether the surface goes down from the face */
  bool convex;
  /** mean squared distance from the face's plane of the points on it, and of all that
   * are near */
  double of_face;
  double of_all;
};

/** \brief The edge of the flat face that a sample is part of, where that ends within a
 * spacing of the sample and the surface goes on to one side of it. Two planes do not
 * show the edges of holes and pins that are a few spacings wide, as nothing flat is
 * beyond them.
 *
 * \param[in] positions of the neighbours, from the sample, in spacings
 *
 * \param[in] own the normal of the sample, which has to be that of the face
 */
std::optional<FaceEnd>
fitFaceEnd (const Coordinates& positions, const Eigen::Vector3d& own);

} // namespace crest
} // namespace pcl
