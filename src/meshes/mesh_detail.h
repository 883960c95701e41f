// SPDX-License-Identifier: BSD-3-Clause
// How much of a mesh its vertices tell, and how fine its features are.
#pragma once

#include <pcl_crest/input.h>

#include "base/progress.h"
#include "meshes/triangle_shapes.h"

namespace pcl {
namespace crest {

/** \brief Lengths and areas in the unit of the mesh. */
struct PCL_CREST_EXPORT MeshDetail {
  double area = 0.0;
  /** of faces whose inside the vertices around do not tell: nearly all of those around
   * lie on sharp or open edges, and the face goes on in a plane or across much of the
   * mesh, or a side is several times as long as the vertices at its corners are apart
   */
  double untold_area = 0.0;
  /** between the vertices of the other faces, the median over their area; 0 where there
   * are none */
  double vertex_spacing = 0.0;
  /** what all but one percent of the sharp edges leave beside them: the widths of the
   * smooth regions that they bound, the radii of the rings that they form, and four
   * sevenths of their lengths from corner to corner; 0 where no edge is sharp */
  double feature_width = 0.0;
  /** that of the smooth regions that edges bound, the median over their area; 0 where
   * none are bounded */
  double region_width = 0.0;
  /** whether all of it lies in planes that no edge connects */
  bool is_flat = true;

  /** \brief Whether its vertices are no samples of it. */
  [[nodiscard]] bool
  needsSamples () const;

  /** \brief The spacing of samples that tell its features: four over the width of each,
   * and not wider than its vertices where these tell much of it; within bounds of how
   * many samples that makes.
   */
  [[nodiscard]] double
  resolvingSpacing () const;

  /** \brief Whether more samples are needed to tell all features than there will be. */
  [[nodiscard]] bool
  isFinerThanSamples () const;
};

/** \param[in] cloud only its positions are used
 *
 * \param[in] triangles whose corners are finite points of the cloud
 * \param[in] edges, shapes of these
 */
PCL_CREST_EXPORT MeshDetail
measureDetail (const PointView& cloud,
               const Faces& triangles,
               const EdgeTable& edges,
               const TriangleShapes& shapes,
               const Workers& workers);

} // namespace crest
} // namespace pcl
