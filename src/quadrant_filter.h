// SPDX-License-Identifier: BSD-3-Clause
// Paper, section 4.1: of the candidates around a point those that get an edge with it.
#pragma once

#include <pcl_crest/neighbor_search.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace pcl {
namespace crest {

/** \brief Chooses the nearest candidates in each angular interval of the tangent plane
 * (see buildSurfaceGraph). One such object belongs to one thread.
 */
class QuadrantFilter {
public:
  QuadrantFilter (const OrientedPoints& points, const Parameters& parameters)
  : points_ (points)
  , intervals_ (4 * parameters.points_per_quadrant)
  , per_quadrant_ (parameters.points_per_quadrant)
  // A jump is an angle above the limit; the slack keeps right angles, exact on boxes.
  , min_cosine_ (std::cos (parameters.max_normal_angle * M_PI / 180.0) - 1e-6)
  {
    // Borders belong to the side nearer to the axis, whatever rounding says.
    const double width = 2.0 * M_PI / intervals_;
    for (int i = 0; i < intervals_ / 2; ++i) {
      const double angle = (i + 0.5 + 1e-9) * width;
      borders_.emplace_back (std::cos (angle), std::sin (angle));
    }
  }

  /** \brief Sorts the found points by distance, then index; drops the point itself. */
  void
  rank (index_t point, const std::vector<index_t>& found)
  {
    candidates_.clear();
    for (const index_t q : found)
      if (q != point) {
        const Eigen::Vector3d edge = points_.edge (point, q);
        candidates_.push_back ({edge.squaredNorm(), q, edge});
      }
    // The batched search finds them in this order but for rounding.
    if (!std::is_sorted (candidates_.begin(), candidates_.end()))
      std::sort (candidates_.begin(), candidates_.end());
    // A search over the raw cloud may find a sample twice, as two coincident points.
    const auto same = [] (const Candidate& a, const Candidate& b) {
      return a.point == b.point;
    };
    candidates_.erase (std::unique (candidates_.begin(), candidates_.end(), same),
                       candidates_.end());
  }

  /** \brief Mean distance to the 6 nearest of the ranked. */
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
    const Eigen::Vector3d n = points_.normals[point].cast<double>();
    nearest_.assign (intervals_, EMPTY);
    std::size_t next = findNearest (n);
    if (nearest_candidates_.empty())
      return true;
    const Eigen::Vector3d x = axis (n);
    const Eigen::Vector3d y = n.cross (x);
    int empty = intervals_;
    double farthest = 0.0;
    std::size_t size = neighbors.size();
    neighbors.resize (size + candidates_.size());
    // What becomes of a candidate is as good as random: there is no branch for it.
    const auto take = [&] (const Candidate& candidate) {
      double& nearest =
          nearest_[interval (candidate.edge.dot (x), candidate.edge.dot (y))];
      if (empty > 0)
        farthest = candidate.squared_distance;
      empty -= static_cast<int> (nearest == EMPTY);
      nearest = std::min (nearest, candidate.squared_distance);
      neighbors[size] = candidate.point;
      size += static_cast<std::size_t> (candidate.squared_distance <=
                                        nearest * (1.0 + EQUIDISTANT));
    };
    for (const Nearest& candidate : nearest_candidates_)
      take (*candidate.candidate);
    for (; next < candidates_.size(); ++next) {
      const Candidate& candidate = candidates_[next];
      if (empty == 0 && candidate.squared_distance > farthest * (1.0 + EQUIDISTANT))
        break;
      if (isOnSheet (candidate, n))
        take (candidate);
    }
    neighbors.resize (size);
    return empty >= per_quadrant_ && hasEmptyQuadrant();
  }

private:
  static constexpr double EMPTY = std::numeric_limits<double>::infinity();

  struct Candidate {
    double squared_distance;
    index_t point;
    Eigen::Vector3d edge;

    bool
    operator<(const Candidate& o) const
    {
      return squared_distance != o.squared_distance
                 ? squared_distance < o.squared_distance
                 : point < o.point;
    }
  };

  struct Nearest {
    const Candidate* candidate;
    /** squared length of the difference of the two normals, which rounding changes less
     * than their cosine */
    double normal_difference;
  };

  /** \brief Whether a candidate is on the same sheet of the surface and has a polar
   * angle in the tangent plane, which it has not straight above or below.
   */
  bool
  isOnSheet (const Candidate& candidate, const Eigen::Vector3d& n) const
  {
    if (points_.normals[candidate.point].cast<double>().dot (n) < min_cosine_)
      return false;
    const double height = candidate.edge.dot (n);
    return height * height < (1.0 - 1e-6) * candidate.squared_distance;
  }

  /** \brief Finds the nearest candidate that can be a neighbour, and those as near as
   * it.
   * \return the place of the first candidate beyond
   */
  std::size_t
  findNearest (const Eigen::Vector3d& n)
  {
    nearest_candidates_.clear();
    std::size_t i = 0;
    for (; i < candidates_.size(); ++i) {
      const Candidate& candidate = candidates_[i];
      if (!nearest_candidates_.empty() &&
          candidate.squared_distance >
              nearest_candidates_.front().candidate->squared_distance *
                  (1.0 + EQUIDISTANT))
        break;
      if (isOnSheet (candidate, n))
        nearest_candidates_.push_back (
            {&candidate,
             (points_.normals[candidate.point].cast<double>() - n).squaredNorm()});
    }
    return i;
  }

  /** \brief The direction in the tangent plane of the nearest neighbour; of equidistant
   * ones that whose normal differs most, which turns with the cloud; of these, on a
   * plane, the lowest index.
   */
  Eigen::Vector3d
  axis (const Eigen::Vector3d& n) const
  {
    double most = 0.0;
    for (const Nearest& nearest : nearest_candidates_)
      most = std::max (most, nearest.normal_difference);
    constexpr double ROUNDING = 1e-12;
    const Candidate* chosen = nullptr;
    for (const Nearest& nearest : nearest_candidates_)
      if (nearest.normal_difference * (1.0 + EQUIDISTANT) + ROUNDING >= most &&
          (chosen == nullptr || nearest.candidate->point < chosen->point))
        chosen = nearest.candidate;
    return (chosen->edge - chosen->edge.dot (n) * n).normalized();
  }

  /** \brief The interval of a direction in the tangent plane: 0 is centred on the x
   * axis.
   */
  int
  interval (double x, double y) const
  {
    int away = 0;
    for (const Eigen::Vector2d& border : borders_)
      away += std::abs (y) * border.x() > x * border.y() ? 1 : 0;
    return y >= 0.0 || away == 0 ? away : intervals_ - away;
  }

  bool
  hasEmptyQuadrant () const
  {
    int run = 0;
    for (int i = 0; i < intervals_ + per_quadrant_; ++i) {
      run = nearest_[i % intervals_] == EMPTY ? run + 1 : 0;
      if (run == per_quadrant_)
        return true;
    }
    return false;
  }

  const OrientedPoints& points_;
  int intervals_;
  int per_quadrant_;
  double min_cosine_;
  /** directions of the borders between intervals above the axis */
  std::vector<Eigen::Vector2d> borders_;
  std::vector<Candidate> candidates_;
  std::vector<Nearest> nearest_candidates_;
  /** for each interval the squared distance of its nearest, or EMPTY */
  std::vector<double> nearest_;
};

} // namespace crest
} // namespace pcl
