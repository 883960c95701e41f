// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <vector>

namespace pcl {
namespace crest {

/** \brief Colors of text, which does not say what their most is, as bytes: it is 1, 255
 * or 65535, the least of these that none is above. NaN becomes 0.
 */
inline std::vector<std::array<unsigned char, 3>>
colorBytes (const std::vector<std::array<float, 3>>& colors)
{
  float largest = 0.0F;
  for (const auto& color : colors)
    largest = std::max ({largest, color[0], color[1], color[2]});
  const double scale = largest <= 1.0F ? 255.0 : largest <= 255.0F ? 1.0 : 1.0 / 257.0;
  std::vector<std::array<unsigned char, 3>> all;
  all.reserve (colors.size());
  for (const auto& color : colors) {
    std::array<unsigned char, 3>& bytes = all.emplace_back();
    for (std::size_t i = 0; i < bytes.size(); ++i) {
      // Written so that NaN becomes 0.
      const double scaled = scale * static_cast<double> (color[i]) + 0.5;
      bytes[i] =
          static_cast<unsigned char> (scaled > 0.0 ? std::min (scaled, 255.0) : 0.0);
    }
  }
  return all;
}

} // namespace crest
} // namespace pcl
