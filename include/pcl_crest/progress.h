// SPDX-License-Identifier: BSD-3-Clause
// How far long work is, how to stop it, and what it took.
#pragma once

#include <pcl_crest/types.h>

#include <functional>
#include <string>

namespace pcl {
namespace crest {

/** \brief Called when a stage begins and about ten times a second, by the thread that
 * started the work: with the name of the stage and the part of all work that is done,
 * from 0 to 1, an estimate that never falls. Returns whether to go on. Must not throw.
 */
using ProgressCallback = std::function<bool (const std::string& stage, double done)>;

/** \brief Thrown by extractCrests and estimateNormals, and caught by
 * CrestLineEstimation, where a callback said not to go on.
 */
struct PCL_CREST_EXPORT Cancelled {};

/** \brief What one stage took. */
struct StageTime {
  std::string stage;
  double milliseconds;
};

} // namespace crest
} // namespace pcl
