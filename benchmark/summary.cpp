// SPDX-License-Identifier: BSD-3-Clause
#include "summary.h"

#include "json_file.h"
#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdio>
#include <map>
#include <tuple>

namespace accuracy {

namespace {

constexpr double LEAST_LENGTH = 10.0;

/** \brief Mean and the worst of a figure, and whose it is. */
struct Figure {
  double sum = 0.0;
  int count = 0;
  double worst = 0.0;
  std::string whose;

  void
  add (double value, bool larger_is_worse, const std::string& name)
  {
    if (count == 0 || (larger_is_worse ? value > worst : value < worst)) {
      worst = value;
      whose = name;
    }
    sum += value;
    ++count;
  }
  void
  print (const char* title) const
  {
    if (count > 0)
      std::printf ("  %s %.3f (%.3f %s)", title, sum / count, worst, whose.c_str());
  }
};

struct Group {
  Figure precision, recall, error, curvature, false_length;
  double milliseconds = 0.0;
};

} // namespace

void
printHead ()
{
  std::printf ("| surface | sampling | noise | preset | k1 | ms %s\n"
               "|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n",
               rowHead().c_str());
}

void
printRows (const SurfaceScore& score)
{
  for (const TypeScore& t : score.types) {
    if (t.true_length == 0.0 && t.drawn_length == 0.0)
      continue;
    std::printf ("| %s | %s | %g | %s | %.3f | %.0f %s\n",
                 score.surface.c_str(),
                 score.sampling.c_str(),
                 score.noise,
                 score.preset.c_str(),
                 score.curvature_error,
                 score.milliseconds,
                 toRow (t).c_str());
  }
  std::fflush (stdout);
}

void
printSummary (const std::vector<SurfaceScore>& scores)
{
  std::map<std::tuple<std::string, std::string, std::string, double>, Group> groups;
  for (const SurfaceScore& score : scores) {
    Group& group = groups[{score.group, score.sampling, score.preset, score.noise}];
    group.milliseconds += score.milliseconds;
    double wrong = 0.0;
    for (const TypeScore& t : score.types) {
      if (t.drawn_length > 0.0)
        wrong += t.drawn_length * (1.0 - t.precision);
      const std::string name = score.surface + ' ' + nameOf (t.type);
      if (t.drawn_length >= LEAST_LENGTH)
        group.precision.add (t.precision, false, name);
      if (t.salient_length < LEAST_LENGTH)
        continue;
      group.recall.add (t.recall, false, name);
      if (t.precision > 0.0)
        group.error.add (t.error, true, name);
    }
    group.false_length.add (wrong, true, score.surface);
    if (std::isfinite (score.curvature_error))
      group.curvature.add (score.curvature_error, true, score.surface);
  }
  std::printf ("\nMeans (and the worst):\n");
  for (const auto& [key, group] : groups) {
    const auto& [name, sampling, preset, noise] = key;
    std::printf (
        "%s %s %s %gh:", name.c_str(), sampling.c_str(), preset.c_str(), noise);
    if (name != "silent") {
      group.precision.print ("P");
      group.recall.print ("R");
      group.error.print ("err");
      group.curvature.print ("k1");
    }
    group.false_length.print ("false h");
    std::printf ("  %.0f ms\n", group.milliseconds);
  }
}

bool
writeJson (const std::vector<SurfaceScore>& scores,
           unsigned threads,
           const std::string& file)
{
  const auto finite = [] (double value) {
    return std::isfinite (value) ? nlohmann::json (value) : nlohmann::json();
  };
  nlohmann::json runs = nlohmann::json::array();
  for (const SurfaceScore& score : scores) {
    nlohmann::json run{{"surface", score.surface},
                       {"group", score.group},
                       {"sampling", score.sampling},
                       {"noise", score.noise},
                       {"preset", score.preset},
                       {"points", score.points},
                       {"milliseconds", score.milliseconds},
                       {"curvature_error", finite (score.curvature_error)}};
    for (const TypeScore& t : score.types)
      run[nameOf (t.type)] = toJson (t);
    runs.push_back (run);
  }
  return writeRuns (runs, threads, file);
}

} // namespace accuracy
