// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_crest/line_smoothing.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace pcl {
namespace crest {

namespace {

/** The first round still follows the zigzag of points, which makes the arc too long. */
constexpr int ROUNDS = 3;
/** In spacings. */
constexpr double FARTHEST_MOVE = 2.0;

using Places = std::vector<Eigen::Vector3d>;

/** \brief The place at arc length 0 of a quadratic through places weighted by (1 - s^2
 * / radius^2)^2; the place in the middle itself where there are too few for one.
 */
class ArcFit {
public:
  explicit ArcFit (double radius) : radius_ (radius) {}

  void
  add (double s, const Eigen::Vector3d& place)
  {
    const double t = s / radius_;
    const double g = 1.0 - t * t;
    if (g <= 0.0)
      return;
    const Eigen::Vector3d row (1.0, t, t * t);
    matrix_ += g * g * row * row.transpose();
    right_side_ += g * g * row * place.transpose();
    ++count_;
  }

  Eigen::Vector3d
  middle (const Eigen::Vector3d& otherwise) const
  {
    constexpr int LEAST_PLACES = 4;
    if (count_ < LEAST_PLACES)
      return otherwise;
    const Eigen::Matrix3d regular =
        matrix_ + 1e-6 * matrix_ (0, 0) * Eigen::Matrix3d::Identity();
    const Eigen::Matrix3d solution = regular.llt().solve (right_side_);
    return solution.row (0).transpose();
  }

private:
  double radius_;
  Eigen::Matrix3d matrix_ = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d right_side_ = Eigen::Matrix3d::Zero();
  int count_ = 0;
};

/** \brief One round over one polyline, in coordinates around its first place. */
Places
smoothed (const Places& places, const std::vector<double>& radii, bool closed)
{
  const auto size = static_cast<std::ptrdiff_t> (places.size());
  // The first point of a closed polyline is also its last.
  const std::ptrdiff_t period = size - 1;
  Places result = places;
  for (std::ptrdiff_t i = closed ? 0 : 1; i < period; ++i) {
    ArcFit fit (radii[i]);
    fit.add (0.0, places[i]);
    for (const int direction : {1, -1}) {
      double s = 0.0;
      std::ptrdiff_t at = i;
      for (std::ptrdiff_t step = 1; step < period; ++step) {
        std::ptrdiff_t next = at + direction;
        if (closed)
          next = (next + period) % period;
        else if (next < 0 || next >= size)
          break;
        s += (places[next] - places[at]).norm();
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

} // namespace

void
smoothLines (const std::vector<CrestLine>& lines,
             const std::vector<CrestProfile>& profiles,
             const SurfaceGraph& graph,
             OrientedPoints& points)
{
  for (const CrestLine& line : lines)
    for (const std::vector<index_t>& polyline : line.polylines) {
      const bool closed = polyline.front() == polyline.back();
      const Eigen::Vector3d origin = points.positions[polyline[0]].cast<double>();
      Places places;
      std::vector<double> radii;
      for (const index_t p : polyline) {
        places.emplace_back (points.positions[p].cast<double>() - origin);
        radii.push_back (profiles[p].radius);
      }
      const Places before = places;
      for (int round = 0; round < ROUNDS; ++round)
        places = smoothed (places, radii, closed);
      for (std::size_t i = 0; i < polyline.size(); ++i) {
        if (profiles[polyline[i]].sharp)
          continue;
        const double farthest = FARTHEST_MOVE * graph.spacing[polyline[i]];
        const Eigen::Vector3d move = places[i] - before[i];
        const double length = move.norm();
        const double part = length > farthest ? farthest / length : 1.0;
        points.positions[polyline[i]] =
            (origin + before[i] + part * move).cast<float>();
      }
    }
}

} // namespace crest
} // namespace pcl
