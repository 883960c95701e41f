// SPDX-License-Identifier: BSD-3-Clause
// Room surface: paper, section 4.1, generating topological information.
//
// A cloud with normals goes in. Out come its samples (oriented_points.h), the candidate
// neighbours of each (neighbor_search.h), and of these the ones that the quadrant
// filter keeps, as a symmetric graph that knows its spacing and its border. It knows
// nothing of curvature.
#pragma once

#include "base/progress.h"
#include "surface/neighbor_search.h"
#include "surface/star_offsets.h"

namespace pcl {
namespace crest {

/** \brief The points that share an edge with a point: star(p) of the paper. */
struct Star {
  const index_t* first;
  const index_t* last;

  const index_t*
  begin () const
  {
    return first;
  }
  const index_t*
  end () const
  {
    return last;
  }
  std::size_t
  size () const
  {
    return static_cast<std::size_t> (last - first);
  }
};

/** \brief The undirected surface graph in compressed sparse row (CSR) form: the star
 * of point i is neighbors[offsets[i]] ... neighbors[offsets[i + 1] - 1], ascending.
 */
struct SurfaceGraph {
  StarOffsets offsets;
  std::vector<index_t> neighbors;
  /** 1 where an empty quadrant tells that the surface ends (4.1), else 0 */
  std::vector<std::uint8_t> boundary;
  /** for each point the mean distance to its 6 nearest neighbours (or to fewer, where
   * the search finds no more), in the cloud's unit */
  std::vector<float> spacing;
  /** mean of these over the points */
  double mean_spacing = 0.0;

  std::size_t
  size () const
  {
    return offsets.size() == 0 ? 0 : offsets.size() - 1;
  }
  Star
  star (index_t point) const
  {
    return {neighbors.data() + offsets[point], neighbors.data() + offsets[point + 1]};
  }
};

/** \brief Connects every point with the nearest candidate in each angular interval of
 * its tangent plane (section 4.1), and makes the relation symmetric.
 *
 * Choices where the paper leaves them open:
 * - The first interval is centred on the direction of the nearest neighbour (of
 *   equidistant ones that whose normal differs most), so that the graph turns with the
 *   cloud; the paper's axes are arbitrary.
 * - A candidate on the border of two intervals belongs to the one nearer to that
 *   direction, so that the graph is the same when all normals are flipped.
 * - EQUIDISTANT candidates of an interval are all kept, as in the paper.
 * - A boundary point is one with as many empty intervals in a row as make a quadrant,
 *   wherever that quadrant begins.
 *
 * \param[in] points the samples
 * \param[in] source of the candidates; if nobody else has its tree, the memory of that
 * is free for the second half of the work
 * \param[in] parameters k, points_per_quadrant, max_normal_angle, radius and threads
 * are used
 * \param[in] progress to tell how far it is, if not null
 * \throw std::runtime_error, in words for the user, where the radius holds more than
 * MOST_NEIGHBORS
 */
SurfaceGraph
buildSurfaceGraph (const OrientedPoints& points,
                   NeighborSource source,
                   const Parameters& parameters,
                   Progress* progress = nullptr);

/** \brief All that the graph says of points, without stars. */
SurfaceGraph
unconnected (const SurfaceGraph& graph);

/** \brief The graph without the edges of some points, which stay as points alone.
 * \param[in] removed 1 for these, 0 for the others
 */
SurfaceGraph
withoutPoints (const SurfaceGraph& graph, const std::vector<std::uint8_t>& removed);

} // namespace crest
} // namespace pcl
