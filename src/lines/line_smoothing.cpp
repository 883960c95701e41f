// SPDX-License-Identifier: BSD-3-Clause
#include "lines/line_smoothing.h"

#include <Eigen/Core>

#include "base/parallel.h"

namespace pcl {
namespace crest {

namespace {

/** The first round still follows the zigzag of points, which makes the arc too long. */
constexpr int ROUNDS = 3;
/** In spacings. */
constexpr double FARTHEST_MOVE = 2.0;

/** With 1 as their fourth coordinate: sums of places then count what they sum. */
using Places = std::vector<Eigen::Vector4d>;

/** \brief The place at arc length 0 of a quadratic through places weighted by (1 - s^2
 * / radius^2)^2; the place in the middle itself where there are too few for one.
 */
class ArcFit {
public:
  explicit ArcFit (double radius) : inverse_radius_ (1.0 / radius) {}

  void
  add (double s, const Eigen::Vector4d& place)
  {
    const double t = s * inverse_radius_;
    const double t2 = t * t;
    const double g = 1.0 - t2;
    if (g <= 0.0)
      return;
    const Eigen::Vector4d weighted = g * g * place;
    sum_ += weighted;
    sum_t_ += t * weighted;
    sum_t2_ += t2 * weighted;
    sum_t3_ += t * t2 * weighted.w();
    sum_t4_ += t2 * t2 * weighted.w();
    ++count_;
  }

  Eigen::Vector4d
  middle (const Eigen::Vector4d& otherwise) const
  {
    constexpr int LEAST_PLACES = 4;
    if (count_ < LEAST_PLACES)
      return otherwise;
    // By the first row of the inverse of the normal equations' matrix, which are minors
    // but for a factor.
    const double regular = 1e-6 * sum_.w();
    const double m01 = sum_t_.w();
    const double m02 = sum_t2_.w();
    const double m11 = m02 + regular;
    const double m12 = sum_t3_;
    const double m22 = sum_t4_ + regular;
    const double minor0 = m11 * m22 - m12 * m12;
    const double minor1 = m02 * m12 - m01 * m22;
    const double minor2 = m01 * m12 - m02 * m11;
    const Eigen::Vector4d place = minor0 * sum_ + minor1 * sum_t_ + minor2 * sum_t2_;
    return place / place.w();
  }

private:
  double inverse_radius_;
  Eigen::Vector4d sum_ = Eigen::Vector4d::Zero();
  Eigen::Vector4d sum_t_ = Eigen::Vector4d::Zero();
  Eigen::Vector4d sum_t2_ = Eigen::Vector4d::Zero();
  double sum_t3_ = 0.0;
  double sum_t4_ = 0.0;
  int count_ = 0;
};

/** \brief One round over one polyline, in coordinates around its first place. */
Places
smoothed (const Places& places, const std::vector<double>& radii, bool closed)
{
  const auto size = static_cast<std::ptrdiff_t> (places.size());
  // The first point of a closed polyline is also its last.
  const std::ptrdiff_t period = size - 1;
  std::vector<double> to_next;
  for (std::ptrdiff_t i = 0; i < period; ++i)
    to_next.push_back ((places[i + 1] - places[i]).norm());
  Places result = places;
  for (std::ptrdiff_t i = closed ? 0 : 1; i < period; ++i) {
    ArcFit fit (radii[i]);
    fit.add (0.0, places[i]);
    for (const int direction : {1, -1}) {
      double s = 0.0;
      std::ptrdiff_t at = i;
      for (std::ptrdiff_t step = 1; step < period; ++step) {
        std::ptrdiff_t next = at + direction;
        if (closed && next == period)
          next = 0;
        else if (closed && next < 0)
          next = period - 1;
        else if (next < 0 || next >= size)
          break;
        s += to_next[direction > 0 ? at : next];
        if (s >= radii[i])
          break;
        fit.add (direction * s, places[next]);
        at = next;
      }
    }
    result[i] = fit.middle (places[i]);
  }
  if (closed)
    result[period] = result[0];
  return result;
}

/** \brief Moves the points of one polyline. */
class PolylineSmoother {
public:
  /** \param[in] closed whether it is a loop that nothing else meets */
  PolylineSmoother (const std::vector<index_t>& polyline,
                    bool closed,
                    const std::vector<CrestProfile>& profiles,
                    const SurfaceGraph& graph,
                    const std::vector<Eigen::Vector3f>& positions)
  : polyline_ (polyline)
  , closed_ (closed)
  , profiles_ (profiles)
  , graph_ (graph)
  , positions_ (positions)
  {}

