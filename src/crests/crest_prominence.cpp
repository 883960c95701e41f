// SPDX-License-Identifier: BSD-3-Clause
#include "crests/crest_prominence.h"

#include "base/parallel.h"

#include <algorithm>
#include <cmath>

namespace pcl {
namespace crest {

namespace {

class ProminenceWalk {
public:
  ProminenceWalk (const OrientedPoints& points,
                  const SurfaceGraph& graph,
                  const std::vector<CrestProfile>& profiles)
  : points_ (points), graph_ (graph), profiles_ (profiles)
  {}

  float
  prominence (index_t point) const
  {
    if (profiles_[point].sharp)
      return 1.0F;
    const Eigen::Vector3f& t1 = profiles_[point].curvature.t1;
    const float k1 = std::abs (profiles_[point].curvature.k1);
    // A fit over much of a turn, and the widest of all, has an error of its own that
    // changes where data end: a pipe seen from one side would have a ridge along it.
    constexpr float WIDE_TURN = 1.0F;
    const bool widest = profiles_[point].coarsest_level;
    if ((widest || k1 * profiles_[point].radius > WIDE_TURN) &&
        (endsBeside (point, t1) || endsBeside (point, -t1)))
      return 0.0F;
    // Nothing is beside a crest that fills the widest.
    if (widest)
      return 1.0F;
    const Flank flanks[] = {flank (point, t1), flank (point, -t1)};
    // Nobody knows how far it would fall where data end.
    if (flanks[0].ends != flanks[1].ends)
      return 1.0F - flanks[flanks[0].ends ? 1 : 0].least / k1;
    return 1.0F - std::max (flanks[0].least, flanks[1].least) / k1;
  }

private:
  /** Wider than any crest that is not of the coarsest level, and than any fit. */
  static constexpr int MOST_STEPS = 40;
  /** Wider than a walk needs: a gap by chance is no end. */
  static constexpr double GOES_ON = 0.5;

  /** \brief Whether the data end in a direction within reach of the fits that made the
   * profile: those around the point, which reach as far as its own again.
   */
  bool
  endsBeside (index_t point, Eigen::Vector3f direction) const
  {
    const index_t start = point;
    constexpr float REACH = 1.5F;
    const float reach = REACH * profiles_[start].radius;
    for (int step = 0; step < MOST_STEPS && points_.edge (start, point).norm() < reach;
         ++step) {
      point = next (point, direction, GOES_ON);
      if (point == OrientedPoints::INVALID)
        return true;
      const Eigen::Vector3f& n = points_.normals[point];
      direction = (direction - direction.dot (n) * n).normalized();
    }
    return false;
  }

  struct Flank {
    /** the smallest curvature of the point's sign on the way downhill */
    float least;
    /** whether the data end on that way */
    bool ends;
  };

  Flank
  flank (index_t point, Eigen::Vector3f direction) const
  {
    // The next crest has begun.
    constexpr float RISE = 0.25F;
    constexpr double DOWNHILL = 0.6;
    // Along t1 of what is passed as long as that goes on in about the same direction.
    constexpr float SAME_DIRECTION = 0.8F;

    const float top = std::abs (profiles_[point].curvature.k1);
    const float sign = profiles_[point].curvature.k1 > 0.0F ? 1.0F : -1.0F;
    float smallest = top;
    for (int step = 0; step < MOST_STEPS && smallest >= 0.0F; ++step) {
      const index_t from = point;
      point = next (from, direction, DOWNHILL);
      if (point == OrientedPoints::INVALID)
        return {smallest, next (from, direction, GOES_ON) == OrientedPoints::INVALID};
      if (!profiles_[point].curvature.valid)
        break;
      const CrestProfile& profile = profiles_[point];
      const float k =
          std::max (sign * profile.curvature.k1, sign * profile.curvature.k2);
      if (k > smallest + RISE * top)
        break;
      smallest = std::min (smallest, k);
      const float turn = profile.curvature.t1.dot (direction);
      if (std::abs (turn) > SAME_DIRECTION)
        direction = turn > 0.0F ? profile.curvature.t1
                                : Eigen::Vector3f (-profile.curvature.t1);
      else
        direction =
            (direction - direction.dot (profile.normal) * profile.normal).normalized();
    }
    return {smallest, false};
  }

  /** \brief The neighbour closest to a direction, if nearer than a cosine. */
  index_t
  next (index_t point, const Eigen::Vector3f& direction, double least_cosine) const
  {
    double best_cosine = least_cosine;
    index_t best = OrientedPoints::INVALID;
    for (const index_t q : graph_.star (point)) {
      const Eigen::Vector3d e = points_.edge (point, q);
      const double cosine = e.dot (direction.cast<double>()) / e.norm();
      if (cosine > best_cosine) {
        best_cosine = cosine;
        best = q;
      }
    }
    return best;
  }

  const OrientedPoints& points_;
  const SurfaceGraph& graph_;
  const std::vector<CrestProfile>& profiles_;
};

} // namespace

std::vector<float>
measureProminence (const OrientedPoints& points,
                   const SurfaceGraph& graph,
                   const std::vector<CrestProfile>& profiles,
                   const std::vector<CrestType>& crest_points,
                   const Workers& workers)
{
  std::vector<float> prominence (points.size(), 0.0F);
  const ProminenceWalk walk (points, graph, profiles);
  forEachBlock (
      points.size(), workers, [&] (std::size_t, std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i)
          if (crest_points[i] != CrestType::NONE)
            prominence[i] = walk.prominence (static_cast<index_t> (i));
      });
  return prominence;
}

} // namespace crest
} // namespace pcl
