// SPDX-License-Identifier: BSD-3-Clause
// One run of the Feature on one cloud, against the exact crest lines.
#pragma once

#include <pcl_crest/parameters.h>

#include "sampling.h"
#include "support/crest_truth.h"

#include <array>

namespace accuracy {

/** \brief Lines of one type against the truth; lengths and distances in h. */
struct TypeScore {
  pcl::crest::CrestType type;
  double precision, recall, error;
  double drawn_length, salient_length, true_length;
  std::size_t lines, closed, junctions;
};

struct SurfaceScore {
  std::string surface, group, sampling;
  double noise;
  std::string preset;
  std::size_t points;
  double milliseconds;
  /** median relative error of k1 at the samples within h / 2 of salient lines; NaN if
   * there are none */
  double curvature_error;
  std::array<TypeScore, 2> types;
};

/** \brief What is within this many h of a line is on it. */
constexpr double TOLERANCE = 1.5;

/** \brief Exact |k1|, signed, at the samples within h / 2 of salient lines, as pairs
 * of index and k1.
 */
std::vector<std::pair<std::size_t, double>>
exactCurvatures (const oracle::AnalyticSurface& surface,
                 const Samples& samples,
                 const std::vector<oracle::TruthSegment>& truth);

/** \brief Runs and scores; the caller fills in the names. */
SurfaceScore
scoreRun (const pcl::PointCloud<pcl::PointNormal>::ConstPtr& cloud,
          double spacing,
          const std::vector<oracle::TruthSegment>& truth,
          const std::vector<std::pair<std::size_t, double>>& curvatures,
          const pcl::crest::Parameters& parameters);

} // namespace accuracy
