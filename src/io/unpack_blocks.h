// SPDX-License-Identifier: BSD-3-Clause
// Arrays in VTK's XML files: bytes with their sizes before them, compressed block by
// block or not, as they are or in base64 (VTK File Formats, section 3).
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace pcl {
namespace crest {

struct BlockEncoding {
  bool big_endian = false;
  /** whether sizes have eight bytes, not four */
  bool wide_sizes = false;
  /** by zlib */
  bool compressed = false;
};

/** \brief Unpacks the array that data begin with; throws a ReadError where it has not
 * the size that is expected, before there is room for it.
 *
 * \param[in] size of the array in bytes
 *
 * \param[in] what it holds, for messages
 */
std::string
unpackRaw (std::string_view data,
           std::size_t size,
           const BlockEncoding& encoding,
           const std::string& what);

/** \brief The same for data in base64, which blanks may surround. */
std::string
unpackBase64 (std::string_view data,
              std::size_t size,
              const BlockEncoding& encoding,
              const std::string& what);

} // namespace crest
} // namespace pcl
