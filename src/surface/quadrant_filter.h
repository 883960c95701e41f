// SPDX-License-Identifier: BSD-3-Clause
// Paper, section 4.1: of the candidates around a point those that get an edge with it.
#pragma once

#include <Eigen/Geometry>

#include "surface/neighbor_search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace pcl {
namespace crest {

/** \brief Chooses the nearest candidates in each angular interval of the tangent plane
 * (see buildSurfaceGraph). One such object belongs to one thread.
 *
 * Of all candidates the same is asked at once, coordinate by coordinate, in loops that
 * a compiler turns into vector instructions. Floats will do, as all limits that
 * scanners and meshers are apt to meet exactly, equal distances, right angles and
 * borders of intervals, have a slack that outlasts their rounding.
 */
class QuadrantFilter {
public:
  QuadrantFilter (const OrientedPoints& points, const Parameters& parameters)
  : points_ (points)
  , scale_ (scaleOf (points.unit))
  , intervals_ (4 * parameters.points_per_quadrant)
  , per_quadrant_ (parameters.points_per_quadrant)
  // A jump is an angle above the limit.
  , min_cosine_ (static_cast<float> (
        std::cos (parameters.max_normal_angle * M_PI / 180.0) - SLACK))
  {
    // Borders belong to the side nearer to the axis.
    const double width = 2.0 * M_PI / intervals_;
    for (int i = 0; i < intervals_ / 2; ++i) {
      const double angle = (i + 0.5) * width + SLACK;
      borders_.emplace_back (static_cast<float> (std::cos (angle)),
                             static_cast<float> (std::sin (angle)));
    }
  }

  /** \brief Sorts the found points by distance, then index; drops the point itself. */
  void
  rank (index_t point, const std::vector<index_t>& found)
  {
    candidates_.resize (found.size());
    std::size_t count = 0;
    for (const index_t q : found) {
      candidates_[count] = q;
      count += q != point ? 1 : 0;
    }
    candidates_.resize (count);
    gather (point);
    // The batched search finds them in this order but for rounding.
    if (!isRanked())
      sort (point);
  }

  /** \brief Mean distance of the ranked point from the 6 nearest, in the cloud's unit.
   * In doubles, which do not vanish beside a point that is very far away.
   */
  double
  spacing (index_t point) const
  {
    const std::size_t count = std::min<std::size_t> (6, candidates_.size());
    double sum = 0.0;
    for (std::size_t i = 0; i < count; ++i)
      sum += points_.edge (point, candidates_[i]).norm();
    return count == 0 ? 0.0 : sum / static_cast<double> (count);
  }

  /** \brief Appends the neighbours of the ranked point; returns whether it lies on the
   * boundary.
   */
  bool
  select (index_t point, std::vector<index_t>& neighbors)
  {
    findSheet (points_.normals[point]);
    const std::size_t count = candidates_.size();
    std::size_t i = 0;
    while (i < count && on_sheet_[i] == 0)
      ++i;
    if (i == count)
      return true;
    findIntervals (points_.normals[point], i);
    nearest_.assign (intervals_, EMPTY);
    int empty = intervals_;
    float farthest = 0.0F;
    std::size_t size = neighbors.size();
    neighbors.resize (size + count);
    for (; i < count && (empty > 0 || squared_[i] <= farthest * WITHIN); ++i) {
      if (on_sheet_[i] == 0)
        continue;
      // What becomes of a candidate is as good as random: there is no branch for it.
      float& nearest = nearest_[interval_[i]];
      farthest = empty > 0 ? squared_[i] : farthest;
      empty -= static_cast<int> (nearest == EMPTY);
      nearest = std::min (nearest, squared_[i]);
      neighbors[size] = candidates_[i];
      size += static_cast<std::size_t> (squared_[i] <= nearest * WITHIN);
    }
    neighbors.resize (size);
    return empty >= per_quadrant_ && hasEmptyQuadrant();
  }

private:
  static constexpr float EMPTY = std::numeric_limits<float>::infinity();
  /** More than floats are rounded by. */
  static constexpr double SLACK = 1e-6;
  static constexpr auto WITHIN = static_cast<float> (1.0 + EQUIDISTANT);
  /** Loops over candidates go on to a multiple of this. */
  static constexpr std::size_t STEP = 8;

