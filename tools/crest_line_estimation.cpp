// SPDX-License-Identifier: BSD-3-Clause
// pcl_crest_line_estimation: labels the crest points of a file and writes its crest
// lines. Exits with 0 when done, 1 on wrong usage, 2 where a file cannot be read or
// written, or there is not enough memory for it.
#include <pcl_crest/io/write_labels.h>
#include <pcl_crest/io/write_lines.h>
#include <pcl_crest/io/write_statistics.h>

#include <pcl/console/print.h>

#include "base/stopwatch.h"
#include "estimation.h"
#include "io/output_file.h"
#include "options.h"
#include "progress_bar.h"

#include <algorithm>
#include <filesystem>
#include <iomanip>
#include <iostream>

using namespace pcl::crest;

namespace {

constexpr char PROGRAM[] = "pcl_crest_line_estimation";

struct Files {
  std::string input;
  ReadOptions reading;
  std::string output;
  std::string lines;
  std::string crs;
  std::string statistics;
  std::string curvatures;
};

/** \brief Finds out before the computation whether all outputs can be written, and
 * apart from each other. The code to exit with; EXIT_DONE if all is well.
 */
ExitCode
checkOutputs (const Files& files, std::string& error)
{
  struct Output {
    std::string file;
    std::vector<std::string> extensions;
  };
  const std::vector<Output> outputs{{files.output, labelExtensions()},
                                    {files.lines, lineExtensions()},
                                    {files.statistics, {".json"}},
                                    {files.curvatures, {".pcd"}}};
  std::vector<std::string> taken{files.input};
  for (const Output& output : outputs) {
    if (output.file.empty())
      continue;
    for (const std::string& file : lineFiles (output.file)) {
      const auto same = [&file] (const std::string& other) {
        namespace fs = std::filesystem;
        std::error_code ignored;
        return fs::equivalent (other, file, ignored) ||
               fs::weakly_canonical (fs::absolute (other, ignored), ignored) ==
                   fs::weakly_canonical (fs::absolute (file, ignored), ignored);
      };
      if (std::any_of (taken.begin(), taken.end(), same)) {
        error = file + " is named twice: inputs and outputs must be different files";
        return EXIT_USAGE;
      }
      taken.push_back (file);
    }
    if (!hasExtension (output.file, output.extensions, error))
      return EXIT_USAGE;
  }
  if (files.lines.empty() && !files.crs.empty()) {
    error = "the option -crs is of lines: -lines tells where to write them";
    return EXIT_USAGE;
  }
  if (!files.lines.empty() && !checkLines (files.lines, files.crs, error))
    return EXIT_USAGE;
  taken.erase (taken.begin());
  for (const std::string& file : taken)
    if (!checkWritable (file, error))
      return EXIT_FILE;
  return EXIT_DONE;
}

/** \brief A number of things, as in "1 line" and "2 lines". */
std::string
count (std::ptrdiff_t number, const std::string& thing)
{
  return std::to_string (number) + " " + thing + (number == 1 ? "" : "s");
}

void
report (const Files& files, const InputCloud& cloud)
{
  std::cout << "Read "
            << count (static_cast<std::ptrdiff_t> (cloud.points->size()), "point")
            << " from " << files.input << "; normals: " << nameOf (cloud.normals)
            << "\n";
  for (const std::string& note : cloud.notes)
    std::cout << "  " << note << "\n";
}

void
report (const std::vector<CrestLine>& lines, const pcl::PointCloud<pcl::Label>& labels)
{
  const auto labelled = [&labels] (Label code) {
    return std::count_if (labels.begin(), labels.end(), [code] (const pcl::Label& l) {
      return l.label == code;
    });
  };
  for (const CrestType type : CREST_TYPES) {
    const bool ridge = type == CrestType::RIDGE;
    const auto of_type =
        std::count_if (lines.begin(), lines.end(), [type] (const CrestLine& l) {
          return l.type == type;
        });
    std::cout << (ridge ? "Ridges:   " : "Valleys:  ")
              << count (labelled (ridge ? LABEL_RIDGE : LABEL_VALLEY), "crest point")
              << ", " << count (of_type, "line") << "\n";
  }
  const auto boundary = labelled (LABEL_BOUNDARY);
  if (boundary != 0)
    std::cout << "Boundary: " << count (boundary, "point") << "\n";
  const auto invalid = labelled (LABEL_INVALID);
  if (invalid != 0)
    std::cout
        << "Invalid:  " << count (invalid, "point")
        << ", not finite, set apart, without a normal or with too few neighbours\n";
}

void
report (const std::vector<StageTime>& times)
{
  std::cout << "Milliseconds:" << std::fixed << std::setprecision (1);
  const char* separator = " ";
  for (const StageTime& time : times) {
    std::cout << separator << time.stage << " " << time.milliseconds;
    separator = ", ";
  }
  std::cout << "\n";
}

int
run (const Files& files, const Parameters& parameters, bool quiet)
{
  if (quiet) {
    std::cout.setstate (std::ios_base::failbit); // which swallows all reports
    pcl::console::setVerbosityLevel (pcl::console::L_ERROR);
  }
  std::string error;
  Estimate result;
  const auto tell = [&files] (const InputCloud& cloud) { report (files, cloud); };
  ExitCode code = EXIT_DONE;
  {
    ProgressBar bar (quiet);
    const auto progress = [&bar] (const std::string& stage, double done) {
      bar.show (stage, done);
      return true;
    };
    code = estimate (
        files.input, parameters, files.reading, tell, progress, result, error);
  }
  if (code != EXIT_DONE)
    return fail (PROGRAM, code, error);
  const auto& [cloud, estimation, labels] = result;
  const std::string sampling = explainSampling (estimation.getStatistics().sampling);
  if (!sampling.empty())
    std::cout << "Sampling: " << sampling << "\n";
  report (estimation.getLines(), labels);

  std::vector<StageTime> times = cloud.times;
  const std::vector<StageTime>& stages = estimation.getStatistics().times;
  times.insert (times.end(), stages.begin(), stages.end());
  Stopwatch watch (times);
  const pcl::PointCloud<pcl::PrincipalCurvatures>& curvatures =
      estimation.getPrincipalCurvatures();
  OutputGroup outputs;
  if (!writeLabels (
          files.output, cloud, labels, curvatures, estimation.getLines(), error))
    return fail (PROGRAM, EXIT_FILE, error);
  if (!files.lines.empty() && !writeLines (files.lines,
                                           *estimation.getLineCloud(),
                                           estimation.getLines(),
                                           error,
                                           cloud.placement,
                                           files.crs))
    return fail (PROGRAM, EXIT_FILE, error);
  if (!files.curvatures.empty() &&
      !writeCurvatures (
          files.curvatures, *cloud.points, curvatures, error, cloud.placement))
    return fail (PROGRAM, EXIT_FILE, error);
  watch.stageDone ("writing");
  if (!files.statistics.empty() &&
      !writeStatistics (files.statistics, cloud, labels, estimation, times, error))
    return fail (PROGRAM, EXIT_FILE, error);
  if (!outputs.commit (error))
    return fail (PROGRAM, EXIT_FILE, error);
  for (const std::string& name :
       {files.output, files.lines, files.curvatures, files.statistics})
    if (!name.empty())
      for (const std::string& file : lineFiles (name))
        std::cout << "Wrote " << file << "\n";
  report (times);
  return EXIT_DONE;
}

} // namespace

