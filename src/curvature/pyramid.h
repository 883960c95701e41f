// SPDX-License-Identifier: BSD-3-Clause
// The surface at coarser and coarser samplings, for curvature at a scale.
#pragma once

#include "search/position_tree.h"
#include "surface/surface_graph.h"

#include <memory>

namespace pcl {
namespace crest {

/** \brief One level of a pyramid: every node is the mean of a few samples that are
 * neighbours on the surface, so that its noise is smaller than theirs.
 */
struct PyramidLevel {
  std::vector<Eigen::Vector3f> positions;
  std::vector<Eigen::Vector3f> normals;
  /** over the positions */
  std::shared_ptr<const PointTree> tree;
  /** samples that each node is the mean of */
  std::vector<float> weights;
  /** nodes are neighbours where any of their samples are */
  SurfaceGraph graph;
  /** for each sample its node */
  std::vector<index_t> node_of;

  std::size_t
  size () const
  {
    return positions.size();
  }
};

/** \brief The samples themselves as the finest level.
 * \param[in] tree over them
 */
PyramidLevel
finestLevel (const OrientedPoints& points,
             SurfaceGraph graph,
             std::shared_ptr<const PointTree> tree);

/** \brief Chooses samples, or nodes, no two of them neighbours, of which every other
 * has one among its neighbours.
 *
 * They are found in a fixed number of rounds. In each, those of the nodes that are
 * still free become centres whose star is more symmetric than that of all their free
 * neighbours, or in the last of the rounds whose hash is less, and their neighbours are
 * free no more. This depends on nothing but the
 * surroundings of a node: not on the order of the points, their number, or workers, and
 * not on scale or (but for ties) rotation. What is free after the last round is a
 * centre of its own. Neighbours across a sharp edge or on two sheets, which are no one
 * piece of surface, do not count as such.
 *
 * \return for each node 1 if it is a centre, else 0
 */
std::vector<std::uint8_t>
chooseCentres (const std::vector<Eigen::Vector3f>& positions,
               const std::vector<Eigen::Vector3f>& normals,
               const SurfaceGraph& graph,
               const Workers& workers);

/** \brief The next coarser level: every node joins the nearest centre among its
 * neighbours (see chooseCentres).
 */
PyramidLevel
coarserLevel (const PyramidLevel& fine, const Workers& workers);

} // namespace crest
} // namespace pcl
