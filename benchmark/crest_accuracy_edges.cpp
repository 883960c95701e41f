// SPDX-License-Identifier: BSD-3-Clause
// How near the lines of the Feature come to the sharp edges of meshes.
#include "json_file.h"
#include "mesh_edges.h"
#include "sampling.h"
#include "settings.h"
#include <nlohmann/json.hpp>

#include <cstdio>
#include <iostream>

namespace {

using accuracy::SharpScore;

void
printRows (const SharpScore& score)
{
  for (const accuracy::TypeScore& t : score.types)
    std::printf ("| %s | %g | %s | %zu of %zu | %.0f %s\n",
                 score.name.c_str(),
                 score.noise,
                 score.preset.c_str(),
                 score.joined,
                 score.corners,
                 score.milliseconds,
                 toRow (t).c_str());
  std::fflush (stdout);
}

bool
writeJson (const std::vector<SharpScore>& scores, const accuracy::Settings& settings)
{
  nlohmann::json runs = nlohmann::json::array();
  for (const SharpScore& score : scores) {
    nlohmann::json run{{"name", score.name},
                       {"points", score.points},
                       {"noise", score.noise},
                       {"preset", score.preset},
                       {"milliseconds", score.milliseconds},
                       {"corners", score.corners},
                       {"joined", score.joined}};
    for (const accuracy::TypeScore& t : score.types)
      run[accuracy::nameOf (t.type)] = toJson (t);
    runs.push_back (run);
  }
  return accuracy::writeRuns (runs, settings.threads, settings.json);
}

} // namespace

int
main (int argc, char** argv)
{
  accuracy::Settings settings;
  settings.noises = {0.0, 0.05, 0.2};
  pcl::crest::Options options;
  accuracy::addSettings (options, settings);
  pcl::crest::Arguments arguments;
  std::string error = pcl::crest::parse (argc, argv, options, arguments);
  const bool parsed = error.empty();
  if (parsed && settings.help) {
    std::cout << "usage: crest_accuracy_edges MESH.off|MESH.obj ... [options]\n"
              << pcl::crest::usage (options);
    return 0;
  }
  if (parsed && arguments.files.empty())
    error = "name at least one mesh";
  std::vector<accuracy::SharpObject> objects;
  for (const std::string& file : arguments.files)
    objects.push_back (accuracy::readSharpMesh (file, error));
  if (!error.empty()) {
    std::cerr << "crest_accuracy_edges: " << error << '\n';
    return 1;
  }

  std::printf ("| mesh | noise | preset | corners joined | ms %s\n"
               "|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n",
               accuracy::rowHead().c_str());
  std::vector<SharpScore> scores;
  for (const accuracy::SharpObject& object : objects) {
    const double spacing = oracle::meanSpacing (*object.cloud);
    for (const double noise : settings.noises) {
      const auto cloud = accuracy::scan (
          *object.cloud, {noise * spacing, 0.0, settings.exact_normals, settings.seed});
      for (const std::string& preset : settings.presets) {
        SharpScore score =
            scoreSharp (accuracy::timedRun (cloud, preset, settings.threads),
                        object.edges,
                        spacing);
        score.name = object.name;
        score.noise = noise;
        score.preset = preset;
        printRows (score);
        scores.push_back (score);
      }
    }
  }
  if (!settings.json.empty() && !writeJson (scores, settings)) {
    std::cerr << "crest_accuracy_edges: could not write " << settings.json << '\n';
    return 1;
  }
  return 0;
}
