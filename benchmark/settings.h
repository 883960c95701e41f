// SPDX-License-Identifier: BSD-3-Clause
// What the programs of the benchmark have in common on their command lines.
#pragma once

#include "options.h"

#include <string>
#include <vector>

namespace accuracy {

struct Settings {
  std::vector<std::string> presets{"auto", "paper"};
  /** in h */
  std::vector<double> noises;
  unsigned seed = 1;
  unsigned threads = 0;
  /** keep the true normals instead of estimating them */
  bool exact_normals = false;
  std::string json;
  bool help = false;
};

/** \brief Adds -seed -threads -json -h. */
void
addOutputSettings (pcl::crest::Options& options, Settings& settings);

/** \brief Adds -noise as well. */
void
addRunSettings (pcl::crest::Options& options, Settings& settings);

/** \brief Adds -presets and -exact_normals to all these. */
void
addSettings (pcl::crest::Options& options, Settings& settings);

std::vector<std::string>
splitAtCommas (const std::string& text);

/** \brief A list of which every part has to be one of `known`. */
pcl::crest::OptionValue*
namesOf (std::vector<std::string>& names, const std::vector<std::string>& known);

} // namespace accuracy
