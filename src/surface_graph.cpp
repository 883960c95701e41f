// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_crest/search/point_tree.h>
#include <pcl_crest/surface_graph.h>

#include <Eigen/Geometry>

#include "parallel.h"

#include <algorithm>
#include <cmath>

namespace pcl {
namespace crest {

namespace {

struct Candidate {
  double squared_distance;
  index_t point;

  bool
  operator<(const Candidate& o) const
  {
    return squared_distance != o.squared_distance
               ? squared_distance < o.squared_distance
               : point < o.point;
  }
};

struct Projected {
  double squared_distance;
  index_t point;
  /** from the point to it, in the tangent plane */
  Eigen::Vector3d edge;
  /** squared length of the difference of the two normals, which rounding changes less
   * than their cosine */
  double normal_difference;
};

class QuadrantFilter {
public:
  QuadrantFilter (const OrientedPoints& points, const Parameters& parameters)
  : points_ (points)
  , intervals_ (4 * parameters.points_per_quadrant)
  , per_quadrant_ (parameters.points_per_quadrant)
  , width_ (2.0 * M_PI / intervals_)
  // A jump is an angle above the limit; the slack keeps right angles, exact on boxes.
  , min_cosine_ (std::cos (parameters.max_normal_angle * M_PI / 180.0) - 1e-6)
  {}

  /** \brief Sorts the found points by distance, then index; drops the point itself. */
  void
  rank (index_t point, const std::vector<index_t>& found)
  {
    candidates_.clear();
    for (const index_t q : found)
      if (q != point)
        candidates_.push_back ({points_.edge (point, q).squaredNorm(), q});
    std::sort (candidates_.begin(), candidates_.end());
    // A search over the raw cloud may find a sample twice, as two coincident points.
    const auto same = [] (const Candidate& a, const Candidate& b) {
      return a.point == b.point;
    };
    candidates_.erase (std::unique (candidates_.begin(), candidates_.end(), same),
                       candidates_.end());
  }

  double
  spacing () const
  {
    const std::size_t count = std::min<std::size_t> (6, candidates_.size());
    double sum = 0.0;
    for (std::size_t i = 0; i < count; ++i)
      sum += std::sqrt (candidates_[i].squared_distance);
    return count == 0 ? 0.0 : sum / static_cast<double> (count);
  }

  /** \brief Appends the neighbours of the ranked point; returns whether it lies on the
   * boundary.
   */
  bool
  select (index_t point, std::vector<index_t>& neighbors)
  {
    nearest_.assign (intervals_, -1.0);
    const Eigen::Vector3d n = points_.normals[point].cast<double>();
    projectCandidates (point, n);
    if (projected_.empty())
      return true;
    const Eigen::Vector3d x = axis();
    const Eigen::Vector3d y = n.cross (x);
    for (const Projected& candidate : projected_) {
      double& nearest =
          nearest_[interval (candidate.edge.dot (x), candidate.edge.dot (y))];
      if (nearest < 0.0)
        nearest = candidate.squared_distance;
      if (candidate.squared_distance <= nearest * (1.0 + EQUIDISTANT))
        neighbors.push_back (candidate.point);
    }
    return hasEmptyQuadrant();
  }

private:
  /** \brief Of the ranked candidates those on the same sheet of the surface that have a
   * polar angle, with their projections.
   */
  void
  projectCandidates (index_t point, const Eigen::Vector3d& n)
  {
    projected_.clear();
    for (const Candidate& candidate : candidates_) {
      const Eigen::Vector3d m = points_.normals[candidate.point].cast<double>();
      if (m.dot (n) < min_cosine_)
        continue;
      const Eigen::Vector3d e = points_.edge (point, candidate.point);
      const Eigen::Vector3d projected = e - e.dot (n) * n;
      // Straight above or below the point there is no polar angle.
      if (projected.squaredNorm() > 1e-6 * candidate.squared_distance)
        projected_.push_back ({candidate.squared_distance,
                               candidate.point,
                               projected,
                               (m - n).squaredNorm()});
    }
  }

  /** \brief The direction of the nearest neighbour; of equidistant ones that whose
   * normal differs most, which turns with the cloud; of these, on a plane, the lowest
   * index.
   */
  Eigen::Vector3d
  axis () const
  {
    const double limit = projected_.front().squared_distance * (1.0 + EQUIDISTANT);
    double most = 0.0;
    for (const Projected& candidate : projected_)
      if (candidate.squared_distance <= limit)
        most = std::max (most, candidate.normal_difference);
    constexpr double ROUNDING = 1e-12;
    const Projected* chosen = nullptr;
    for (const Projected& candidate : projected_)
      if (candidate.squared_distance <= limit &&
          candidate.normal_difference * (1.0 + EQUIDISTANT) + ROUNDING >= most &&
          (chosen == nullptr || candidate.point < chosen->point))
        chosen = &candidate;
    return chosen->edge.normalized();
  }