  /** \brief What coordinates are multiplied by, so that their squares fit into floats:
   * the inverse of the unit as far as that is a float itself.
   */
  static float
  scaleOf (double unit)
  {
    constexpr float LARGEST = 0x1p125F;
    return static_cast<float> (std::min<double> (LARGEST, 1.0 / unit));
  }

  /** \brief Sets what is known of each candidate. */
  void
  gather (index_t point)
  {
    const std::size_t count = candidates_.size();
    const std::size_t padded = paddedCount();
    for (auto* values : {&x_, &y_, &z_, &squared_, &normal_x_, &normal_y_, &normal_z_})
      values->resize (std::max (padded, values->size()));
    on_sheet_.resize (squared_.size());
    interval_.resize (squared_.size());
    float* const x = x_.data();
    float* const y = y_.data();
    float* const z = z_.data();
    float* const squared = squared_.data();
    float* const normal_x = normal_x_.data();
    float* const normal_y = normal_y_.data();
    float* const normal_z = normal_z_.data();
    const index_t* const candidates = candidates_.data();
    const Eigen::Vector3f* const positions = points_.positions.data();
    const Eigen::Vector3f* const normals = points_.normals.data();
    for (std::size_t i = 0; i < count; ++i) {
      const Eigen::Vector3f& q = positions[candidates[i]];
      x[i] = q.x();
      y[i] = q.y();
      z[i] = q.z();
      const Eigen::Vector3f& m = normals[candidates[i]];
      normal_x[i] = m.x();
      normal_y[i] = m.y();
      normal_z[i] = m.z();
    }
    for (std::size_t i = count; i < padded; ++i)
      x[i] = y[i] = z[i] = normal_x[i] = normal_y[i] = normal_z[i] = 0.0F;
    // As products with a power of two are exact, differences are rounded but once.
    const float scale = scale_;
    const Eigen::Vector3f p = scale * points_.positions[point];
    for (std::size_t i = 0; i < padded; ++i) {
      x[i] = x[i] * scale - p.x();
      y[i] = y[i] * scale - p.y();
      z[i] = z[i] * scale - p.z();
      squared[i] = (x[i] * x[i] + y[i] * y[i]) + z[i] * z[i];
    }
  }

  bool
  isRanked () const
  {
    const float* const squared = squared_.data();
    const index_t* const candidates = candidates_.data();
    int unranked = 0;
    for (std::size_t i = 1; i < candidates_.size(); ++i)
      unranked |= static_cast<int> (squared[i - 1] > squared[i]) |
                  (static_cast<int> (squared[i - 1] == squared[i]) &
                   static_cast<int> (candidates[i - 1] >= candidates[i]));
    return unranked == 0;
  }

  void
  sort (index_t point)
  {
    std::vector<std::pair<float, index_t>> order;
    for (std::size_t i = 0; i < candidates_.size(); ++i)
      order.emplace_back (squared_[i], candidates_[i]);
    std::sort (order.begin(), order.end());
    // A search over the raw cloud may find a sample twice, as two coincident points.
    order.erase (std::unique (order.begin(), order.end()), order.end());
    candidates_.clear();
    for (const auto& [squared, q] : order)
      candidates_.push_back (q);
    gather (point);
  }

  /** \brief Tells which candidates are on the same sheet of the surface and have a
   * polar angle in the tangent plane, which they have not straight above or below.
   */
  void
  findSheet (const Eigen::Vector3f& n)
  {
    constexpr auto STEEP = static_cast<float> (1.0 - SLACK);
    const float* const x = x_.data();
    const float* const y = y_.data();
    const float* const z = z_.data();
    const float* const squared = squared_.data();
    const float* const normal_x = normal_x_.data();
    const float* const normal_y = normal_y_.data();
    const float* const normal_z = normal_z_.data();
    int* const on_sheet = on_sheet_.data();
    const float min_cosine = min_cosine_;
    const std::size_t padded = paddedCount();
    for (std::size_t i = 0; i < padded; ++i) {
      const float cosine =
          normal_x[i] * n.x() + normal_y[i] * n.y() + normal_z[i] * n.z();
      const float height = x[i] * n.x() + y[i] * n.y() + z[i] * n.z();
      on_sheet[i] = static_cast<int> (cosine >= min_cosine) &
                    static_cast<int> (height * height < STEEP * squared[i]);
    }
  }

