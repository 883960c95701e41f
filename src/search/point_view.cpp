// SPDX-License-Identifier: BSD-3-Clause
#include "search/point_view.h"

#include <stdexcept>
#include <string>

namespace pcl {
namespace crest {

void
checkPoints (const PointView& cloud)
{
  if (cloud.size > MOST_POINTS)
    throw std::invalid_argument (
        "A cloud of " + std::to_string (cloud.size) +
        " points is too large for 32-bit indices, which tell " +
        std::to_string (MOST_POINTS) +
        " points apart: compute it in parts that overlap");
  if (cloud.size > 0 && cloud.position == nullptr)
    throw std::invalid_argument (
        "The cloud has no positions: point to three floats of each");
  if (cloud.size > 1 && cloud.stride < 3)
    throw std::invalid_argument ("The stride of the cloud is " +
                                 std::to_string (cloud.stride) +
                                 ", but must be at least 3 floats");
  if (cloud.size > 1 && cloud.normal != nullptr && cloud.normal_stride != 0 &&
      cloud.normal_stride < 3)
    throw std::invalid_argument ("The stride of the normals is " +
                                 std::to_string (cloud.normal_stride) +
                                 ", but must be at least 3 floats");
}

} // namespace crest
} // namespace pcl
