// SPDX-License-Identifier: BSD-3-Clause
// What is measured: our work and that of others.
#pragma once

#include "performance_clouds.h"

#include <functional>
#include <utility>

namespace performance {

/** Beside its time what a run tells of itself, such as the milliseconds of stages. */
using Counters = std::vector<std::pair<std::string, double>>;

struct Work {
  std::string name;
  /** whether it can use more than one thread */
  bool parallel;
  std::function<Counters (const Cloud& cloud, unsigned threads)> run;
};

/** \brief All of it. */
const std::vector<Work>&
listWork ();

} // namespace performance