int
main (int argc, char** argv)
{
  cleanUpOnSignals();
  Parameters parameters;
  Files files;
  bool quiet = false;
  bool asked = false;
  std::vector<OptionGroup> groups{
      {"Output", {}}, {"Input", {}}, {"Crest lines", {}}, {"Questions", {}}};
  auto add = groups[0].options.add_options();
  add ("-lines",
       fileName ("FILE", files.lines),
       "write the lines as .obj (with an .mtl), .ply, .vtk, .vtp,\n.dxf, "
       ".geojson, .csv, .gpkg or .shp");
  add ("-crs",
       value ("EPSG:N",
              [&files] (const std::string& text) {
                files.crs = text;
                return std::string (text.empty() ? "as in EPSG:25832" : "");
              }),
       "the coordinate system of INPUT, for .geojson, .gpkg and .shp");
  add ("-stats",
       fileName ("FILE.json", files.statistics),
       "write counts, sizes and lengths of lines, and times");
  add ("-curvatures",
       fileName ("FILE.pcd", files.curvatures),
       "write principal curvatures and directions");
  add ("-quiet", flag (quiet), "print errors only, and no progress on a terminal");
  addReadingOptions (groups[1].options, files.reading);
  addEstimationOptions (groups[2].options, parameters);
  addQuestions (groups[3].options, asked);
  if (wantsHelp (argc, argv)) {
    std::cout
        << "Usage: pcl_crest_line_estimation INPUT OUTPUT [options]\n\n"
           "Extracts crest lines, that is ridges and valleys, from a point cloud.\n"
           "INPUT is a file of one of the formats that -format lists, packed by gzip\n"
           "or not; its normals are used, else those of its faces, else they are\n"
           "estimated.\n"
           "OUTPUT, a .pcd, .ply or .las file, gets each point with its normal, its\n"
           "largest principal curvature, the line through it with its strength, what\n"
           "else INPUT has of it, and its label: 0 none, 1 ridge, 2 valley, 3 and 4\n"
           "joined to a ridge or valley line by growth, 5 invalid point, 6 boundary\n"
           "point.\n\n"
        << usage (groups);
    return EXIT_DONE;
  }
  if (wantsVersion (argc, argv)) {
    std::cout << describeVersion (PROGRAM);
    return EXIT_DONE;
  }

  Arguments arguments;
  std::string error = takeArguments (
      argc, argv, {"INPUT", "OUTPUT"}, allOptions (groups), parameters, arguments);
  if (!error.empty())
    return fail (PROGRAM, EXIT_USAGE, error);
  files.input = arguments.files[0];
  files.output = arguments.files[1];
  const ExitCode code = checkOutputs (files, error);
  return code == EXIT_DONE ? run (files, parameters, quiet)
                           : fail (PROGRAM, code, error);
}
