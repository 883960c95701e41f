// SPDX-License-Identifier: BSD-3-Clause
// How often the signs of estimated normals are wrong, and how far their angles are off.
#include "json_file.h"
#include "normal_score.h"
#include "settings.h"
#include "support/noisy_cloud.h"
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iostream>

namespace {

using accuracy::NormalScore;

std::string
inWords (double value, const char* format)
{
  char text[32] = "-";
  if (!std::isnan (value))
    std::snprintf (text, sizeof text, format, value);
  return text;
}

void
printRow (const NormalScore& score)
{
  const auto percent = [] (double share) { return inWords (100.0 * share, "%.2f %%"); };
  const auto degrees = [] (double angle) { return inWords (angle, "%.2f"); };
  std::printf (
      "| %s | %zu | %g | %s | %s | %s | %s | %s | %s | %s | %s | %.0f | %.0f |\n",
      score.solid.c_str(),
      score.points,
      score.noise,
      percent (score.wrong).c_str(),
      percent (score.undecided).c_str(),
      percent (score.unsure).c_str(),
      percent (score.wrong_of_sure).c_str(),
      degrees (score.angle.far_from_edges).c_str(),
      degrees (score.angle_of_pcl.far_from_edges).c_str(),
      degrees (score.angle.near_edges).c_str(),
      degrees (score.angle_of_pcl.near_edges).c_str(),
      score.milliseconds,
      score.milliseconds_of_pcl);
  std::fflush (stdout);
}

nlohmann::json
toJson (const accuracy::AngleErrors& errors)
{
  return {{"far_from_edges", errors.far_from_edges}, {"near_edges", errors.near_edges}};
}

bool
writeJson (const std::vector<NormalScore>& scores, const accuracy::Settings& settings)
{
  nlohmann::json runs = nlohmann::json::array();
  for (const NormalScore& score : scores)
    runs.push_back ({{"name", score.solid},
                     {"points", score.points},
                     {"noise", score.noise},
                     {"undecided", score.undecided},
                     {"wrong", score.wrong},
                     {"unsure", score.unsure},
                     {"wrong_of_sure", score.wrong_of_sure},
                     {"angle", toJson (score.angle)},
                     {"angle_of_pcl", toJson (score.angle_of_pcl)},
                     {"milliseconds", score.milliseconds},
                     {"milliseconds_of_pcl", score.milliseconds_of_pcl}});
  return accuracy::writeRuns (runs, settings.threads, settings.json);
}

} // namespace

int
main (int argc, char** argv)
{
  accuracy::Settings settings;
  settings.noises = {0.0, 0.05, 0.2, 0.5, 1.0};
  std::vector<std::string> names;
  for (const oracle::NamedSolid& solid : oracle::namedSolids())
    names.push_back (solid.name);
  pcl::crest::Options options;
  options.add_options() (
      "-solids", accuracy::namesOf (names, names), "by their names in the table (all)");
  accuracy::addRunSettings (options, settings);
  pcl::crest::Arguments arguments;
  std::string error = pcl::crest::parse (argc, argv, options, arguments);
  if (error.empty() && settings.help) {
    std::cout << "usage: crest_accuracy_normals [options]\n"
              << pcl::crest::usage (options);
    return 0;
  }
  if (error.empty() && !arguments.files.empty())
    error = "takes no files: " + arguments.files.front();
  if (!error.empty()) {
    std::cerr << "crest_accuracy_normals: " << error << '\n';
    return 1;
  }

  std::printf (
      "Wrong: of the points less than 60 degrees off the line of the exact "
      "normal, others are left out.\n"
      "Angles: medians in degrees, signs ignored, more than %g h and less than "
      "%g h from sharp edges.\nMilliseconds are those of single runs, one "
      "after the other.\n\n",
      accuracy::FAR_FROM_EDGES,
      accuracy::NEAR_EDGE);
  std::printf ("| solid | points | noise | wrong | left out | unsure | wrong of sure | "
               "angle far | PCL | angle near | PCL | ms | PCL |\n"
               "|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  std::vector<NormalScore> scores;
  for (const oracle::NamedSolid& solid : oracle::namedSolids()) {
    if (std::find (names.begin(), names.end(), solid.name) == names.end())
      continue;
    const oracle::SolidCloud exact = solid.sample (settings.seed);
    const std::vector<double> edge_distances = accuracy::edgeDistances (exact);
    for (const double noise : settings.noises) {
      const auto cloud =
          oracle::addNoise (*exact.cloud, noise * exact.spacing, settings.seed);
      NormalScore score = accuracy::scoreNormals (
          accuracy::runNormals (*cloud, solid.closed, settings.threads),
          exact,
          edge_distances);
      score.solid = solid.name;
      score.noise = noise;
      printRow (score);
      scores.push_back (score);
    }
  }
  if (!settings.json.empty() && !writeJson (scores, settings)) {
    std::cerr << "crest_accuracy_normals: could not write " << settings.json << '\n';
    return 1;
  }
  return 0;
}
