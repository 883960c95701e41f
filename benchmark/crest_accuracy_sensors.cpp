// SPDX-License-Identifier: BSD-3-Clause
// How near the lines of the Feature come to the crests of scenes that simulated sensors
// see.
#include "cloud_files.h"
#include "json_file.h"
#include "sensor_score.h"
#include "settings.h"
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iostream>

namespace {

using accuracy::SensorScore;

void
printRow (const SensorScore& score)
{
  std::printf (
      "| %s | %s | %zu | %.4f | %.4f | %.2f | %.2f | %.2f | %.2f | %.0f | %.0f "
      "| %.0f | %.0f |\n",
      score.sensor.c_str(),
      score.scene.c_str(),
      score.points,
      score.spacing,
      score.resolving_spacing,
      score.precision,
      score.recall,
      score.wide_recall,
      score.error,
      score.drawn_length,
      score.visible_length,
      score.wide_length,
      score.milliseconds);
  std::fflush (stdout);
}

} // namespace

int
main (int argc, char** argv)
{
  accuracy::Settings settings;
  const std::vector<oracle::SensorCase> cases = oracle::sensorCases();
  std::vector<std::string> names;
  for (const oracle::SensorCase& one : cases)
    if (std::find (names.begin(), names.end(), one.sensor) == names.end())
      names.push_back (one.sensor);
  std::string files;
  pcl::crest::Options options;
  options.add_options() ("-sensors",
                         accuracy::namesOf (names, names),
                         "by their names in the table (all)") (
      "-files",
      pcl::crest::fileName ("FOLDER", files),
      "write what sensors see there, by the names of scenes and sensors");
  accuracy::addOutputSettings (options, settings);
  pcl::crest::Arguments arguments;
  std::string error = pcl::crest::parse (argc, argv, options, arguments);
  if (error.empty() && settings.help) {
    std::cout << "usage: crest_accuracy_sensors [options]\n"
              << pcl::crest::usage (options);
    return 0;
  }
  if (error.empty() && !arguments.files.empty())
    error = "takes no files: " + arguments.files.front();
  if (!error.empty()) {
    std::cerr << "crest_accuracy_sensors: " << error << '\n';
    return 1;
  }

  std::printf (
      "| sensor | scene | points | spacing | resolving | P | R | R wide | error "
      "| drawn | visible | wide | ms |\n"
      "|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  nlohmann::json runs = nlohmann::json::array();
  for (const oracle::SensorCase& one : cases) {
    if (std::find (names.begin(), names.end(), one.sensor) == names.end())
      continue;
    const oracle::SensorCloud scan = one.scan (settings.seed);
    if (!files.empty() &&
        !accuracy::writeScan (
            *scan.cloud, files + '/' + one.scene.name + ", " + one.sensor + ".pcd")) {
      std::cerr << "crest_accuracy_sensors: could not write to " << files << '\n';
      return 1;
    }
    SensorScore score = accuracy::scoreSensor (
        accuracy::runOn (scan, settings.threads), one.scene, scan.view);
    score.sensor = one.sensor;
    score.scene = one.scene.name;
    printRow (score);
    runs.push_back (toJson (score));
  }
  if (!settings.json.empty() &&
      !accuracy::writeRuns (runs, settings.threads, settings.json)) {
    std::cerr << "crest_accuracy_sensors: could not write " << settings.json << '\n';
    return 1;
  }
  return 0;
}
