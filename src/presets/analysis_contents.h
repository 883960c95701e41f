// SPDX-License-Identifier: BSD-3-Clause
// What an analysis keeps, and whether it can be used again.
#pragma once

#include <pcl_crest/normal_estimation.h>
#include <pcl_crest/surface_analysis.h>

#include "presets/pipeline.h"

namespace pcl {
namespace crest {

/** \brief What an analysis keeps. */
struct AnalysisContents {
  /** of the cloud (see fingerprint) */
  std::uint64_t cloud = 0;
  /** of the cloud where it has none itself */
  std::shared_ptr<const NormalEstimate> normals;
  /** of the normals that it has */
  std::shared_ptr<const NormalCheck> normal_check;
  NormalHints hints;
  /** whether these normals were taken as they are, with trusts of their signs */
  bool normals_trusted = false;
  SamplingFindings sampling;
  std::shared_ptr<const OrientedPoints> points;
  std::shared_ptr<const SurfaceShape> shape;
  /** all lines of both types */
  std::shared_ptr<const Crests> traced;
  /** that it was made with */
  Parameters parameters;
};

/** \brief An analysis that keeps this. */
std::shared_ptr<const SurfaceAnalysis>
makeAnalysis (AnalysisContents contents);

const AnalysisContents&
contentsOf (const SurfaceAnalysis& analysis);

/** \brief The first parameter that the shape of a surface depends on and that differs:
 * its name and both values, in words for the user. Empty if the shape is the same.
 */
std::string
explainOtherShape (const Parameters& made_with, const Parameters& wanted);

/** \brief Whether, on the same shape, traceCrests gives the same. Lines of one type
 * depend on M of the other, too, as they do not grow over its points.
 */
bool
haveSameTrace (const Parameters& a, const Parameters& b);

} // namespace crest
} // namespace pcl
