// SPDX-License-Identifier: BSD-3-Clause
// The thresholds that a slider can move.
#pragma once

#include "crest_session.h"

namespace pcl {
namespace crest {

/** \brief One threshold of the parameters and the range that is worth a look. */
struct Threshold {
  std::string title;
  double least;
  double most;
  bool logarithmic;
  /** whether it only chooses among lines, so that it can follow the mouse */
  bool only_filters;
  std::function<double (const Parameters&)> get;
  std::function<void (Parameters&, double)> set;
};

/** \brief The thresholds of the session's preset. */
std::vector<Threshold>
thresholdsOf (const CrestSession& session);

/** \brief Where a threshold stands on its slider, as the logarithm if it has one. */
double
sliderPlace (const Threshold& threshold, const Parameters& parameters);

/** \brief Takes a threshold from its slider, rounded to three digits, so that the
 * number on the screen is the one in use.
 */
void
takeSliderPlace (const Threshold& threshold, double place, Parameters& parameters);

} // namespace crest
} // namespace pcl
