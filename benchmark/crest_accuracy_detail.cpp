// SPDX-License-Identifier: BSD-3-Clause
// Features of a few spacings: curvature against that of a plain cubic, and whether
// neighbouring crests are kept apart.
#include "json_file.h"
#include "plain_cubic.h"
#include "rank_correlation.h"
#include "settings.h"
#include "support/detailed_surfaces.h"
#include "support/noisy_cloud.h"
#include "timed_run.h"
#include "type_score.h"
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <iostream>

namespace {

struct DetailedSurface {
  oracle::AnalyticSurface surface;
  /** the shortest of its waves, in h */
  double wavelength;
};

struct DetailScore {
  std::string surface;
  double noise;
  std::size_t points;
  /** of the larger |principal curvature| with the exact one, a border left out */
  double correlation, plain_correlation;
  std::array<accuracy::TypeScore, 2> types;
};

std::vector<DetailedSurface>
allSurfaces ()
{
  std::vector<DetailedSurface> all;
  for (const double wavelength : {4.0, 5.0, 6.0, 8.0, 12.0})
    all.push_back ({oracle::windingWaves (wavelength), wavelength});
  for (const double wavelength : {4.0, 5.0, 6.0, 8.0, 12.0})
    all.push_back ({oracle::crossingWaves (wavelength), wavelength});
  all.push_back ({oracle::waveMixture(), 4.0});
  return all;
}

/** \brief The samples that are not near a border, where all fits are worse. */
std::vector<std::size_t>
insideOf (const std::vector<Eigen::Vector2d>& parameters)
{
  constexpr double BORDER = 4.0;
  std::vector<std::size_t> inside;
  for (std::size_t i = 0; i < parameters.size(); ++i)
    if (parameters[i].minCoeff() > BORDER &&
        parameters[i].maxCoeff() < oracle::DETAIL_SIDE - BORDER)
      inside.push_back (i);
  return inside;
}

/** \brief Scores each noise on a surface. */
std::vector<DetailScore>
measure (const DetailedSurface& detailed, const accuracy::Settings& settings)
{
  // What is nearer to a crest than to the valleys beside it belongs to it.
  const double tolerance = std::min (1.5, detailed.wavelength / 4.0);
  const oracle::AnalyticSurface& surface = detailed.surface;
  const auto truth = oracle::trueCrestLines (surface, 400);
  std::vector<Eigen::Vector2d> parameters;
  const auto exact = oracle::sampleOneApart (surface, settings.seed, parameters);
  const double spacing = oracle::meanSpacing (*exact);
  const std::vector<std::size_t> inside = insideOf (parameters);
  std::vector<double> truths;
  for (const std::size_t i : inside)
    truths.push_back (std::abs (
        oracle::geometryAt (surface, parameters[i].x(), parameters[i].y()).k1));

  std::vector<DetailScore> scores;
  for (const double noise : settings.noises) {
    const auto cloud = oracle::addNoise (*exact, noise * spacing, settings.seed);
    const accuracy::TimedRun run = accuracy::timedRun (cloud, "auto", settings.threads);
    const std::vector<double> plain = accuracy::plainCubicCurvatures (*cloud);
    std::vector<double> own_inside;
    std::vector<double> plain_inside;
    for (const std::size_t i : inside) {
      const float k1 = std::abs (run.curvatures[i].pc1);
      own_inside.push_back (std::isfinite (k1) ? k1 : 0.0);
      plain_inside.push_back (plain[i]);
    }
    DetailScore score{};
    score.surface = surface.name;
    score.noise = noise;
    score.points = cloud->size();
    score.correlation = accuracy::rankCorrelation (own_inside, truths);
    score.plain_correlation = accuracy::rankCorrelation (plain_inside, truths);
    for (std::size_t i = 0; i < 2; ++i)
      score.types[i] = accuracy::scoreType (run.lines,
                                            *run.line_cloud,
                                            truth,
                                            pcl::crest::CREST_TYPES[i],
                                            spacing,
                                            tolerance);
    scores.push_back (score);
  }
  return scores;
}

void
printRow (const DetailScore& score)
{
  for (const accuracy::TypeScore& type : score.types)
    std::printf ("| %s | %zu | %g | %.3f | %.3f %s\n",
                 score.surface.c_str(),
                 score.points,
                 score.noise,
                 score.correlation,
                 score.plain_correlation,
                 accuracy::toRow (type).c_str());
  std::fflush (stdout);
}

nlohmann::json
toJson (const DetailScore& score)
{
  nlohmann::json run{{"surface", score.surface},
                     {"noise", score.noise},
                     {"points", score.points},
                     {"correlation", score.correlation},
                     {"plain_correlation", score.plain_correlation}};
  for (const accuracy::TypeScore& type : score.types)
    run[accuracy::nameOf (type.type)] = accuracy::toJson (type);
  return run;
}

} // namespace

int
main (int argc, char** argv)
{
  accuracy::Settings settings;
  settings.noises = {0.0, 0.02, 0.05};
  const std::vector<DetailedSurface> surfaces = allSurfaces();
  std::vector<std::string> names;
  for (const DetailedSurface& one : surfaces)
    names.push_back (one.surface.name);
  pcl::crest::Options options;
  options.add_options() ("-surfaces",
                         accuracy::namesOf (names, names),
                         "by their names in the table (all)");
  accuracy::addRunSettings (options, settings);
  pcl::crest::Arguments arguments;
  std::string error = pcl::crest::parse (argc, argv, options, arguments);
  if (error.empty() && settings.help) {
    std::cout << "usage: crest_accuracy_detail [options]\n"
              << pcl::crest::usage (options);
    return 0;
  }
  if (error.empty() && !arguments.files.empty())
    error = "takes no files: " + arguments.files.front();
  if (!error.empty()) {
    std::cerr << "crest_accuracy_detail: " << error << '\n';
    return 1;
  }

  std::printf ("| surface | points | noise | rank k1 | plain cubic %s\n"
               "|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n",
               accuracy::rowHead().c_str());
  nlohmann::json runs = nlohmann::json::array();
  for (const DetailedSurface& one : surfaces) {
    if (std::find (names.begin(), names.end(), one.surface.name) == names.end())
      continue;
    for (const DetailScore& score : measure (one, settings)) {
      printRow (score);
      runs.push_back (toJson (score));
    }
  }
  if (!settings.json.empty() &&
      !accuracy::writeRuns (runs, settings.threads, settings.json)) {
    std::cerr << "crest_accuracy_detail: could not write " << settings.json << '\n';
    return 1;
  }
  return 0;
}
