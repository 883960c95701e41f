// SPDX-License-Identifier: BSD-3-Clause
// The surfaces of the benchmark.
#pragma once

#include "support/analytic_surface.h"

#include <string>
#include <vector>

namespace accuracy {

struct ListedSurface {
  oracle::AnalyticSurface surface;
  /** tuned (the method may be chosen on these), held_out, or silent (no crest lines) */
  std::string group;
};

/** \brief All of them, or those of the names and groups in `wanted`.
 * \param[out] unknown the first of `wanted` that is neither, if any
 */
std::vector<ListedSurface>
listSurfaces (const std::vector<std::string>& wanted, std::string& unknown);

} // namespace accuracy
