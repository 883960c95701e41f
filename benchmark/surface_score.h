// SPDX-License-Identifier: BSD-3-Clause
// A run on samples of an analytic surface, against its exact crest lines.
#pragma once

#include "sampling.h"
#include "timed_run.h"
#include "type_score.h"

#include <array>

namespace accuracy {

/** \brief What is within this many h of a line is on it. */
constexpr double TOLERANCE = 1.5;

/** \brief Of the grid that truths are found on: its steps are about half an h. */
constexpr int TRUTH_CELLS = 400;

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

/** \brief The index and the exact k1 of the samples within h / 2 of salient lines. */
std::vector<std::pair<std::size_t, double>>
exactCurvatures (const oracle::AnalyticSurface& surface,
                 const Samples& samples,
                 const std::vector<oracle::TruthSegment>& truth);

/** \brief Fills in what can be told without the names. */
SurfaceScore
scoreSurface (const TimedRun& run,
              double spacing,
              const std::vector<oracle::TruthSegment>& truth,
              const std::vector<std::pair<std::size_t, double>>& curvatures);

} // namespace accuracy
