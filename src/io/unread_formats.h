// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace pcl {
namespace crest {

/** \brief How to convert a file of a format that is known but not read: LAZ, COPC, E57.
 * \param[in] file the path
 * \param[in] extension of its name, in lower case, with its dot
 * \param[in] text its content
 * \return empty if it is of none of these
 */
std::string
explainUnread (const std::string& file,
               const std::string& extension,
               const std::string& text);

} // namespace crest
} // namespace pcl
