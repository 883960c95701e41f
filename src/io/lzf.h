// SPDX-License-Identifier: BSD-3-Clause
// The compression of PCD files: LZF (M. Lehmann, LibLZF).
#pragma once

#include <memory>
#include <string_view>

namespace pcl {
namespace crest {

/** \brief Unpacks data; throws a ReadError unless they make up just as many bytes as
 * are expected. pcl::lzfDecompress is not used because PCL's io, where it is, brings
 * along VTK and some sixty libraries, which take longer to load than most clouds take
 * to compute.
 *
 * \param[in] size of what they hold, in bytes
 */
std::unique_ptr<char[]>
unpackLzf (std::string_view data, std::size_t size);

} // namespace crest
} // namespace pcl
