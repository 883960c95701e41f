// SPDX-License-Identifier: BSD-3-Clause
#include "settings.h"

#include <algorithm>
#include <sstream>

namespace accuracy {

namespace {

std::string
takeNoises (const std::string& value, std::vector<double>& noises)
{
  noises.clear();
  for (const std::string& part : splitAtCommas (value)) {
    std::istringstream stream (part);
    double noise = 0.0;
    if (!(stream >> noise) || !stream.eof() || noise < 0.0)
      return "numbers from 0 on, with commas between";
    noises.push_back (noise);
  }
  return {};
}

} // namespace

std::vector<std::string>
splitAtCommas (const std::string& text)
{
  std::vector<std::string> parts;
  std::istringstream stream (text);
  for (std::string part; std::getline (stream, part, ',');)
    parts.push_back (part);
  return parts;
}

pcl::crest::Options::Take
takeNames (std::vector<std::string>& names, const std::vector<std::string>& known)
{
  return [&names, known] (const std::string& value) {
    names = splitAtCommas (value);
    for (const std::string& name : names)
      if (std::find (known.begin(), known.end(), name) == known.end()) {
        std::string right = "one or more, with commas between, of:";
        for (const std::string& one : known)
          right += ' ' + one;
        return right;
      }
    return std::string();
  };
}

void
addSettings (pcl::crest::Options& options, Settings& settings)
{
  std::ostringstream usual;
  for (const double noise : settings.noises)
    usual << (usual.tellp() > 0 ? "," : "") << noise;
  options.add ("-noise",
               "X,Y",
               "noises in spacings (" + usual.str() + ")",
               [&settings] (const std::string& value) {
                 return takeNoises (value, settings.noises);
               });
  options.add ("-presets",
               "A,B",
               "of auto, paper (both)",
               takeNames (settings.presets, {"auto", "paper"}));
  options.addFlag ("-exact_normals", "the true normals", settings.exact_normals);
  options.addNumber ("-seed", "of samples and noise", settings.seed);
  options.addNumber ("-threads", "0 takes all processors", settings.threads);
  options.addText ("-json", "FILE", "write all scores", settings.json);
  options.addFlag ("-h", "show this and do nothing else", settings.help);
}

} // namespace accuracy
