// SPDX-License-Identifier: BSD-3-Clause
#include "crests/crest_prominence.h"

#include "base/parallel.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

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

  Prominence
  prominence (index_t point) const
  {
    if (profiles_[point].sharp)
      return {1.0F};
    const Eigen::Vector3f& t1 = profiles_[point].curvature.t1;
    const float k1 = std::abs (profiles_[point].curvature.k1);
    // A fit over much of a turn, and the widest of all, has an error of its own that
    // changes where data end: a pipe seen from one side would have a ridge along it.
    constexpr float WIDE_TURN = 1.0F;
    const bool widest = profiles_[point].coarsest_level;
    if ((widest || k1 * profiles_[point].radius > WIDE_TURN) &&
        (endsBeside (point, t1) || endsBeside (point, -t1)))
      return {};
    const Flank flanks[] = {flank (point, t1), flank (point, -t1)};
    // In spacings: more noise moves k1 by as much as shoulders tell.
    constexpr float LITTLE_NOISE = 0.3F;
    const float shoulders =
        profiles_[point].noise < LITTLE_NOISE * graph_.spacing[point]
            ? 1.0F - std::max (flanks[0].shoulder, flanks[1].shoulder) / k1
            : std::numeric_limits<float>::infinity();
    // Nothing is beside a crest that fills the widest.
    if (widest)
      return {1.0F, shoulders};
    // Nobody knows how far it would fall where data end.
    if (flanks[0].ends != flanks[1].ends)
      return {1.0F - flanks[flanks[0].ends ? 1 : 0].least / k1, shoulders};
    return {1.0F - std::max (flanks[0].least, flanks[1].least) / k1, shoulders};
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
    /** the mean curvature about halfway to where it is half; minus infinity if it never
     * is */
    float shoulder;
  };

  /** \brief The curvatures that are passed on the way. */
  class Passed {
  public:
    Passed (float top, double spacing) : top_ (top), spacing_ (spacing) {}

    void
    add (double distance, float k)
    {
      if (half_ == 0.0 && k < 0.5F * top_)
        half_ = distance;
      if (half_ == 0.0)
        passed_.emplace_back (distance, k);
    }

    float
    shoulder () const
    {
      // In spacings: what is narrower may be two edges, which are a crest together.
      constexpr double LEAST_HALF = 5.0;
      constexpr double FROM = 0.3;
      constexpr double TO = 0.7;
      float sum = 0.0F;
      float count = 0.0F;
      for (const auto& [distance, k] : passed_)
        if (distance > FROM * half_ && distance < TO * half_) {
          sum += k;
          count += 1.0F;
        }
      return count > 0.0F && half_ > LEAST_HALF * spacing_
                 ? sum / count
                 : -std::numeric_limits<float>::infinity();
    }

  private:
    float top_;
    double spacing_;
    double half_ = 0.0;
    std::vector<std::pair<double, float>> passed_;
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
    const index_t start = point;
    Passed passed (top, graph_.spacing[start]);
    for (int step = 0; step < MOST_STEPS && smallest >= 0.0F; ++step) {
      const index_t from = point;
      point = next (from, direction, DOWNHILL);
      if (point == OrientedPoints::INVALID)
        return {smallest,
                next (from, direction, GOES_ON) == OrientedPoints::INVALID,
                passed.shoulder()};
      if (!profiles_[point].curvature.valid)
        break;
      const CrestProfile& profile = profiles_[point];
      const float k =
          std::max (sign * profile.curvature.k1, sign * profile.curvature.k2);
      passed.add (points_.edge (start, point).norm(), k);
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
    return {smallest, false, passed.shoulder()};
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

std::vector<Prominence>
measureProminence (const OrientedPoints& points,
                   const SurfaceGraph& graph,
                   const std::vector<CrestProfile>& profiles,
                   const std::vector<CrestType>& crest_points,
                   const Workers& workers)
{
  std::vector<Prominence> prominence (points.size());
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
