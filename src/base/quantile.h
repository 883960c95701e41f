// SPDX-License-Identifier: BSD-3-Clause
// Medians, quartiles and the like.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace pcl {
namespace crest {

/** \brief The value that a part of all are not above.
 * \param[in,out] values not empty; their order changes
 * \param[in] percent less than 100
 */
template <typename T>
T
quantile (std::vector<T>& values, std::size_t percent)
{
  const auto at =
      values.begin() + static_cast<std::ptrdiff_t> (values.size() * percent / 100);
  std::nth_element (values.begin(), at, values.end());
  return *at;
}

} // namespace crest
} // namespace pcl
