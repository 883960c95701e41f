// SPDX-License-Identifier: BSD-3-Clause
// Long work on a terminal.
#pragma once

#include <chrono>
#include <string>

namespace pcl {
namespace crest {

/** \brief A line on the terminal that shows how far work is, once it has taken a
 * second; nothing where stderr is no terminal. The line goes when the bar does.
 */
class ProgressBar {
public:
  explicit ProgressBar (bool quiet);
  ~ProgressBar();
  ProgressBar (const ProgressBar&) = delete;
  ProgressBar&
  operator= (const ProgressBar&) = delete;

  /** \brief Shows a stage, and the part of all work that is done. */
  void
  show (const std::string& stage, double done);

private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  bool on_terminal_;
  bool shown_ = false;
};

} // namespace crest
} // namespace pcl
