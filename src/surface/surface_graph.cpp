// SPDX-License-Identifier: BSD-3-Clause
#include "surface/surface_graph.h"

#include "base/large_arrays.h"
#include "base/parallel.h"
#include "search/point_tree.h"
#include "surface/quadrant_filter.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <mutex>
#include <sstream>
#include <stdexcept>
#include <unordered_map>

namespace pcl {
namespace crest {

namespace {

/** \brief Refuses a radius that holds too many, as one in another unit than the cloud
 * does, before every point has found all others. Leaves each of those found once.
 */
void
checkRadius (double radius, std::vector<index_t>& found)
{
  if (found.size() <= MOST_NEIGHBORS)
    return;
  // A search over the raw cloud finds all copies of a sample.
  std::sort (found.begin(), found.end());
  found.erase (std::unique (found.begin(), found.end()), found.end());
  if (found.size() <= MOST_NEIGHBORS)
    return;
  std::ostringstream message;
  message << "The search radius of " << radius << " holds " << found.size()
          << " points around one of them, but must hold at most " << MOST_NEIGHBORS
          << ": it is in the unit of the cloud";
  throw std::runtime_error (message.str());
}

/** \brief Candidates from a search for single points, in the order of the points. */
struct PointwiseCandidates {
  const NeighborSearch& search;
  /** 0 for k neighbours */
  double radius;

  /** \brief Calls use (point, found) for the points of a block. */
  template <typename Use>
  void
  visit (std::size_t first, std::size_t last, const Use& use) const
  {
    std::vector<index_t> found;
    for (std::size_t i = first; i < last; ++i) {
      const auto point = static_cast<index_t> (i);
      search (point, found);
      if (radius > 0.0)
        checkRadius (radius, found);
      use (point, found);
    }
  }
};

/** \brief Candidates from the batched search, in the order of its tree. */
struct BatchedCandidates {
  const PointTree& tree;
  int k;

  template <typename Use>
  void
  visit (std::size_t first, std::size_t last, const Use& use) const
  {
    static_assert (BLOCK_SIZE % LEAF_SIZE == 0, "blocks have whole leaves");
    visitLeaves (tree, k, first, last, use);
  }
};

/** \brief Stars as the filter chose them: an edge may be known at one end only. All
 * have the same room, in which threads put them in any order; the few that need more
 * are kept beside it.
 */
class DirectedStars {
public:
  DirectedStars (std::size_t size, std::size_t room)
  : room_ (roundUp (room))
  , counts_ (makeLarge<index_t> (size, 0))
  , neighbors_ (makeLarge<index_t> (size * room_, NOBODY))
  {}

  std::size_t
  size () const
  {
    return counts_.size();
  }

  /** \brief Enters the star of a point; for different points threads may do so at
   * once. */
  void
  set (index_t point, const std::vector<index_t>& star)
  {
    counts_[point] = static_cast<index_t> (star.size());
    if (star.size() <= room_) {
      std::copy (star.begin(), star.end(), neighbors_.data() + point * room_);
      return;
    }
    LargeStar large{star, std::vector<std::uint8_t> (star.size(), 0)};
    large.neighbors.resize (roundUp (star.size()), NOBODY);
    const std::lock_guard<std::mutex> lock (large_mutex_);
    large_[point] = std::move (large);
  }

  Star
  star (index_t point) const
  {
    const auto count = static_cast<std::size_t> (counts_[point]);
    const index_t* const first = count <= room_ ? neighbors_.data() + point * room_
                                                : large_.at (point).neighbors.data();
    return {first, first + count};
  }

  /** \brief Finds the edges that are known at one end alone. */
  void
  findOneWay (const Workers& workers)
  {
    one_way_ = makeLarge<std::uint8_t> (neighbors_.size(), 0);
    forEachBlock (
        size(), workers, [this] (std::size_t, std::size_t first, std::size_t last) {
          for (auto p = static_cast<index_t> (first); p < static_cast<index_t> (last);
               ++p) {
            std::uint8_t* flag = oneWay (p);
            for (const index_t q : star (p))
              *flag++ = knows (q, p) ? 0 : 1;
          }
        });
  }

  /** \brief For each edge of a star 1 if it is known at this end alone. */
  std::uint8_t*
  oneWay (index_t point)
  {
    return static_cast<std::size_t> (counts_[point]) <= room_
               ? one_way_.data() + point * room_
               : large_.at (point).one_way.data();
  }

private:
  static constexpr index_t NOBODY = OrientedPoints::INVALID;
  /** Neighbours are compared so many at a time. */
  static constexpr std::size_t STEP = 4;

  static std::size_t
  roundUp (std::size_t count)
  {
    return (count + STEP - 1) / STEP * STEP;
  }

  /** \brief Whether a point has another in its star. Where is as good as random: there
   * is no branch for it.
   */
  bool
  knows (index_t point, index_t other) const
  {
    const Star found = star (point);
    const index_t* const first = found.first;
    const std::size_t room = std::max (roundUp (found.size()), room_);
    std::array<int, STEP> known{};
    for (std::size_t i = 0; i < room; i += STEP)
      for (std::size_t j = 0; j < STEP; ++j)
        known[j] |= static_cast<int> (first[i + j] == other);
    int any = 0;
    for (const int k : known)
      any |= k;
    return any != 0;
  }

  struct LargeStar {
    std::vector<index_t> neighbors;
    std::vector<std::uint8_t> one_way;
  };