  /** \brief The interval of a direction in the tangent plane: 0 is centred on the x
   * axis, borders belong to the side nearer to it.
   */
  int
  interval (double x, double y) const
  {
    const double angle = std::atan2 (y, x);
    const int away = std::max (
        0, static_cast<int> (std::ceil (std::abs (angle) / width_ - 0.5 - 1e-9)));
    return angle >= 0.0 || away == 0 ? away : intervals_ - away;
  }

  bool
  hasEmptyQuadrant () const
  {
    int run = 0;
    for (int i = 0; i < intervals_ + per_quadrant_; ++i) {
      run = nearest_[i % intervals_] < 0.0 ? run + 1 : 0;
      if (run == per_quadrant_)
        return true;
    }
    return false;
  }

  const OrientedPoints& points_;
  int intervals_;
  int per_quadrant_;
  double width_;
  double min_cosine_;
  std::vector<Candidate> candidates_;
  std::vector<Projected> projected_;
  std::vector<double> nearest_;
};

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
                 const Parameters& parameters)
{
  const std::size_t size = points.size();
  SurfaceGraph directed;
  directed.offsets.assign (size + 1, 0);
  directed.boundary.assign (size, 0);
  directed.spacing.assign (size, 0.0F);
  std::vector<std::vector<index_t>> blocks (blockCount (size));
  forEachBlock (
      size,
      parameters.threads,
      [&] (std::size_t block, std::size_t first, std::size_t last) {
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
      });

  double spacing_sum = 0.0;
  for (std::size_t i = 0; i < size; ++i) {
    directed.offsets[i + 1] += directed.offsets[i];
    spacing_sum += directed.spacing[i];
  }
  directed.mean_spacing = size == 0 ? 0.0 : spacing_sum / static_cast<double> (size);
  directed.neighbors.resize (directed.offsets.back());
  forEachBlock (size,
                parameters.threads,
                [&] (std::size_t block, std::size_t first, std::size_t last) {
                  const index_t* from = blocks[block].data();
                  for (std::size_t i = first; i < last; ++i) {
                    const index_t point = candidates.point (i);
                    const index_t* const to =
                        from + directed.offsets[point + 1] - directed.offsets[point];
                    std::copy (
                        from, to, directed.neighbors.data() + directed.offsets[point]);
                    from = to;
                  }
                });
  return directed;
}

bool
contains (const Star& star, index_t point)
{
  return std::find (star.begin(), star.end(), point) != star.end();
}

/** \brief "Visiting every point p, getting all its neighbors p_i and assigning p as
 * p_i's neighbor, if it was not already a neighbor" (4.1).
 */
SurfaceGraph
symmetrize (SurfaceGraph&& directed)
{
  const auto size = static_cast<index_t> (directed.size());
  SurfaceGraph graph;
  graph.boundary = std::move (directed.boundary);
  graph.spacing = std::move (directed.spacing);
  graph.mean_spacing = directed.mean_spacing;
  graph.offsets.assign (static_cast<std::size_t> (size) + 1, 0);
  for (index_t p = 0; p < size; ++p)
    for (const index_t q : directed.star (p)) {
      ++graph.offsets[p + 1];
      if (!contains (directed.star (q), p))
        ++graph.offsets[q + 1];
    }
  for (index_t p = 0; p < size; ++p)
    graph.offsets[p + 1] += graph.offsets[p];

  graph.neighbors.resize (graph.offsets.back());
  std::vector<std::size_t> next (graph.offsets.begin(), graph.offsets.end() - 1);
  for (index_t p = 0; p < size; ++p)
    for (const index_t q : directed.star (p)) {
      graph.neighbors[next[p]++] = q;
      if (!contains (directed.star (q), p))
        graph.neighbors[next[q]++] = p;
    }
  for (index_t p = 0; p < size; ++p)
    std::sort (graph.neighbors.begin() + static_cast<std::ptrdiff_t> (graph.offsets[p]),
               graph.neighbors.begin() +
                   static_cast<std::ptrdiff_t> (graph.offsets[p + 1]));
  return graph;
}

} // namespace

SurfaceGraph
buildSurfaceGraph (const OrientedPoints& points,
                   const NeighborSearch& search,
                   const Parameters& parameters)
{
  return symmetrize (filterNeighbors (points, PointwiseCandidates{search}, parameters));
}

SurfaceGraph
buildSurfaceGraph (const OrientedPoints& points,
                   const PointTree& tree,
                   const Parameters& parameters)
{
  return symmetrize (
      filterNeighbors (points, BatchedCandidates{tree, parameters.k}, parameters));
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