  /** \brief Finds the interval of each candidate: 0 is centred on the axis.
   * \param[in] first of those on the sheet
   */
  void
  findIntervals (const Eigen::Vector3f& n, std::size_t first)
  {
    const Eigen::Vector3f x = axis (n.cast<double>(), first).cast<float>();
    const Eigen::Vector3f y = n.cross (x);
    const float* const ex = x_.data();
    const float* const ey = y_.data();
    const float* const ez = z_.data();
    int* const interval = interval_.data();
    const int intervals = intervals_;
    const std::size_t padded = paddedCount();
    for (std::size_t i = 0; i < padded; i += STEP) {
      float u[STEP];
      float v[STEP];
      int away[STEP] = {};
      for (std::size_t j = 0; j < STEP; ++j) {
        u[j] = ex[i + j] * x.x() + ey[i + j] * x.y() + ez[i + j] * x.z();
        v[j] = ex[i + j] * y.x() + ey[i + j] * y.y() + ez[i + j] * y.z();
      }
      for (const Eigen::Vector2f& border : borders_)
        for (std::size_t j = 0; j < STEP; ++j)
          away[j] +=
              static_cast<int> (std::abs (v[j]) * border.x() > u[j] * border.y());
      for (std::size_t j = 0; j < STEP; ++j) {
        const int below =
            static_cast<int> (v[j] < 0.0F) & static_cast<int> (away[j] != 0);
        interval[i + j] = away[j] + (-below & (intervals - 2 * away[j]));
      }
    }
  }

  /** \brief The direction in the tangent plane of the nearest neighbour; of equidistant
   * ones that whose normal differs most, which turns with the cloud; of these, on a
   * plane, the lowest index.
   * \param[in] first of the candidates on the sheet
   */
  Eigen::Vector3d
  axis (const Eigen::Vector3d& n, std::size_t first) const
  {
    const auto isNearest = [&] (std::size_t i) {
      return i < candidates_.size() && squared_[i] <= squared_[first] * WITHIN;
    };
    // Rounding changes the difference of two normals less than their cosine.
    const auto difference = [&] (std::size_t i) {
      const Eigen::Vector3d m (normal_x_[i], normal_y_[i], normal_z_[i]);
      return (m - n).squaredNorm();
    };
    std::size_t chosen = first;
    if (isNearest (first + 1)) {
      double most = 0.0;
      for (std::size_t i = first; isNearest (i); ++i)
        if (on_sheet_[i] != 0)
          most = std::max (most, difference (i));
      constexpr double ROUNDING = 1e-12;
      const auto differsMost = [&] (std::size_t i) {
        return difference (i) * (1.0 + EQUIDISTANT) + ROUNDING >= most;
      };
      for (std::size_t i = first; isNearest (i); ++i)
        if (on_sheet_[i] != 0 && differsMost (i) &&
            (!differsMost (chosen) || candidates_[i] < candidates_[chosen]))
          chosen = i;
    }
    const Eigen::Vector3d edge (x_[chosen], y_[chosen], z_[chosen]);
    return (edge - edge.dot (n) * n).normalized();
  }

  std::size_t
  paddedCount () const
  {
    return (candidates_.size() + STEP - 1) / STEP * STEP;
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
  float scale_;
  int intervals_;
  int per_quadrant_;
  float min_cosine_;
  /** directions of the borders between intervals above the axis */
  std::vector<Eigen::Vector2f> borders_;
  std::vector<index_t> candidates_;
  /** of each candidate the way to it and the square of that, in the unit; its normal;
   * whether it is on the sheet, and its interval */
  std::vector<float> x_, y_, z_, squared_;
  std::vector<float> normal_x_, normal_y_, normal_z_;
  std::vector<int> on_sheet_;
  std::vector<int> interval_;
  /** for each interval the squared distance of its nearest, or EMPTY */
  std::vector<float> nearest_;
};

} // namespace crest
} // namespace pcl
