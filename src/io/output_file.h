// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_crest/types.h>

#include <string>
#include <vector>

namespace pcl {
namespace crest {

/** \brief Whether the name of a file has one of some extensions.
 * \param[in] file the path
 * \param[in] extensions with their dots, in lower case; the name may be in upper case
 * \param[out] error if not, what would be right, naming the file
 */
PCL_CREST_EXPORT bool
hasExtension (const std::string& file,
              const std::vector<std::string>& extensions,
              std::string& error);

/** \brief Whether a file can be written, found out by creating one beside it.
 * \param[in] file the path; it need not exist
 * \param[out] error if not, what is wrong, naming the file
 */
PCL_CREST_EXPORT bool
checkWritable (const std::string& file, std::string& error);

/** \brief A file to be written. */
struct OutputFile {
  /** the path */
  std::string name;
  /** all of it */
  std::string content;
};

/** \brief Puts files in their places as a whole: they are written under other names
 * beside them and renamed when all are complete, so that none is ever there in part. A
 * symbolic link is followed.
 *
 * \param[out] error on failure what is wrong, naming the file
 */
PCL_CREST_EXPORT bool
replaceFiles (const std::vector<OutputFile>& files, std::string& error);

/** \brief The same for one file. */
PCL_CREST_EXPORT bool
replaceFile (const std::string& file, const std::string& content, std::string& error);

/** \brief The extension of a file name with its dot, in lower case. */
std::string
extensionOf (const std::string& file);

} // namespace crest
} // namespace pcl
