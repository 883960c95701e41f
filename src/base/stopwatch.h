// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_crest/progress.h>

#include <chrono>
#include <string>
#include <vector>

namespace pcl {
namespace crest {

/** \brief Books a time, adding it to that of the same stage if there is one. */
inline void
addTime (std::vector<StageTime>& times, const StageTime& time)
{
  for (StageTime& known : times)
    if (known.stage == time.stage) {
      known.milliseconds += time.milliseconds;
      return;
    }
  times.push_back (time);
}

/** \brief Tells how long each stage took; a stage that runs twice is added up. */
class Stopwatch {
public:
  explicit Stopwatch (std::vector<StageTime>& times) : times_ (times) {}

  /** \brief Books what has passed since the last stage ended. */
  void
  stageDone (const std::string& stage)
  {
    const auto now = Clock::now();
    const double ms = std::chrono::duration<double, std::milli> (now - last_).count();
    last_ = now;
    addTime (times_, {stage, ms});
  }

private:
  using Clock = std::chrono::steady_clock;
  std::vector<StageTime>& times_;
  Clock::time_point last_ = Clock::now();
};

} // namespace crest
} // namespace pcl
