// SPDX-License-Identifier: BSD-3-Clause
// What the scores come to, for people and for scripts.
#pragma once

#include "surface_score.h"

#include <string>
#include <vector>

namespace accuracy {

/** \brief The head of the Markdown table of printRows. */
void
printHead ();

/** \brief A line of a Markdown table for each type that has truth or lines. */
void
printRows (const SurfaceScore& score);

/** \brief Means and the worst of each group, sampling, noise and preset.
 *
 * Types count for recall with at least 10 h of salient lines, and for precision and
 * error with at least 10 h drawn.
 */
void
printSummary (const std::vector<SurfaceScore>& scores);

/** \brief Writes all scores; numbers that are not defined as null. */
bool
writeJson (const std::vector<SurfaceScore>& scores,
           unsigned threads,
           const std::string& file);

} // namespace accuracy
