// SPDX-License-Identifier: BSD-3-Clause
// Sharp edges, sample by sample, for the auto preset.
#pragma once

#include "surface/surface_graph.h"

namespace pcl {
namespace crest {

/** \brief The sharp edge next to a sample, in the cloud's unit. */
struct Crease {
  /** a ridge is convex, a valley concave; NONE where there is no edge */
  CrestType type = CrestType::NONE;
  /** point of the edge that is nearest to the sample */
  Eigen::Vector3f foot = Eigen::Vector3f::Zero();
  /** unit vectors: along the edge, either way; in the middle of the normals of the two
   * faces */
  Eigen::Vector3f direction = Eigen::Vector3f::Zero();
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();
  /** between the normals of the two faces, in degrees */
  float angle = 0.0F;
  /** mean squared distance of the samples around from the two faces, as a part of that
   * from the best smooth surface: the smaller, the more certain */
  float ratio = 1.0F;
  /** the same as a part of what a smooth surface leaves of the nearest, .02 spacings at
   * least: well above 1 where it is no noise that the faces leave, but the edge is
   * round. That is a quartic of the 24 nearest if it leaves less than .045 spacings,
   * and 2 at most; else a cubic of the 30 nearest, and 0 if the faces were fitted to
   * no more samples than these. 0 too if these lie in a narrow strip and tell nothing
   */
  float roundness = 0.0F;
};

/** Least neighbours that the search for creases has to find; more are of no use. */
constexpr int CREASE_NEIGHBORS = 96;

/** \brief Tests samples for a sharp edge within one spacing: two planes have to fit
 * what is around them much better than any smooth surface does.
 *
 * Centres (see chooseCentres) come first, every fifth sample or so. An edge passes many
 * of them, so that others are tested around those alone that have a crease, and around
 * these in turn.
 *
 * In windows of 20, 30, 48 and 96 neighbours, whatever their normals, two planes are
 * fitted by total least squares (Pearson 1901), alternating with the choice of the
 * plane that each neighbour belongs to, which starts from the normals. The solid is
 * behind both planes at a convex edge, and behind either at a concave one. A cubic
 * height function in the same window is what they have to beat: it follows all that is
 * smooth at this scale, so that smooth crests stay with the later stages. Those that
 * are narrower than a window are told by their roundness. Of the windows the one with
 * the smallest ratio of the residuals counts, unless its planes leave something where a
 * flat face ends (see FaceEnd). Where there is neither, the smallest window counts in
 * which two planes meet whatever the signs of normals (see CrossingPlanes); then the
 * rim of a plate that is too thin for a plane of its own (see PlateRim).
 *
 * \param[in] points, graph the samples; spacings are taken from the graph
 * \param[in] search finds CREASE_NEIGHBORS neighbours
 * \param[in] largest_residual that two planes may leave of the neighbours: their root
 * mean square distance, in spacings
 * \param[in] workers a number of threads, 0 for all processors
 * \return for each sample its crease, NONE for those that were not tested
 */
std::vector<Crease>
findCreases (const OrientedPoints& points,
             const SurfaceGraph& graph,
             const NeighborSearch& search,
             double largest_residual,
             const Workers& workers);

} // namespace crest
} // namespace pcl
