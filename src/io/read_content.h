// SPDX-License-Identifier: BSD-3-Clause
// From the name of a file to its content, by the reader of its format.
#pragma once

#include <pcl_crest/io/read_cloud.h>

#include "io/file_content.h"

#include <string>

namespace pcl {
namespace crest {

/** \brief Reads a file of any format; throws a ReadError.
 * \param[in] file the path
 * \param[in] options of the format
 */
FileContent
readContent (const std::string& file, const ReadOptions& options);

/** \brief The same of a file whose bytes are in memory. */
FileContent
parseContent (const std::string& file, std::string text, const ReadOptions& options);

} // namespace crest
} // namespace pcl
