// SPDX-License-Identifier: BSD-3-Clause
// What colors tell about the points.
#pragma once

#include <pcl_crest/visualization/crest_scene.h>

#include "crest_session.h"
#include "view_options.h"

namespace pcl {
namespace crest {

/** \brief Colors of points, and for curvatures the scale they are read from. */
struct PointColors {
  /** one for each point of the cloud; none where all are grey */
  std::vector<CrestScene::Color> colors;
  std::string title;
  /** curvature at the deepest blue (convex) and, negative, at the deepest red; 0 where
   * colors mean no number */
  double largest = 0.0;
};

PointColors
colorPoints (const CrestSession& session, ColorMode mode);

/** \brief From red (-1, as valleys are) over light grey (0) to blue (1). */
CrestScene::Color
colorOf (double part);

} // namespace crest
} // namespace pcl
