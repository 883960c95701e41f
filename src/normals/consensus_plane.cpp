// SPDX-License-Identifier: BSD-3-Clause
#include "normals/consensus_plane.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace pcl {
namespace crest {

namespace {

/** \brief A plane through the sample, and how many neighbours are on it. */
struct Candidate {
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  int support = 0;
};

} // namespace

std::optional<Eigen::Vector3f>
consensusPlane (const Coordinates& offsets, double tolerance)
{
  // On the rim of a plate of two spacings there are a dozen.
  constexpr int LEAST = 10;
  // Where samples lie in rows, any two of these are on a plane.
  constexpr int MARGIN = 2;
  constexpr double OTHER = 0.9;
  // Pairs of these: some of them are on the face that the sample is on.
  constexpr std::size_t NEAREST = 8;
  // A plane through points nearly in a row is turned by what they are off it.
  constexpr double LEAST_SINE = 0.5;
  const auto isOn = [&] (const Eigen::Vector3d& normal, std::size_t i) {
    return std::abs (normal.x() * offsets.x[i] + normal.y() * offsets.y[i] +
                     normal.z() * offsets.z[i]) <= tolerance;
  };
  std::array<Candidate, NEAREST*(NEAREST - 1) / 2> candidates;
  std::size_t count = 0;
  const std::size_t nearest = std::min (NEAREST, offsets.size());
  for (std::size_t a = 0; a < nearest; ++a)
    for (std::size_t b = a + 1; b < nearest; ++b) {
      const Eigen::Vector3d normal = offsets[a].cross (offsets[b]);
      const double sine = normal.norm();
      if (sine <= LEAST_SINE * offsets[a].norm() * offsets[b].norm())
        continue;
      Candidate& candidate = candidates[count++];
      candidate.normal = normal / sine;
      for (std::size_t i = 0; i < offsets.size(); ++i)
        candidate.support += isOn (candidate.normal, i) ? 1 : 0;
    }
  Candidate best;
  for (std::size_t i = 0; i < count; ++i)
    if (candidates[i].support > best.support)
      best = candidates[i];
  if (best.support < LEAST)
    return std::nullopt;
  for (std::size_t i = 0; i < count; ++i)
    if (candidates[i].support > best.support - MARGIN &&
        std::abs (candidates[i].normal.dot (best.normal)) < OTHER)
      return std::nullopt;
  Scatter on;
  on.add (offsets, 0, offsets.size(), [&] (std::size_t i) {
    return isOn (best.normal, i) ? 1.0 : 0.0;
  });
  Plane plane;
  plane.normal = best.normal;
  if (!on.fitPlane (plane))
    return std::nullopt;
  return plane.normal.cast<float>();
}

} // namespace crest
} // namespace pcl
