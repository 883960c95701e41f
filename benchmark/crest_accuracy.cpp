// SPDX-License-Identifier: BSD-3-Clause
// How near the lines of the Feature come to the exact crest lines of analytic surfaces.
#include "cloud_files.h"
#include "settings.h"
#include "summary.h"
#include "surface_list.h"

#include <algorithm>
#include <iostream>
#include <sstream>

namespace {

using accuracy::SurfaceScore;

struct SurfaceSettings : accuracy::Settings {
  std::vector<std::string> surfaces;
  std::vector<std::string> samplings{"even"};
  /** in h, of all samplings but even ones */
  double other_noise = 0.1;
  int points = 20000;
  /** where to write clouds and truths, if anywhere */
  std::string files;
};

/** \brief A file for the surface, with what else tells it from others. */
std::string
fileName (const SurfaceSettings& settings, std::string surface, const std::string& rest)
{
  std::replace (surface.begin(), surface.end(), ' ', '_');
  return settings.files + '/' + surface + rest;
}

/** \brief Scores all runs on a surface; false if a file could not be written. */
bool
measure (const accuracy::ListedSurface& listed,
         const SurfaceSettings& settings,
         std::vector<SurfaceScore>& scores)
{
  std::vector<oracle::TruthSegment> truth;
  if (listed.group != "silent")
    truth = oracle::trueCrestLines (listed.surface, accuracy::TRUTH_CELLS);
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
    const bool even = sampling == "even";
    for (const double noise :
         even ? settings.noises : std::vector<double>{settings.other_noise}) {
      const double spread = sampling == "correlated" ? 3.0 * samples.spacing : 0.0;
      const bool exact_normals = settings.exact_normals || sampling == "exact_normals";
      const auto cloud = accuracy::scan (
          *samples.cloud,
          {noise * samples.spacing, spread, exact_normals, settings.seed});
      std::ostringstream rest;
      rest << '_' << sampling << '_' << noise << ".ply";
      if (!settings.files.empty() &&
          !accuracy::writeCloud (*cloud,
                                 fileName (settings, listed.surface.name, rest.str())))
        return false;
      for (const std::string& preset : settings.presets) {
        const accuracy::TimedRun run =
            accuracy::timedRun (cloud, preset, settings.threads);
        SurfaceScore score =
            accuracy::scoreSurface (run, samples.spacing, truth, curvatures);
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
  SurfaceSettings settings;
  settings.noises = {0.0, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0};

  pcl::crest::Options options;
  auto add = options.add_options();
  add ("-surfaces",
       pcl::crest::value ("A,B",
                          [&] (const std::string& text) {
                            settings.surfaces = accuracy::splitAtCommas (text);
                            return std::string();
                          }),
       "names, or the groups tuned, held_out, silent (all)");
  add ("-sampling",
       accuracy::namesOf (settings.samplings, accuracy::samplingNames()),
       "of even, density, scan_lines, correlated, exact_normals (even)");
  add ("-other_noise",
       pcl::crest::number (settings.other_noise),
       "in spacings, if not even");
  add ("-points", pcl::crest::number (settings.points), "samples of a surface");
  add ("-files",
       pcl::crest::fileName ("FOLDER", settings.files),
       "write clouds and truths there");
  accuracy::addSettings (options, settings);

  pcl::crest::Arguments arguments;
  std::string error = pcl::crest::parse (argc, argv, options, arguments);
  const bool parsed = error.empty();
  std::string unknown;
  const auto surfaces = accuracy::listSurfaces (settings.surfaces, unknown);
  if (settings.help) {
    std::cout << "Scores lines on analytic surfaces.\n" << pcl::crest::usage (options);
    return 0;
  }
  if (parsed && settings.points < 100)
    error = "-points is at least 100";
  else if (parsed && !arguments.files.empty())
    error = "what is \"" + arguments.files[0] + "\"?";
  else if (parsed && !unknown.empty())
    error = "there is no surface \"" + unknown + "\"";
  if (!error.empty()) {
    std::cerr << "crest_accuracy: " << error << '\n' << pcl::crest::usage (options);
    return 1;
  }

  accuracy::printHead();
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
