// SPDX-License-Identifier: BSD-3-Clause
// How near the lines of the Feature come to the exact crest lines of analytic surfaces.
#include "cloud_files.h"
#include "options.h"
#include "summary.h"
#include "surface_list.h"

#include <algorithm>
#include <cstdio>
#include <iostream>
#include <sstream>

namespace {

using accuracy::SurfaceScore;

struct Settings {
  std::vector<std::string> surfaces, presets, samplings;
  std::vector<double> noises;
  int points = 20000;
  unsigned seed = 1;
  unsigned threads = 0;
  std::string json;
  std::string files;
  bool help = false;
  bool exact_normals = false;
};

std::vector<std::string>
splitAtCommas (const std::string& text)
{
  std::vector<std::string> parts;
  std::istringstream stream (text);
  for (std::string part; std::getline (stream, part, ',');)
    parts.push_back (part);
  return parts;
}

/** \brief Takes a list of which every part has to be one of `known`. */
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

/** \brief A file for the surface, with what else tells it from others. */
std::string
fileName (const Settings& settings, std::string surface, const std::string& rest)
{
  std::replace (surface.begin(), surface.end(), ' ', '_');
  return settings.files + '/' + surface + rest;
}

/** \brief Scores all runs on a surface; false if a file could not be written. */
bool
measure (const accuracy::ListedSurface& listed,
         const Settings& settings,
         std::vector<SurfaceScore>& scores)
{
  std::vector<oracle::TruthSegment> truth;
  if (listed.group != "silent")
    truth = oracle::trueCrestLines (listed.surface);
  if (!settings.files.empty() &&
      !accuracy::writeTruth (truth,
                             fileName (settings, listed.surface.name, "_truth.obj")))
    return false;
  for (const std::string& sampling : settings.samplings) {
    const accuracy::Samples samples =
        accuracy::sampleAs (sampling,
                            listed.surface,
                            static_cast<std::size_t> (settings.points),
                            settings.seed);
    const auto curvatures = accuracy::exactCurvatures (listed.surface, samples, truth);
    for (const double noise : settings.noises) {
      const auto cloud = accuracy::scan (samples,
                                         noise * samples.spacing,
                                         sampling == "correlated",
                                         settings.exact_normals,
                                         settings.seed);
      std::ostringstream rest;
      rest << '_' << sampling << '_' << noise << ".ply";
      if (!settings.files.empty() &&
          !accuracy::writeCloud (*cloud,
                                 fileName (settings, listed.surface.name, rest.str())))
        return false;
      for (const std::string& preset : settings.presets) {
        pcl::crest::Parameters parameters;
        parameters.preset =
            preset == "auto" ? pcl::crest::Preset::AUTO : pcl::crest::Preset::PAPER;
        parameters.threads = settings.threads;
        SurfaceScore score =
            accuracy::scoreRun (cloud, samples.spacing, truth, curvatures, parameters);
        score.surface = listed.surface.name;
        score.group = listed.group;
        score.sampling = sampling;
        score.noise = noise;
        score.preset = preset;
        accuracy::printRows (score);
        scores.push_back (score);
      }
    }
  }
  return true;
}

} // namespace

int
main (int argc, char** argv)
{
  Settings settings;
  settings.presets = {"auto", "paper"};
  settings.samplings = {"even"};
  settings.noises = {0.0, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0};

  pcl::crest::Options options;
  options.add ("-surfaces",
               "A,B",
               "names, or the groups tuned, held_out, silent (all)",
               [&] (const std::string& value) {
                 settings.surfaces = splitAtCommas (value);
                 return std::string();
               });
  options.add (
      "-noise",
      "X,Y",
      "noises in spacings (0,.02,.05,.1,.2,.5,1)",
      [&] (const std::string& value) { return takeNoises (value, settings.noises); });
  options.add ("-presets",
               "A,B",
               "of auto, paper (both)",
               takeNames (settings.presets, {"auto", "paper"}));
  options.add ("-sampling",
               "A,B",
               "of even, density, scan_lines, correlated (even)",
               takeNames (settings.samplings, accuracy::samplingNames()));
  options.addFlag ("-exact_normals", "the true normals", settings.exact_normals);
  options.addNumber ("-points", "samples of a surface", settings.points);
  options.addNumber ("-seed", "of samples and noise", settings.seed);
  options.addNumber ("-threads", "0 takes all processors", settings.threads);
  options.addFlag ("-h", "show this and do nothing else", settings.help);
  options.addText ("-files", "FOLDER", "write clouds and truths", settings.files);
  options.addText ("-json", "FILE", "write all scores", settings.json);

  std::vector<std::string> others;
  std::string error;
  std::string unknown;
  const bool parsed = options.parse (argc, argv, others, error);
  const auto surfaces = accuracy::listSurfaces (settings.surfaces, unknown);
  if (settings.help) {
    std::cout << "Scores lines on analytic surfaces.\n" << options.usage();
    return 0;
  }
  if (parsed && settings.points < 100)
    error = "-points is at least 100";
  else if (parsed && !others.empty())
    error = "what is \"" + others[0] + "\"?";
  else if (parsed && !unknown.empty())
    error = "there is no surface \"" + unknown + "\"";
  if (!error.empty()) {
    std::cerr << "crest_accuracy: " << error << '\n' << options.usage();
    return 1;
  }

  std::printf ("| surface | sampling | noise | preset | type | P | R | err | ratio | "
               "drawn | salient | lines | closed | junctions | k1 | ms |\n"
               "|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  std::vector<SurfaceScore> scores;
  for (const accuracy::ListedSurface& listed : surfaces)
    if (!measure (listed, settings, scores)) {
      std::cerr << "crest_accuracy: could not write to " << settings.files << '\n';
      return 1;
    }
  accuracy::printSummary (scores);
  if (!settings.json.empty() &&
      !accuracy::writeJson (scores, settings.threads, settings.json)) {
    std::cerr << "crest_accuracy: could not write " << settings.json << '\n';
    return 1;
  }
  return 0;
}
