// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_crest/search/point_tree.h>
#include <pcl_crest/surface_graph.h>

#include "parallel.h"
#include "quadrant_filter.h"

#include <algorithm>

namespace pcl {
namespace crest {

namespace {

/** \brief Candidates from a search for single points, in the order of the points. */
struct PointwiseCandidates {
  const NeighborSearch& search;

  /** \brief The i-th point that is visited. */
  static index_t
  point (std::size_t i)
  {
    return static_cast<index_t> (i);
  }

  /** \brief Calls use (point, found) for the points of a block in their order. */
  template <typename Use>
  void
  visit (std::size_t first, std::size_t last, const Use& use) const
  {
    std::vector<index_t> found;
    for (std::size_t i = first; i < last; ++i) {
      search (point (i), found);
      use (point (i), found);
    }
  }
};

/** \brief Candidates from the batched search, in the order of its tree. */
struct BatchedCandidates {
  const PointTree& tree;
  int k;

  index_t
  point (std::size_t i) const
  {
    return tree.index (static_cast<index_t> (i));
  }

  template <typename Use>
  void
  visit (std::size_t first, std::size_t last, const Use& use) const
  {
    static_assert (BLOCK_SIZE % LEAF_SIZE == 0, "blocks have whole leaves");
    visitLeaves (tree, k, first, last, use);
  }
};

/** \brief Stars as the filter chose them: an edge may be known at one end only. */
template <typename Candidates>
SurfaceGraph
filterNeighbors (const OrientedPoints& points,
                 const Candidates& candidates,
                 const Parameters& parameters,
                 const Workers& workers)
{
  const std::size_t size = points.size();
  SurfaceGraph directed;
  directed.offsets.assign (size + 1, 0);
  directed.boundary.assign (size, 0);
  directed.spacing.assign (size, 0.0F);
  std::vector<std::vector<index_t>> blocks (blockCount (size));
  forEachBlock (
      size, workers, [&] (std::size_t block, std::size_t first, std::size_t last) {
        QuadrantFilter filter (points, parameters);
        std::vector<index_t>& neighbors = blocks[block];
        candidates.visit (
            first, last, [&] (index_t point, const std::vector<index_t>& found) {
              filter.rank (point, found);
              directed.spacing[point] = static_cast<float> (filter.spacing());
              const std::size_t before = neighbors.size();
              directed.boundary[point] = filter.select (point, neighbors) ? 1 : 0;
              directed.offsets[point + 1] = neighbors.size() - before;
            });
        neighbors.shrink_to_fit();
      });

  double spacing_sum = 0.0;
  for (std::size_t i = 0; i < size; ++i) {
    directed.offsets[i + 1] += directed.offsets[i];
    spacing_sum += directed.spacing[i];
  }
  directed.mean_spacing = size == 0 ? 0.0 : spacing_sum / static_cast<double> (size);
  directed.neighbors.resize (directed.offsets.back());
  forEachBlock (
      size, workers, [&] (std::size_t block, std::size_t first, std::size_t last) {
        const index_t* from = blocks[block].data();
        for (std::size_t i = first; i < last; ++i) {
          const index_t point = candidates.point (i);
          const index_t* const to =
              from + directed.offsets[point + 1] - directed.offsets[point];
          std::copy (from, to, directed.neighbors.data() + directed.offsets[point]);
          from = to;
        }
      });
  return directed;
}

/** \brief For each edge of a graph 1 if it is known at this end alone. */
std::vector<std::uint8_t>
findOneWay (const SurfaceGraph& directed, const Workers& workers)
{
  std::vector<std::uint8_t> one_way (directed.neighbors.size(), 0);
  forEachBlock (
      directed.size(), workers, [&] (std::size_t, std::size_t first, std::size_t last) {
        for (std::size_t p = first; p < last; ++p)
          for (std::size_t e = directed.offsets[p]; e < directed.offsets[p + 1]; ++e) {
            const Star back = directed.star (directed.neighbors[e]);
            one_way[e] =
                std::find (back.begin(), back.end(), static_cast<index_t> (p)) ==
                        back.end()
                    ? 1
                    : 0;
          }
      });
  return one_way;
}

/** \brief Sorts few numbers. */
void
insertionSort (index_t* first, const index_t* last)
{
  for (index_t* end = first; end < last; ++end) {
    const index_t number = *end;
    index_t* at = end;
    for (; at > first && at[-1] > number; --at)
      *at = at[-1];
    *at = number;
  }
}

/** \brief "Visiting every point p, getting all its neighbors p_i and assigning p as
 * p_i's neighbor, if it was not already a neighbor" (4.1).
 */
SurfaceGraph
symmetrize (SurfaceGraph&& directed, const Workers& workers)
{
  const std::size_t size = directed.size();
  SurfaceGraph graph;
  graph.boundary = std::move (directed.boundary);
  graph.spacing = std::move (directed.spacing);
  graph.mean_spacing = directed.mean_spacing;
  const std::vector<std::uint8_t> one_way = findOneWay (directed, workers);
  std::vector<index_t> incoming (size, 0);
  for (std::size_t e = 0; e < one_way.size(); ++e)
    incoming[directed.neighbors[e]] += one_way[e];
  graph.offsets.assign (size + 1, 0);
  for (std::size_t p = 0; p < size; ++p)
    graph.offsets[p + 1] = graph.offsets[p] +
                           directed.star (static_cast<index_t> (p)).size() +
                           static_cast<std::size_t> (incoming[p]);

  graph.neighbors.resize (graph.offsets.back());
  for (std::size_t p = 0; p < size; ++p)
    for (std::size_t e = directed.offsets[p]; e < directed.offsets[p + 1]; ++e)
      if (one_way[e] != 0) {
        const index_t q = directed.neighbors[e];
        graph.neighbors[graph.offsets[q + 1] -
                        static_cast<std::size_t> (incoming[q]--)] =
            static_cast<index_t> (p);
      }
  forEachBlock (size, workers, [&] (std::size_t, std::size_t first, std::size_t last) {
    for (std::size_t p = first; p < last; ++p) {
      const Star own = directed.star (static_cast<index_t> (p));
      std::copy (own.begin(), own.end(), graph.neighbors.data() + graph.offsets[p]);
      insertionSort (graph.neighbors.data() + graph.offsets[p],
                     graph.neighbors.data() + graph.offsets[p + 1]);
    }
  });
  return graph;
}

} // namespace

SurfaceGraph
buildSurfaceGraph (const OrientedPoints& points,
                   const NeighborSearch& search,
                   const Parameters& parameters,
                   Progress* progress)
{
  const Workers workers (parameters.threads, progress);
  return symmetrize (
      filterNeighbors (points, PointwiseCandidates{search}, parameters, workers),
      workers);
}

SurfaceGraph
buildSurfaceGraph (const OrientedPoints& points,
                   std::shared_ptr<const PointTree> tree,
                   const Parameters& parameters,
                   Progress* progress)
{
  const Workers workers (parameters.threads, progress);
  SurfaceGraph directed = filterNeighbors (
      points, BatchedCandidates{*tree, parameters.k}, parameters, workers);
  tree.reset();
  return symmetrize (std::move (directed), workers);
}

SurfaceGraph
withoutPoints (const SurfaceGraph& graph, const std::vector<std::uint8_t>& removed)
{
  SurfaceGraph rest;
  rest.boundary = graph.boundary;
  rest.spacing = graph.spacing;
  rest.mean_spacing = graph.mean_spacing;
  rest.offsets.assign (1, 0);
  rest.offsets.reserve (graph.offsets.size());
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
