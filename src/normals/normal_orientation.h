// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "normals/normal_edges.h"

#include <optional>

namespace pcl {
namespace crest {

/** \brief How the sides of the connected parts of a cloud were decided. */
struct Orientation {
  /** all toward the viewpoint, as the cloud was seen from there alone */
  bool single_view = false;
  /** else the numbers of parts */
  std::size_t outward = 0;
  std::size_t toward_viewpoint = 0;
  std::size_t upward = 0;
};

/** \brief Turns normals to one side of the surface in each connected part of a cloud.
 *
 * Hoppe et al. 1992: the sign is carried along the minimum spanning tree of the graph
 * of nearest neighbours, so that it crosses edges where it is sure before those where
 * it is not. They take two normals n, m to agree where n.m > 0, and 1 - |n.m| for the
 * weight. That joins the two sides of a thin wall and is undecided at a sharp edge.
 * Here n is first reflected in the plane halfway between the two points, as Xie et al.
 * 2003 do, which is exact where the neighbours lie on a common circle:
 * n.m - 2 (n.e)(m.e), with e the direction of the edge.
 *
 * Where all was seen from the viewpoint alone, because the cloud is an image or because
 * no points hide others, all normals face it (see faceViewpoint), unless the cloud is
 * one closed surface around it.
 *
 * Otherwise the side of a part as a whole: outward if it is closed, that is if its
 * normals add up to nothing much and its signed volume by the divergence theorem is not
 * zero; else toward the viewpoint, if there is one and most of the part faces it or
 * most faces away; else upward, to +z.
 *
 * \param[in] points finite, no two of them equal, not far from unit size
 * \param[in] viewpoint in the same coordinates
 * \param[in] organized whether the points are an image of a sensor there
 * \param[in] nearest makes searches for neighbours
 * \param[in] threads 0 for all processors
 * \param[in,out] normals of unit length or zero
 */
Orientation
orientNormals (const std::vector<Eigen::Vector3f>& points,
               const std::optional<Eigen::Vector3f>& viewpoint,
               bool organized,
               const NearestMaker& nearest,
               unsigned threads,
               std::vector<Eigen::Vector3f>& normals);

} // namespace crest
} // namespace pcl
