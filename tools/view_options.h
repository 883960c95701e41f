// SPDX-License-Identifier: BSD-3-Clause
// What is shown, as options of the viewer.
#pragma once

#include <Eigen/Core>

#include "options.h"

namespace pcl {
namespace crest {

/** \brief What the points are colored by, in the order of the keys 1 to 6. */
enum class ColorMode { SHADED, LABEL, K1, K2, BOUNDARY, FILE };

/** \brief What a window opens with, and a picture shows. */
struct ViewOptions {
  ColorMode color = ColorMode::SHADED;
  bool chart = false;
  bool directions = false;
  /** in a picture; a window always has them */
  bool sliders = false;
  /** in pixels; 0 for a surface */
  int point_size = 0;
  double opacity = 1.0;
  /** in pixels */
  double line_width = 2.5;
  /** red, green and blue up to 1 */
  Eigen::Vector3d background{1.0, 1.0, 1.0};
  /** length of the axes in the cloud's unit; 0 for none */
  double axes = 0.0;
};

constexpr int LARGEST_POINT = 64;
constexpr double THINNEST_LINE = 0.5;
constexpr double THICKEST_LINE = 20.0;

/** \brief Black or white, whichever can be read on the background. */
Eigen::Vector3d
inkOn (const Eigen::Vector3d& background);

/** \brief Adds -ps -opaque -bc -ax, which mean what they do for pcl_viewer, and -lw
 * -color -directions -chart -sliders.
 */
void
addViewOptions (Options& options, ViewOptions& view);

} // namespace crest
} // namespace pcl