  std::size_t room_;
  std::vector<index_t> counts_;
  std::vector<index_t> neighbors_;
  std::vector<std::uint8_t> one_way_;
  std::unordered_map<index_t, LargeStar> large_;
  std::mutex large_mutex_;
};

/** \brief The stars of the filter.
 * \param[out] graph gets boundary and spacing
 */
template <typename Candidates>
void
filterNeighbors (const OrientedPoints& points,
                 const Candidates& candidates,
                 const Parameters& parameters,
                 const Workers& workers,
                 DirectedStars& stars,
                 SurfaceGraph& graph)
{
  graph.boundary.assign (points.size(), 0);
  graph.spacing.assign (points.size(), 0.0F);
  forEachBlock (
      points.size(), workers, [&] (std::size_t, std::size_t first, std::size_t last) {
        QuadrantFilter filter (points, parameters);
        std::vector<index_t> star;
        candidates.visit (
            first, last, [&] (index_t point, const std::vector<index_t>& found) {
              filter.rank (point, found);
              graph.spacing[point] = static_cast<float> (filter.spacing (point));
              star.clear();
              graph.boundary[point] = filter.select (point, star) ? 1 : 0;
              stars.set (point, star);
            });
      });
  double spacing_sum = 0.0;
  for (const float spacing : graph.spacing)
    spacing_sum += spacing;
  if (points.size() > 0)
    graph.mean_spacing = spacing_sum / static_cast<double> (points.size());
}

/** \brief Sorts a star, in which nobody is twice. */
void
sortStar (index_t* first, index_t* last)
{
  constexpr std::ptrdiff_t FEW = 16;
  const std::ptrdiff_t count = last - first;
  if (count > FEW) {
    std::sort (first, last);
    return;
  }
  // Each goes where the number of those that are less tells, of all at once.
  std::array<index_t, FEW> star{};
  std::copy (first, last, star.begin());
  std::array<index_t, FEW> less{};
  for (std::ptrdiff_t i = 0; i < count; ++i)
    for (std::size_t j = 0; j < star.size(); ++j)
      less[j] += static_cast<index_t> (star[i] < star[j]);
  for (std::ptrdiff_t i = 0; i < count; ++i)
    first[less[i]] = star[i];
}

/** \brief "Visiting every point p, getting all its neighbors p_i and assigning p as
 * p_i's neighbor, if it was not already a neighbor" (4.1).
 * \param[in,out] graph gets the stars
 */
void
symmetrize (DirectedStars& stars, const Workers& workers, SurfaceGraph& graph)
{
  const auto size = static_cast<index_t> (stars.size());
  stars.findOneWay (workers);
  std::vector<index_t> incoming = makeLarge<index_t> (stars.size(), 0);
  for (index_t p = 0; p < size; ++p) {
    const std::uint8_t* one_way = stars.oneWay (p);
    for (const index_t q : stars.star (p))
      incoming[q] += *one_way++;
  }
  graph.offsets = makeOffsets (stars.size());
  std::size_t ends = 0;
  for (index_t p = 0; p < size; ++p) {
    ends += stars.star (p).size() + static_cast<std::size_t> (incoming[p]);
    graph.offsets.push_back (ends);
  }

  graph.neighbors = makeLarge<index_t> (ends, 0);
  for (index_t p = 0; p < size; ++p) {
    const std::uint8_t* one_way = stars.oneWay (p);
    for (const index_t q : stars.star (p))
      if (*one_way++ != 0)
        graph.neighbors[graph.offsets[q + 1] -
                        static_cast<std::size_t> (incoming[q]--)] = p;
  }
  forEachBlock (
      stars.size(), workers, [&] (std::size_t, std::size_t first, std::size_t last) {
        for (std::size_t p = first; p < last; ++p) {
          const Star own = stars.star (static_cast<index_t> (p));
          std::copy (own.begin(), own.end(), graph.neighbors.data() + graph.offsets[p]);
          sortStar (graph.neighbors.data() + graph.offsets[p],
                    graph.neighbors.data() + graph.offsets[p + 1]);
        }
      });
}

/** \brief Room for one point in each interval; more there are only where several are
 * equally near.
 */
std::size_t
roomFor (const Parameters& parameters)
{
  const int intervals = 4 * parameters.points_per_quadrant;
  return static_cast<std::size_t> (
      parameters.radius > 0.0 ? intervals : std::min (intervals, parameters.k));
}

} // namespace

SurfaceGraph
buildSurfaceGraph (const OrientedPoints& points,
                   NeighborSource source,
                   const Parameters& parameters,
                   Progress* progress)
{
  const Workers workers (parameters.threads, progress);
  SurfaceGraph graph;
  DirectedStars stars (points.size(), roomFor (parameters));
  const auto filter = [&] (const auto& candidates) {
    filterNeighbors (points, candidates, parameters, workers, stars, graph);
  };
  assert (source.pointwise || source.tree);
  if (source.pointwise)
    filter (PointwiseCandidates{source.pointwise, parameters.radius});
  else
    filter (BatchedCandidates{*source.tree, parameters.k});
  source = NeighborSource();
  symmetrize (stars, workers, graph);
  return graph;
}

SurfaceGraph
unconnected (const SurfaceGraph& graph)
{
  SurfaceGraph rest;
  rest.boundary = graph.boundary;
  rest.spacing = graph.spacing;
  rest.mean_spacing = graph.mean_spacing;
  return rest;
}

SurfaceGraph
withoutPoints (const SurfaceGraph& graph, const std::vector<std::uint8_t>& removed)
{
  SurfaceGraph rest = unconnected (graph);
  rest.offsets = makeOffsets (graph.size());
  reserveLarge (rest.neighbors, graph.neighbors.size());
  for (index_t p = 0; p < static_cast<index_t> (graph.size()); ++p) {
    if (removed[p] == 0)
      for (const index_t q : graph.star (p))
        if (removed[q] == 0)
          rest.neighbors.push_back (q);
    rest.offsets.push_back (rest.neighbors.size());
  }
  return rest;
}

} // namespace crest
} // namespace pcl
