// SPDX-License-Identifier: BSD-3-Clause
// Paper, section 4.5: the crest graphs and their minimum spanning forest.
#pragma once

#include "lines/region_growing.h"

#include <tuple>

namespace pcl {
namespace crest {

/** \brief The three types of edges and their weights (section 4.5). */
enum class EdgeType : std::uint8_t {
  A = 1, /**< between two crest points */
  B = 5, /**< between a crest point and one joined by growth */
  C = 10 /**< between two points joined by growth */
};

struct CrestEdge {
  index_t a;
  index_t b;
  EdgeType type;
  /** the first tie break among edges of one type, in the cloud's unit */
  float length;
};

/** \brief An order by the ends alone. */
inline bool
comesFirst (const CrestEdge& e, const CrestEdge& f)
{
  return std::tie (e.a, e.b) < std::tie (f.a, f.b);
}

/** \brief The edges of the crest graphs: those between two members, a < b. */
std::vector<CrestEdge>
crestEdges (const OrientedPoints& points,
            const SurfaceGraph& graph,
            const std::vector<Membership>& membership);

/** \brief The edges that can be part of a line, for points that stand where their
 * crests are: none that is long, and none that leads across the crest from one of two
 * rows of points to the other, as the rungs of a ladder do.
 */
std::vector<CrestEdge>
admissibleEdges (const OrientedPoints& points,
                 const SurfaceGraph& graph,
                 const std::vector<CrestProfile>& profiles,
                 std::vector<CrestEdge> edges);

/** \brief The minimum spanning forest of the crest graphs by Kruskal's algorithm
 * (section 4.5).
 *
 * The three weights are three buckets, so that edges are sorted within a type only, by
 * length, then by their points: the forest is unique.
 */
std::vector<CrestEdge>
minimumSpanningForest (const OrientedPoints& points,
                       const SurfaceGraph& graph,
                       const std::vector<Membership>& membership);

/** \brief The same for a choice of their edges.
 *
 * \param[in] size the number of points that the edges may name
 * \param[in] edges of the graphs, in any order
 * \param[in] given edges that are there already, loops included
 * \return the given edges and those of the forest in the order in which Kruskal takes
 * them
 */
std::vector<CrestEdge>
minimumSpanningForest (std::size_t size,
                       std::vector<CrestEdge> edges,
                       const std::vector<CrestEdge>& given = {});

} // namespace crest
} // namespace pcl
