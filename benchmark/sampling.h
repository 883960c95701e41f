// SPDX-License-Identifier: BSD-3-Clause
// How a scanner may sample a surface.
#pragma once

#include "support/analytic_surface.h"

#include <string>
#include <vector>

namespace accuracy {

/** \brief Exact samples of a surface, with what the scores need. */
struct Samples {
  pcl::PointCloud<pcl::PointNormal>::Ptr cloud;
  /** the (u, v) of each */
  std::vector<Eigen::Vector2d> parameters;
  /** h: mean distance to the 6 nearest */
  double spacing;
};

/** \brief "even", "density" (falls to a tenth along x), "scan_lines" (four times as
 * dense along y as along x) or "correlated" (even; the noise is what differs).
 */
const std::vector<std::string>&
samplingNames ();

/** \brief About `count` samples. */
Samples
sampleAs (const std::string& sampling,
          const oracle::AnalyticSurface& surface,
          std::size_t count,
          unsigned seed);

/** \brief Adds noise and estimates normals, see oracle::withNoise.
 * \param[in] standard_deviation of the noise along each axis
 * \param[in] correlated smooth the noise over three spacings; its deviation is that
 * after smoothing
 * \param[in] exact_normals keep the true normals
 */
pcl::PointCloud<pcl::PointNormal>::Ptr
scan (const Samples& samples,
      double standard_deviation,
      bool correlated,
      bool exact_normals,
      unsigned seed);

} // namespace accuracy
