// SPDX-License-Identifier: BSD-3-Clause
// How far the stages are, and who works on them.
#pragma once

#include <pcl_crest/progress.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <utility>

namespace pcl {
namespace crest {

/** \brief What the stages tell of their progress. */
class Progress {
public:
  /** \param[in] callback may be empty */
  explicit Progress (ProgressCallback callback) : callback_ (std::move (callback)) {}

  /** \brief Begins a stage.
   * \param[in] end the part of all work that is done when it ends
   */
  void
  beginStage (const std::string& stage, double end)
  {
    stage_ = stage;
    stage_begin_ = done_ = stage_end_;
    stage_end_ = work_begin_ + (1.0 - work_begin_) * end;
    beginPart (0, 1);
    ask();
    check();
  }

  /** \brief Ends stages before the others, whose ends are then parts of what is left.
   */
  void
  beginRest ()
  {
    work_begin_ = stage_end_;
  }

  /** \brief Begins one of several parts of a stage. */
  void
  beginPart (int part, int parts)
  {
    const double step = (stage_end_ - stage_begin_) / parts;
    part_begin_ = stage_begin_ + part * step;
    part_end_ = std::min (part_begin_ + step, stage_end_);
    check();
  }

  /** \brief Tells, not too often, that so much of a part is done; for the thread that
   * started the work. */
  void
  advance (double part)
  {
    done_ = std::max (done_, part_begin_ + part * (part_end_ - part_begin_));
    if (std::chrono::steady_clock::now() - told_ > std::chrono::milliseconds (100))
      ask();
  }

  /** \brief Tells that all is done. */
  void
  finish ()
  {
    done_ = 1.0;
    ask();
    check();
  }

  bool
  isCancelled () const
  {
    return cancelled_;
  }

  /** \brief Throws Cancelled if the work is. */
  void
  check () const
  {
    if (cancelled_)
      throw Cancelled();
  }

private:
  void
  ask ()
  {
    told_ = std::chrono::steady_clock::now();
    if (callback_ && !callback_ (stage_, done_))
      cancelled_ = true;
  }

  ProgressCallback callback_;
  std::string stage_;
  double work_begin_ = 0.0;
  double stage_begin_ = 0.0;
  double stage_end_ = 0.0;
  double part_begin_ = 0.0;
  double part_end_ = 0.0;
  double done_ = 0.0;
  std::chrono::steady_clock::time_point told_;
  std::atomic<bool> cancelled_{false};
};

/** \brief How many threads work on a stage, and who wants to know how far it is. */
struct Workers {
  // NOLINTNEXTLINE(google-explicit-constructor): a number of threads is enough
  Workers (unsigned count, Progress* watcher = nullptr)
  : threads (count), progress (watcher)
  {}

  /** 0 takes all processors */
  unsigned threads;
  /** if not null, loops throw Cancelled when it is */
  Progress* progress;
};

} // namespace crest
} // namespace pcl
