// SPDX-License-Identifier: BSD-3-Clause
// Cameras, and pictures of what they see.
#pragma once

#include <pcl_crest/types.h>

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <Eigen/Core>

#include <vtkCamera.h>
#include <vtkRenderWindow.h>

#include <string>

namespace pcl {
namespace crest {

/** \brief The largest side of a window, in pixels: that of a texture that every OpenGL
 * renderer has.
 */
constexpr int LARGEST_WINDOW = 8192;

/** \brief A camera and the window it looks through, as pcl_viewer saves them. */
struct View {
  /** distances of the near and far clipping planes */
  Eigen::Vector2d clip;
  Eigen::Vector3d focal_point;
  Eigen::Vector3d position;
  Eigen::Vector3d up;
  /** vertical field of view in radians */
  double field_of_view = 0.0;
  Eigen::Vector2i window_size;
  Eigen::Vector2i window_position;
};

/** \brief The view that fills a window with the cloud, looking along the axis of its
 * least extent, where most of it can be seen.
 *
 * Of the two ends of this axis it looks from the one that the normals face: surfaces
 * that are open, as terrain or the view of one sensor, show their good side. Closed
 * ones are seen from the positive end of x or z, or the negative one of y, whence x
 * goes to the right. Up is y (z when looking along y), the way models stand, and north
 * on maps; but -y seen from the negative end of z, where depth cameras are.
 */
PCL_CREST_EXPORT View
fitView (const pcl::PointCloud<pcl::PointNormal>& cloud,
         const Eigen::Vector2i& window_size);

/** \brief Reads a view from what pcl_viewer takes with -cam: a file it saved, or the
 * text in it, "near,far/focal point/position/up/field of view/window size/window
 * position".
 *
 * \param[in] text the text or the name of the file
 * \param[out] view untouched on failure
 * \param[out] error on failure what would be right
 * \return whether it is a view
 */
PCL_CREST_EXPORT bool
readView (const std::string& text, View& view, std::string& error);

/** \brief Makes the camera look as the view does. */
PCL_CREST_EXPORT void
setCamera (const View& view, vtkCamera& camera);

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
