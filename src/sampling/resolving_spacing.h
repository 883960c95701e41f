// SPDX-License-Identifier: BSD-3-Clause
// The smallest spacing at which a surface can be told from how it was sampled.
#pragma once

#include <pcl_crest/input.h>

#include "sampling/sample_window.h"

#include <algorithm>
#include <vector>

namespace pcl {
namespace crest {

/** \brief What a cloud's windows ask for. */
struct ResolvingSpacing {
  /** of each window how far apart nodes have to be there; 0 where samples will do */
  std::vector<double> spacings;
  /** why, by windows */
  std::vector<SamplingFlaw> flaws;

  bool
  asks () const
  {
    return std::any_of (
        spacings.begin(), spacings.end(), [] (double s) { return s > 0.0; });
  }
};

/** \brief What is known of the noise before. */
enum class NoiseSearch {
  /** the samples are too few to tell noise from shape */
  NONE,
  SAMPLES,
  /** the same, where their coordinates are those of a grid */
  GRID_SAMPLES,
  /** what is looked at are nodes: smooth noise was looked for before */
  NODES
};

/** \brief Decides window by window, each with those around it.
 *
 * Nodes are asked for by five flaws. Samples in clumps or lines: the spacing that
 * places between them see is far wider than that which they see of each other. Steps of
 * a sensor's depth: small windows without noise, all parallel, at many depths.
 * Steps of a grid: what they leave of a surface that is not along them.
 * Correlated noise: residuals grow with the window and then no more, and what is left
 * of their correlation falls with the distance. Two scans that do not meet: heights in
 * two clumps less than a spacing apart. A sensor's noise is everywhere: it has to be in
 * a quarter of the cloud to count.
 */
ResolvingSpacing
findResolvingSpacing (std::vector<SampleWindow> windows, NoiseSearch search);

} // namespace crest
} // namespace pcl
