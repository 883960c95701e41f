// SPDX-License-Identifier: BSD-3-Clause
// Room creases: lines along sharp edges, for the auto preset.
//
// Samples and their graph go in. Out come the edges between pairs of planes (Pearson
// 1901; two_planes.h, creases.h), chained, joined and made lines of here, the profiles
// beside them (sharp_profiles.h), and their links into smooth crests (sharp_links.h).
// They are edges of the crest graph, so that the room stands on the room lines.
#pragma once

#include "creases/creases.h"
#include "lines/spanning_forest.h"

namespace pcl {
namespace crest {

/** \brief A point of a sharp line, which takes the place of a sample. */
struct SharpNode {
  index_t point;
  /** where it stands: on the edge, or in the corner that edges meet in; with the edge's
   * direction, angle and type, at a corner those of one of them */
  Crease crease;
};

/** \brief The net of the sharp edges of a surface. */
struct SharpLines {
  /** by point, each once, whichever lines it is part of */
  std::vector<SharpNode> nodes;
  /** between the points of nodes, of type A; a corner of ridges that a valley ends in
   * is a point of both nets */
  PerType<std::vector<CrestEdge>> edges;
  /** 1 for the samples too near to a sharp line for anything else, else 0 */
  std::vector<std::uint8_t> blocked;
};

/** \brief Makes single lines, corners and loops of the creases of samples.
 *
 * - Consensus: each crease moves to the mean of those around it that lie on the same
 *   line; one that is alone is dropped.
 * - Thinning: of the creases that are beside each other the one nearest to its sample,
 *   with the best fit, stays.
 * - Linking: each node has one link each way, so that there are neither forks nor
 *   ladders, and loops close by themselves; nearest first.
 * - Ends: those that face each other are joined; where the lines through ends meet,
 *   they get a corner, and one that runs into another line is joined to it.
 * - Lines that are short, and neither closed nor joined at both ends, or uncertain, or
 *   rounder than their noise tells, are dropped: the later stages place smooth crests
 *   better.
 *
 * \param[in] points, graph, search what the creases were found with
 * \param[in] creases of all samples
 * \param[in] may_curve whether creases may agree on a circle as well as on a straight
 * line; where they are uncertain some would by chance, and corners would be rounded
 * \param[in] workers a number of threads, 0 for all processors
 */
SharpLines
traceCreases (const OrientedPoints& points,
              const SurfaceGraph& graph,
              const NeighborSearch& search,
              const std::vector<Crease>& creases,
              bool may_curve,
              const Workers& workers);

} // namespace crest
} // namespace pcl
