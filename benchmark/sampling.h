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
 * dense along y as along x), and even ones that are scanned otherwise: "correlated"
 * noise, "exact_normals".
 */
const std::vector<std::string>&
samplingNames ();

/** \brief About `count` samples. */
Samples
sampleAs (const std::string& sampling,
          const oracle::AnalyticSurface& surface,
          std::size_t count,
          unsigned seed);

/** \brief How a scan differs from exact samples. */
struct Scan {
  /** standard deviation of the noise along each axis */
  double noise;
  /** smooth the noise with a Gaussian of this spread, to the same deviation; 0 leaves
   * it independent */
  double spread;
  /** keep the true normals instead of estimating them (see oracle::withNoise) */
  bool exact_normals;
  unsigned seed;
};

pcl::PointCloud<pcl::PointNormal>::Ptr
scan (const pcl::PointCloud<pcl::PointNormal>& exact, const Scan& how);

} // namespace accuracy
