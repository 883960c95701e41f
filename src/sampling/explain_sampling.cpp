// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_crest/input.h>

#include <algorithm>
#include <iomanip>
#include <sstream>

namespace pcl {
namespace crest {

namespace {

const char*
nameOf (SamplingFlaw flaw)
{
  switch (flaw) {
  case SamplingFlaw::CLUMPS:
    return "samples lie in clumps or along lines";
  case SamplingFlaw::DEPTH_STEPS:
    return "depths come in steps";
  case SamplingFlaw::GRID_STEPS:
    return "positions are those of a grid";
  case SamplingFlaw::CORRELATED_NOISE:
    return "neighbours share their noise";
  case SamplingFlaw::TWO_SCANS:
    return "two scans do not meet";
  case SamplingFlaw::WHITE_NOISE:
    return "noise is nearly as large as spacings";
  case SamplingFlaw::NONE:
    break;
  }
  return "";
}

} // namespace

std::string
explainSampling (const SamplingFindings& findings)
{
  if (!(findings.spacing > 0.0))
    return {};
  std::ostringstream words;
  words << std::setprecision (3) << "spacing " << findings.spacing << ", noise "
        << std::fixed << std::setprecision (2)
        << findings.noise.front() / findings.spacing << " spacings in windows of 24, "
        << findings.noise.back() / findings.spacing << " of 384";
  // Samples all over a volume, as of foliage, have as much.
  constexpr double MORE_THAN_DETAIL = 1.25;
  if (findings.noise.front() > MORE_THAN_DETAIL * findings.spacing)
    words << ", which exceeds the detail of any surface";
  if (findings.gathered == 0)
    return words.str();
  words << "; " << findings.gathered << " points were gathered to " << findings.nodes
        << " nodes " << std::defaultfloat << std::setprecision (3)
        << findings.resolving_spacing << " apart, as ";
  // Of single windows it is not worth a word.
  constexpr std::size_t FEW = 10;
  const std::size_t most =
      *std::max_element (findings.flaws.begin(), findings.flaws.end());
  const char* separator = "";
  for (std::size_t i = 0; i < findings.flaws.size(); ++i)
    if (FEW * findings.flaws[i] > most) {
      words << separator << nameOf (static_cast<SamplingFlaw> (i));
      separator = ", ";
    }
  return words.str();
}

} // namespace crest
} // namespace pcl
