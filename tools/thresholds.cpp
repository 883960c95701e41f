// SPDX-License-Identifier: BSD-3-Clause
#include "thresholds.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace pcl {
namespace crest {

namespace {

double
rounded (double number)
{
  std::ostringstream text;
  text.imbue (std::locale::classic());
  text.precision (3);
  text << number;
  std::istringstream back (text.str());
  back.imbue (std::locale::classic());
  back >> number;
  return number;
}

Threshold
maximality (const std::string& title, CrestType type, double unit)
{
  return {title,
          1e-4 * unit,
          1e3 * unit,
          true,
          false,
          [type] (const Parameters& p) { return p.maximality[type]; },
          [type] (Parameters& p, double value) { p.maximality[type] = value; }};
}

Threshold
leastSize (const std::string& title, const std::vector<CrestType>& types)
{
  const CrestType shown = types.front();
  return {title,
          0.0,
          100.0,
          false,
          true,
          [shown] (const Parameters& p) { return minSize (p, shown); },
          [types] (Parameters& p, double value) {
            for (const CrestType type : types)
              p.min_size[type] = static_cast<int> (std::lround (value));
          }};
}

Threshold
plain (const std::string& title,
       double most,
       bool only_filters,
       double Parameters::*number)
{
  return {title,
          0.0,
          most,
          false,
          only_filters,
          [number] (const Parameters& p) { return p.*number; },
          [number] (Parameters& p, double value) { p.*number = value; }};
}

} // namespace

std::vector<Threshold>
thresholdsOf (const CrestSession& session)
{
  const Parameters parameters = session.getParameters();
  const Preset preset = parameters.preset;
  double strongest = 0.0;
  for (const CrestLine& line : session.getLines())
    strongest = std::max (strongest, line.strength);
  // M = 1 in the unit that it is given in.
  Parameters one;
  one.maximality = {1.0, 1.0};
  const double unit =
      parameters.absolute_maximality
          ? absoluteMaximality (one, session.getStatistics().extent).ridge
          : 1.0;
  std::vector<Threshold> thresholds;
  if (preset == Preset::PAPER)
    thresholds = {maximality ("M of ridges", CrestType::RIDGE, unit),
                  maximality ("M of valleys", CrestType::VALLEY, unit)};
  else
    thresholds = {
        plain ("angle [degrees]", 90.0, false, &Parameters::angle),
        plain ("least length [spacings]", 50.0, false, &Parameters::min_length),
        plain ("confidence", 10.0, false, &Parameters::confidence)};
  if (minSize (parameters, CrestType::RIDGE) == minSize (parameters, CrestType::VALLEY))
    thresholds.push_back (
        leastSize ("S [points]", {CrestType::RIDGE, CrestType::VALLEY}));
  else {
    thresholds.push_back (leastSize ("S of ridges [points]", {CrestType::RIDGE}));
    thresholds.push_back (leastSize ("S of valleys [points]", {CrestType::VALLEY}));
  }
  if (preset == Preset::AUTO)
    thresholds.push_back (plain (
        "strength", std::max (1.0, 0.5 * strongest), true, &Parameters::min_strength));
  return thresholds;
}

double
sliderPlace (const Threshold& threshold, const Parameters& parameters)
{
  const double value =
      std::clamp (threshold.get (parameters), threshold.least, threshold.most);
  return threshold.logarithmic ? std::log10 (value) : value;
}

void
takeSliderPlace (const Threshold& threshold, double place, Parameters& parameters)
{
  threshold.set (parameters,
                 rounded (threshold.logarithmic ? std::pow (10.0, place) : place));
}

} // namespace crest
} // namespace pcl
