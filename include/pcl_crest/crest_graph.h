// SPDX-License-Identifier: BSD-3-Clause
// Paper, sections 4.4 and 4.5: region growing and the minimum spanning forest.
#pragma once

#include <pcl_crest/crest_points.h>

namespace pcl {
namespace crest {

/** \brief What a point is to the crest graphs of one type. */
enum class Membership : std::uint8_t { OUTSIDE = 0, GROWN = 1, CREST = 2 };

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

/** \brief Grows the crest points of one type by the points that share an edge with
 * them and are not crest points of either type (section 4.4). Points without a
 * curvature are invalid and stay out.
 */
std::vector<Membership>
growRegions (const SurfaceGraph& graph,
             const std::vector<PrincipalCurvature>& curvature,
             const std::vector<CrestType>& crest_points,
             CrestType type);

/** \brief The edges of the crest graphs: those between two members, a < b. */
std::vector<CrestEdge>
crestEdges (const OrientedPoints& points,
            const SurfaceGraph& graph,
            const std::vector<Membership>& membership);

/** \brief Grows crest points along the crests that they are on: by all likely crest
 * points that they are connected with through such (the hysteresis of Canny 1986), then
 * as in the paper by the neighbours of both, but only where these are near to a crest
 * of the type: with a foot within three spacings, and k1 of its sign.
 *
 * \param[in] likely_points of both types, as likelyCrestPoints finds them
 */
std::vector<Membership>
growAlongCrests (const SurfaceGraph& graph,
                 const std::vector<CrestProfile>& profiles,
                 const std::vector<CrestType>& crest_points,
                 const std::vector<CrestType>& likely_points,
                 CrestType type);

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
