// SPDX-License-Identifier: BSD-3-Clause
// Ridges and valleys side by side.
#pragma once

#include "base/parallel.h"
#include "base/stopwatch.h"
#include "presets/pipeline.h"

#include <algorithm>
#include <iterator>

namespace pcl {
namespace crest {

/** \brief Enters the lines of the wanted types, which are traced side by side if there
 * are threads for it. The times of both are added up.
 * \param[in] trace returns the lines of a type, and books times
 */
template <typename Trace>
void
traceTypes (const Parameters& parameters, const Trace& trace, Crests& crests)
{
  PerType<std::vector<CrestLine>> lines;
  PerType<std::vector<StageTime>> times;
  ThreadFailure failure;
  const int threads = std::min (2, threadCount (parameters.threads));
#pragma omp parallel for schedule(static, 1) num_threads(threads)
  for (int i = 0; i < 2; ++i) {
    const CrestType type = CREST_TYPES[i];
    if (!parameters.wanted[type])
      continue;
    failure.guard ([&] {
      Stopwatch watch (times[type]);
      lines[type] = trace (type, watch);
      watch.stageDone ("lines");
    });
  }
  failure.rethrow();
  for (const CrestType type : CREST_TYPES) {
    crests.sizes[type] = lineSizes (lines[type]);
    std::move (
        lines[type].begin(), lines[type].end(), std::back_inserter (crests.lines));
    for (const StageTime& time : times[type])
      addTime (crests.times, time);
  }
}

} // namespace crest
} // namespace pcl
