// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_crest/types.h>

#include <memory>
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
 * beside them, which none but their owner may read, and renamed when all are complete
 * and on the disk, so that none is ever there in part, nor some of them alone. A
 * symbolic link is followed; one that leads nowhere is an error.
 *
 * \param[out] error on failure what is wrong, naming the file
 */
PCL_CREST_EXPORT bool
replaceFiles (const std::vector<OutputFile>& files, std::string& error);

/** \brief The same for one file. */
PCL_CREST_EXPORT bool
replaceFile (const std::string& file, const std::string& content, std::string& error);

/** \brief Files that are replaced all at once: while a group exists, what the thread
 * that made it replaces waits for commit under its other name, and is gone with the
 * group if that is not called. There is but one in a thread at a time.
 */
class PCL_CREST_EXPORT OutputGroup {
public:
  OutputGroup();
  OutputGroup (const OutputGroup&) = delete;
  OutputGroup&
  operator= (const OutputGroup&) = delete;
  ~OutputGroup();

  /** \brief Puts all files in their places, or leaves all as they were.
   * \param[out] error on failure what is wrong, naming the file
   */
  bool
  commit (std::string& error);

private:
  struct Drafts;
  friend bool
  replaceFiles (const std::vector<OutputFile>& files, std::string& error);

  std::unique_ptr<Drafts> drafts_;
};

/** \brief Has the signals that end a program, SIGHUP, SIGINT and SIGTERM, remove what
 * is written under other names before they do, and SIGXFSZ be an error of writing. For
 * programs alone.
 */
PCL_CREST_EXPORT void
cleanUpOnSignals ();

/** \brief The extension of a file name with its dot, in lower case. */
std::string
extensionOf (const std::string& file);

} // namespace crest
} // namespace pcl
