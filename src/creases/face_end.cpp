// SPDX-License-Identifier: BSD-3-Clause
#include "creases/face_end.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace pcl {
namespace crest {

namespace {

constexpr double DEGREES = 180.0 / M_PI;
/** \brief What a face leaves of a full turn around a sample: at a straight edge half of
 * it, at the rim of a hole 110 degrees and more, at a corner 270. Elsewhere only as
 * much as there is between samples; on a ridge there are two.
 */
constexpr double LEAST_GAP = 110.0 / DEGREES;
constexpr double LARGEST_GAP = 200.0 / DEGREES;
constexpr double LARGEST_OTHER_GAP = 95.0 / DEGREES;

/** \brief The neighbours of a sample, from it, on and off the plane across its normal.
 */
struct Parts {
  std::vector<Eigen::Vector3d> on;
  std::vector<Eigen::Vector3d> off;

  Parts (const Coordinates& positions, const Eigen::Vector3d& normal)
  {
    // In spacings.
    constexpr double REACH = 2.1;
    constexpr double FLAT = 0.06;
    for (std::size_t i = 0; i < positions.size(); ++i) {
      const Eigen::Vector3d p = positions[i];
      if (p.squaredNorm() <= REACH * REACH)
        (std::abs (normal.dot (p)) <= FLAT ? on : off).push_back (p);
    }
  }
};

/** \brief One of a vector and its opposite, the same for both. */
Eigen::Vector3d
eitherWay (const Eigen::Vector3d& v)
{
  for (int axis = 0; axis < 3; ++axis)
    if (v[axis] != 0.0)
      return v[axis] > 0.0 ? v : Eigen::Vector3d (-v);
  return v;
}

/** \brief The way out of a face: the middle of the widest angle that holds none of its
 * points, if that is wide enough.
 */
std::optional<Eigen::Vector3d>
wayOut (const std::vector<Eigen::Vector3d>& points, const Eigen::Vector3d& normal)
{
  // Nearer ones have no direction.
  constexpr double NEAREST = 0.2;
  constexpr std::size_t LEAST_POINTS = 4;
  // Of a normal turned over they are the same to the last bit.
  const Eigen::Vector3d u = eitherWay (normal.unitOrthogonal());
  const Eigen::Vector3d v = eitherWay (normal.cross (u));
  std::vector<double> angles;
  for (const Eigen::Vector3d& p : points)
    if (p.norm() > NEAREST)
      angles.push_back (std::atan2 (v.dot (p), u.dot (p)));
  if (angles.size() < LEAST_POINTS)
    return std::nullopt;
  std::sort (angles.begin(), angles.end());
  double widest = angles.front() + 2.0 * M_PI - angles.back();
  double middle = angles.back() + 0.5 * widest;
  double second = 0.0;
  for (std::size_t i = 1; i < angles.size(); ++i) {
    const double gap = angles[i] - angles[i - 1];
    second = std::max (second, std::min (gap, widest));
    if (gap > widest) {
      widest = gap;
      middle = angles[i - 1] + 0.5 * gap;
    }
  }
  if (widest < LEAST_GAP || widest > LARGEST_GAP || second > LARGEST_OTHER_GAP)
    return std::nullopt;
  return std::cos (middle) * u + std::sin (middle) * v;
}

/** \brief What a face ends at: how far out it is at a height, by a straight line. */
struct Beyond {
  /** where it meets the face, and how far it goes out for a height of one */
  double end;
  double slope;
  bool below;
};

/** \param[in] points off the face
 * \param[in] normal, outward, along those of the face and its edge
 */
std::optional<Beyond>
fitBeyond (const std::vector<Eigen::Vector3d>& points,
           const Eigen::Vector3d& normal,
           const Eigen::Vector3d& outward,
           const Eigen::Vector3d& along)
{
  // In spacings: heights that tell a side; what is next to the sample, and not beyond
  // but behind or before the face.
  constexpr double LEAST_HEIGHT = 0.3;
  constexpr double LARGEST_HEIGHT = 1.6;
  constexpr double ASIDE = 1.2;
  constexpr double BEHIND = -0.7;
  // Parts of the points that may be on the other side, or behind.
  constexpr double STRAY_PART = 0.1;
  constexpr double BEHIND_PART = 0.2;
  // Of walls that lean over or fall away more than that some points are of something
  // else.
  constexpr double LEAST_SLOPE = -0.3;
  constexpr double LARGEST_SLOPE = 3.0;
  // Heights that differ too little for a slope.
  constexpr double LEAST_VARIANCE = 0.05;

  double below = 0.0, above = 0.0, behind = 0.0;
  double n = 0.0, h = 0.0, e = 0.0, hh = 0.0, he = 0.0;
  for (const Eigen::Vector3d& p : points) {
    const double height = std::abs (normal.dot (p));
    if (height < LEAST_HEIGHT)
      continue;
    (normal.dot (p) < 0.0 ? below : above) += 1.0;
    if (height > LARGEST_HEIGHT || std::abs (along.dot (p)) > ASIDE)
      continue;
    const double out = outward.dot (p);
    behind += out < BEHIND ? 1.0 : 0.0;
    n += 1.0;
    h += height;
    e += out;
    hh += height * height;
    he += height * out;
  }
  if (n < 2.0 || behind > BEHIND_PART * n ||
      std::min (above, below) > STRAY_PART * (above + below))
    return std::nullopt;
  const double variance = n * hh - h * h;
  const double slope =
      n > 2.0 && variance > LEAST_VARIANCE * n * n
          ? std::clamp ((n * he - h * e) / variance, LEAST_SLOPE, LARGEST_SLOPE)
          : 0.0;
  return Beyond{(e - slope * h) / n, slope, below > above};
}

} // namespace

std::optional<FaceEnd>
fitFaceEnd (const Coordinates& positions, const Eigen::Vector3d& own)
{
  constexpr std::size_t LEAST_OFF = 4;
  constexpr double FARTHEST = 1.0;
  const Parts parts (positions, own);
  if (parts.off.size() < LEAST_OFF)
    return std::nullopt;
  const auto outward = wayOut (parts.on, own);
  if (!outward)
    return std::nullopt;
  const Eigen::Vector3d along = own.cross (*outward);
  const auto beyond = fitBeyond (parts.off, own, *outward, along);
  if (!beyond || !(std::abs (beyond->end) <= FARTHEST))
    return std::nullopt;
  const Eigen::Vector3d other =
      (beyond->slope * own + (beyond->below ? 1.0 : -1.0) * *outward).normalized();
  const auto squares = [&own] (const std::vector<Eigen::Vector3d>& points) {
    double sum = 0.0;
    for (const Eigen::Vector3d& p : points)
      sum += own.dot (p) * own.dot (p);
    return sum;
  };
  const double of_on = squares (parts.on);
  return FaceEnd{beyond->end * *outward,
                 along,
                 (own + other).normalized(),
                 std::acos (std::clamp (own.dot (other), -1.0, 1.0)) * DEGREES,
                 beyond->below,
                 of_on / static_cast<double> (parts.on.size()),
                 (of_on + squares (parts.off)) /
                     static_cast<double> (parts.on.size() + parts.off.size())};
}

} // namespace crest
} // namespace pcl
