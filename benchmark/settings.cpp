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

pcl::crest::OptionValue*
namesOf (std::vector<std::string>& names, const std::vector<std::string>& known)
{
  return pcl::crest::value ("A,B", [&names, known] (const std::string& text) {
    names = splitAtCommas (text);
    for (const std::string& name : names)
      if (std::find (known.begin(), known.end(), name) == known.end()) {
        std::string right = "one or more, with commas between, of:";
        for (const std::string& one : known)
          right += ' ' + one;
        return right;
      }
    return std::string();
  });
}

void
addOutputSettings (pcl::crest::Options& options, Settings& settings)
{
  using namespace pcl::crest;
  auto add = options.add_options();
  add ("-seed", number (settings.seed), "of samples and noise");
  add ("-threads", number (settings.threads), "0 takes all processors");
  add ("-json", fileName ("FILE", settings.json), "write all scores");
  add ("-h", flag (settings.help), "show this and do nothing else");
}

void
addRunSettings (pcl::crest::Options& options, Settings& settings)
{
  std::ostringstream usual;
  for (const double noise : settings.noises)
    usual << (usual.tellp() > 0 ? "," : "") << noise;
  using namespace pcl::crest;
  options.add_options() ("-noise",
                         value ("X,Y",
                                [&settings] (const std::string& text) {
                                  return takeNoises (text, settings.noises);
                                }),
                         ("noises in spacings (" + usual.str() + ")").c_str());
  addOutputSettings (options, settings);
}

void
addSettings (pcl::crest::Options& options, Settings& settings)
{
  using namespace pcl::crest;
  auto add = options.add_options();
  add ("-presets",
       namesOf (settings.presets, {"auto", "paper"}),
       "of auto, paper (both)");
  add ("-exact_normals", flag (settings.exact_normals), "the true normals");
  addRunSettings (options, settings);
}

} // namespace accuracy
