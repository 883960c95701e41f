// SPDX-License-Identifier: BSD-3-Clause
#include "progress_bar.h"

#include <unistd.h>

#include <cmath>
#include <iomanip>
#include <iostream>

namespace pcl {
namespace crest {

ProgressBar::ProgressBar (bool quiet)
: on_terminal_ (!quiet && ::isatty (STDERR_FILENO) == 1)
{}

ProgressBar::~ProgressBar()
{
  if (shown_)
    std::cerr << "\r\033[K" << std::flush;
}

void
ProgressBar::show (const std::string& stage, double done)
{
  constexpr std::chrono::seconds LONG (1);
  constexpr int WIDTH = 30;
  if (!on_terminal_ || std::chrono::steady_clock::now() - start_ < LONG)
    return;
  const auto filled = static_cast<std::size_t> (std::lround (WIDTH * done));
  std::cerr << "\r[" << std::string (filled, '#') << std::string (WIDTH - filled, '.')
            << "] " << std::setw (3) << std::lround (100.0 * done) << " % " << stage
            << "\033[K" << std::flush;
  shown_ = true;
}

} // namespace crest
} // namespace pcl