  /** \brief Where the points are moved to. */
  std::vector<Eigen::Vector3f>
  places () const
  {
    const Eigen::Vector3d origin = positions_[polyline_[0]].cast<double>();
    Places places;
    std::vector<double> radii;
    for (const index_t p : polyline_) {
      Eigen::Vector4d& place = places.emplace_back();
      place << positions_[p].cast<double>() - origin, 1.0;
      radii.push_back (profiles_[p].radius);
    }
    for (int round = 0; round < ROUNDS; ++round)
      places = smoothed (places, radii, closed_);
    std::vector<Eigen::Vector3f> moved;
    for (std::size_t i = 0; i < polyline_.size(); ++i)
      moved.push_back (allowed (i, origin + places[i].head<3>()));
    unfold (moved);
    return moved;
  }

private:
  /** \brief Where a point may go instead of a place. */
  Eigen::Vector3f
  allowed (std::size_t i, const Eigen::Vector3d& place) const
  {
    const index_t p = polyline_[i];
    if (profiles_[p].sharp)
      return positions_[p];
    const Eigen::Vector3d before = positions_[p].cast<double>();
    const Eigen::Vector3d move = place - before;
    const double farthest = FARTHEST_MOVE * graph_.spacing[p];
    const double length = move.norm();
    const double part = length > farthest ? farthest / length : 1.0;
    return (before + part * move).cast<float>();
  }

  /** \brief Takes back what is left of folds, where points are out of order: no smooth
   * crest turns back within a spacing. Each point at which the polyline does goes to
   * the middle of its neighbours.
   */
  void
  unfold (std::vector<Eigen::Vector3f>& places) const
  {
    constexpr int MOST_ROUNDS = 8;
    const std::size_t period = places.size() - 1;
    bool folded = true;
    for (int round = 0; round < MOST_ROUNDS && folded; ++round) {
      folded = false;
      for (std::size_t i = closed_ ? 0 : 1; i < period; ++i) {
        const Eigen::Vector3d here = places[i].cast<double>();
        const Eigen::Vector3d before =
            places[i > 0 ? i - 1 : period - 1].cast<double>();
        const Eigen::Vector3d after = places[i + 1].cast<double>();
        if ((here - before).dot (after - here) >= 0.0)
          continue;
        places[i] = allowed (i, 0.5 * (before + after));
        folded = true;
      }
      if (closed_)
        places[period] = places[0];
    }
  }

  const std::vector<index_t>& polyline_;
  bool closed_;
  const std::vector<CrestProfile>& profiles_;
  const SurfaceGraph& graph_;
  const std::vector<Eigen::Vector3f>& positions_;
};

} // namespace

std::vector<LinePlaces>
smoothLines (const std::vector<CrestLine>& lines,
             const std::vector<CrestProfile>& profiles,
             const SurfaceGraph& graph,
             const std::vector<Eigen::Vector3f>& positions,
             unsigned threads)
{
  struct Task {
    const std::vector<index_t>& polyline;
    bool closed;
    std::vector<Eigen::Vector3f>& places;
  };
  std::vector<LinePlaces> places;
  for (const CrestLine& line : lines)
    places.emplace_back (line.polylines.size());
  std::vector<Task> tasks;
  for (std::size_t i = 0; i < lines.size(); ++i)
    for (std::size_t j = 0; j < places[i].size(); ++j)
      tasks.push_back ({lines[i].polylines[j], lines[i].closed, places[i][j]});
  const auto count = static_cast<std::ptrdiff_t> (tasks.size());
  ThreadFailure failure;
#pragma omp parallel for schedule(dynamic) num_threads(threadCount(threads))
  for (std::ptrdiff_t i = 0; i < count; ++i)
    failure.guard ([&] {
      const Task& task = tasks[i];
      task.places =
          PolylineSmoother (task.polyline, task.closed, profiles, graph, positions)
              .places();
    });
  failure.rethrow();
  return places;
}

void
movePoints (const CrestLine& line,
            const LinePlaces& places,
            std::vector<Eigen::Vector3f>& positions)
{
  for (std::size_t i = 0; i < places.size(); ++i)
    for (std::size_t j = 0; j < places[i].size(); ++j)
      positions[line.polylines[i][j]] = places[i][j];
}

} // namespace crest
} // namespace pcl
