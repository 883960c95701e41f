// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_crest/export.h>

#include <vtkRenderWindow.h>

#include <string>

namespace pcl {
namespace crest {

/** \brief Whether VTK can open a window, or render without one. It needs an X display
 * with OpenGL 3.2 for both and ends the program, or paints all black, where there is
 * none: so ask first.
 *
 * \param[out] error if not, what is missing and what would help
 */
PCL_CREST_EXPORT bool
canRender (std::string& error);

/** \brief Renders.
 * \param[in] window may be off the screen
 * \return the content of a PNG file
 */
PCL_CREST_EXPORT std::string
renderPicture (vtkRenderWindow& window);

} // namespace crest
} // namespace pcl
