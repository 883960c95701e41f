// SPDX-License-Identifier: BSD-3-Clause
// What the extraction of crest lines takes, beside what its users would run instead.
// For docs/performance.md; ./scripts/benchmark runs it.
#include "performance_clouds.h"
#include "performance_work.h"
#include <benchmark/benchmark.h>

#include <cstdio>
#include <iostream>

using performance::Cloud;
using performance::Work;

namespace {

constexpr char USAGE[] =
    "Usage: crest_benchmark [--shuffle] [NAME=FILE | NAME=POINTS]... "
    "[--benchmark_...]\n"
    "Measures the clouds of files, and waves of so many points, each by its name in\n"
    "the results; with --shuffle those that follow it in random order, too, as\n"
    "NAME_shuffled. --benchmark_filter=REGEX chooses among NAME/WORK/THREADS.\n";

/** \brief Runs a work as often as Google Benchmark asks. */
void
measure (benchmark::State& state,
         const Work& work,
         const Cloud& cloud,
         unsigned threads)
{
  performance::Counters counters;
  for (auto iteration : state) // NOLINT(clang-analyzer-deadcode.DeadStores)
    counters = work.run (cloud, threads);
  for (const auto& [name, value] : counters)
    state.counters[name] = value;
  state.counters["points"] = static_cast<double> (cloud.points->size());
}

} // namespace

int
main (int argc, char** argv)
{
  benchmark::Initialize (&argc, argv);
  std::vector<Cloud> clouds;
  bool shuffle = false;
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument == "--shuffle") {
      shuffle = true;
      continue;
    }
    const std::size_t equals = argument.find ('=');
    Cloud cloud;
    std::string error;
    if (equals == 0 || equals == std::string::npos)
      error = "cannot take \"" + argument + "\"";
    else
      error = performance::makeCloud (
          argument.substr (0, equals), argument.substr (equals + 1), cloud);
    if (!error.empty()) {
      std::cerr << "crest_benchmark: " << error << "\n" << USAGE;
      return 1;
    }
    clouds.push_back (cloud);
    if (shuffle)
      clouds.push_back (
          {cloud.name + "_shuffled", performance::shuffled (*cloud.points)});
  }
  for (const Cloud& cloud : clouds)
    for (const Work& work : performance::listWork())
      for (const unsigned threads : {1U, 2U})
        if (threads == 1 || work.parallel)
          benchmark::RegisterBenchmark (
              (cloud.name + "/" + work.name + "/" + std::to_string (threads)).c_str(),
              [&work, &cloud, threads] (benchmark::State& state) {
                measure (state, work, cloud, threads);
              })
              ->Unit (benchmark::kMillisecond)
              ->UseRealTime();
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}
