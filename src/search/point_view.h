// SPDX-License-Identifier: BSD-3-Clause
// Whether a cloud can be searched at all.
#pragma once

#include <pcl_crest/input.h>

namespace pcl {
namespace crest {

/** \brief Checks that there are positions, not too many of them.
 *
 * \throw std::invalid_argument in words for the user
 */
void
checkPoints (const PointView& cloud);

} // namespace crest
} // namespace pcl
