// SPDX-License-Identifier: BSD-3-Clause
#include "sampling/grid_positions.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace pcl {
namespace crest {

bool
lieOnGrid (const std::vector<Eigen::Vector3f>& positions, double spacing)
{
  constexpr double LEAST_STEP = 0.5;
  // What one step comes to in floats differs by their rounding, but not by as much as
  // this part of a spacing.
  constexpr double SAME = 1e-3;
  // More samples for each spacing along an axis tell nothing new of a grid, and all of
  // a large cloud would leave no gaps that are wider than the rounding.
  constexpr double MOST_FOR_A_SPACING = 256.0;
  std::vector<std::int64_t> places;
  for (int axis = 0; axis < 3; ++axis) {
    const auto [low, high] = std::minmax_element (
        positions.begin(),
        positions.end(),
        [axis] (const Eigen::Vector3f& a, const Eigen::Vector3f& b) {
          return a[axis] < b[axis];
        });
    const double length =
        (static_cast<double> ((*high)[axis]) - static_cast<double> ((*low)[axis])) /
        spacing;
    const auto step = static_cast<std::size_t> (
        std::max (1.0,
                  static_cast<double> (positions.size()) /
                      (MOST_FOR_A_SPACING * std::max (1.0, length))));
    places.clear();
    for (std::size_t i = 0; i < positions.size(); i += step)
      places.push_back (
          std::llround (static_cast<double> (positions[i][axis]) / (SAME * spacing)));
    std::sort (places.begin(), places.end());
    const double extent = SAME * static_cast<double> (places.back() - places.front());
    double steps = 0.0;
    for (std::size_t i = 1; i < places.size(); ++i)
      steps += places[i] - places[i - 1] > 1 ? 1.0 : 0.0;
    if (extent < LEAST_STEP * steps)
      return false;
  }
  return true;
}

} // namespace crest
} // namespace pcl
