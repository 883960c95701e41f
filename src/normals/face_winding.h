// SPDX-License-Identifier: BSD-3-Clause
// Faces that run around the same way as their neighbours.
#pragma once

#include "normals/face_normals.h"

namespace pcl {
namespace crest {

/** \brief What was wrong with the order of corners. */
struct FaceWinding {
  /** faces whose corners were put in the opposite order */
  std::size_t turned = 0;
  /** edges between two faces that no order makes agree, as on a Moebius strip */
  std::size_t contradictory = 0;
};

/** \brief Makes the order of corners agree over all edges that two faces share: both
 * run along it in opposite directions. In each body that edges connect the few faces
 * are turned, not the many; where these are nearly as few, and no edge is open, those
 * that run clockwise seen from outside.
 *
 * \param[in] cloud only its positions are used
 * \param[in,out] faces whose corners are points of the cloud
 */
PCL_CREST_EXPORT FaceWinding
unifyWinding (const PointView& cloud, Faces& faces);

} // namespace crest
} // namespace pcl
