// SPDX-License-Identifier: BSD-3-Clause
// Files that were packed by gzip.
#pragma once

#include <string>

namespace pcl {
namespace crest {

/** \brief Whether a file begins as those of gzip do. */
bool
isGzip (const std::string& content);

/** \brief The content that gzip packed, whose check sums have to be right; throws a
 * ReadError where they are not, or it is cut off.
 */
std::string
unpackGzip (const std::string& content);

} // namespace crest
} // namespace pcl
