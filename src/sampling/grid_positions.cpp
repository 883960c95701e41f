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
  std::vector<std::int64_t> places (positions.size());
  for (int axis = 0; axis < 3; ++axis) {
    std::transform (
        positions.begin(), positions.end(), places.begin(), [&] (const auto& position) {
          return std::llround (static_cast<double> (position[axis]) / (SAME * spacing));
        });
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
