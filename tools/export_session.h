// SPDX-License-Identifier: BSD-3-Clause
// What is on the screen as the files that the line tool writes.
#pragma once

#include "crest_session.h"

namespace pcl {
namespace crest {

/** \brief What follows the prefix in the names of the files of exportSession. */
std::vector<std::string>
exportSuffixes ();

/** \brief Writes PREFIX_labels.pcd, PREFIX_lines.ply, PREFIX_statistics.json, and into
 * PREFIX_command.txt the call of pcl_crest_line_estimation that writes the other three.
 * \param[in] session its cloud, lines and parameters
 * \param[in] input the file that the cloud came from
 * \param[in] prefix of the names
 * \param[out] error on failure what is wrong, naming the file
 */
bool
exportSession (const CrestSession& session,
               const std::string& input,
               const std::string& prefix,
               std::string& error);

} // namespace crest
} // namespace pcl
