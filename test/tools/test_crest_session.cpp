// SPDX-License-Identifier: BSD-3-Clause
// Thresholds that change step by step give what they give at once.
#include <gtest/gtest.h>

#include "support/analytic_surface.h"
#include "support/extraction.h"
#include "support/temporary_directory.h"
#include "tools/command_line.h"
#include "tools/export_session.h"
#include "tools/options.h"
#include "tools/thresholds.h"
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <sstream>

using namespace pcl::crest;

namespace {

/** \brief A cloud with lines of both types, noisy enough for small ones. */
pcl::PointCloud<pcl::PointNormal>::Ptr
makeCloud ()
{
  auto cloud = oracle::sample (oracle::bumpySphere(), 6000);
  for (std::size_t i = 0; i < cloud->size(); ++i)
    (*cloud)[i].getNormalVector3fMap() =
        ((*cloud)[i].getNormalVector3fMap() +
         0.02F * Eigen::Vector3f (std::sin (7.0F * static_cast<float> (i)),
                                  std::sin (11.0F * static_cast<float> (i)),
                                  std::sin (13.0F * static_cast<float> (i))))
            .normalized();
  return cloud;
}

void
expectEqual (const CrestLine& a, const CrestLine& b)
{
  EXPECT_EQ (a.type, b.type);
  EXPECT_EQ (a.size, b.size);
  EXPECT_EQ (a.length, b.length);
  EXPECT_EQ (a.closed, b.closed);
  EXPECT_EQ (a.polylines, b.polylines);
  EXPECT_EQ (a.ends, b.ends);
  EXPECT_EQ (a.strength, b.strength);
  EXPECT_EQ (a.mean_curvature, b.mean_curvature);
  EXPECT_EQ (a.turning_angle, b.turning_angle);
  EXPECT_EQ (a.scale, b.scale);
}

/** \brief Whether a session gives what the estimation gives; the number of lines. */
std::size_t
expectAsAtOnce (const CrestSession& session, const Parameters& parameters)
{
  const auto& cloud = session.getCloud().points;
  pcl::CrestLineEstimation<pcl::PointNormal> estimation;
  estimation.setInputCloud (cloud);
  estimation.setParameters (parameters);
  pcl::PointCloud<pcl::Label> labels;
  estimation.compute (labels);
  EXPECT_EQ (oracle::countDifferent (labels, session.getLabels()), 0U);
  const std::vector<CrestLine>& lines = estimation.getLines();
  EXPECT_EQ (lines.size(), session.getLines().size());
  for (std::size_t i = 0; i < std::min (lines.size(), session.getLines().size()); ++i)
    expectEqual (lines[i], session.getLines()[i]);
  const auto& where = session.getLineCloud();
  const auto& curvatures = session.getCurvatures();
  for (std::size_t i = 0; i < cloud->size(); ++i) {
    EXPECT_EQ ((*estimation.getLineCloud())[i].getVector3fMap(),
               where[i].getVector3fMap());
    EXPECT_EQ (estimation.getPrincipalCurvatures()[i].pc1, curvatures[i].pc1);
  }
  for (const CrestType type : CREST_TYPES)
    EXPECT_EQ (estimation.getStatistics().line_sizes[type],
               session.getStatistics().line_sizes[type]);
  return lines.size();
}

std::vector<std::string>
stages (const CrestSession& session)
{
  std::vector<std::string> names;
  for (const StageTime& time : session.getStatistics().times)
    names.push_back (time.stage);
  return names;
}

/** \brief The median over the lines of one of their measures. */
template <typename Measure>
double
median (const CrestSession& session, Measure CrestLine::*measure)
{
  std::vector<double> values;
  for (const CrestLine& line : session.getLines())
    values.push_back (static_cast<double> (line.*measure));
  std::sort (values.begin(), values.end());
  return values.at (values.size() / 2);
}

InputCloud
inputOf (const pcl::PointCloud<pcl::PointNormal>::Ptr& points)
{
  InputCloud input;
  input.points = points;
  return input;
}

} // namespace

TEST (CrestSession, PaperThresholdsChangeStepByStep)
{
  Parameters p;
  p.preset = Preset::PAPER;
  p.boundaries = true;
  CrestSession session (inputOf (makeCloud()), p);
  const std::size_t first = expectAsAtOnce (session, p);
  const auto expect = [&] {
    session.setThresholds (p);
    return expectAsAtOnce (session, p);
  };
  p.maximality = {1.0, 0.001};
  EXPECT_NE (expect(), first);
  p.maximality.ridge = 0.003;
  const std::size_t many = expect();
  p.maximality.valley = 2.0;
  EXPECT_NE (expect(), many);
  p.min_size = {0, 25};
  EXPECT_GT (expect(), 0U);
  p.min_size = {40, 3};
  expect();
  p.wanted = {false, true};
  expect();
  p.maximality.valley = 0.05;
  expect();
  p.wanted = {true, false};
  p.prune = 4;
  expect();
  p.wanted = {true, true};
  p.min_strength = 2.5;
  const std::size_t strong = expect();
  p.min_strength = 0.0;
  EXPECT_GT (expect(), strong);
}

TEST (CrestSession, AutoThresholdsChangeStepByStep)
{
  Parameters p;
  CrestSession session (inputOf (makeCloud()), p);
  const std::size_t first = expectAsAtOnce (session, p);
  const auto expect = [&] {
    session.setThresholds (p);
    return expectAsAtOnce (session, p);
  };
  p.angle = median (session, &CrestLine::turning_angle);
  EXPECT_LT (expect(), first);
  p.angle = 5.0;
  p.min_length = 2.0;
  p.confidence = 1.0;
  const std::size_t many = expect();
  const auto size = static_cast<int> (median (session, &CrestLine::size));
  p.min_size = {size, size - 3};
  const std::size_t large = expect();
  EXPECT_LT (large, many);
  p.min_strength = median (session, &CrestLine::strength);
  EXPECT_LT (expect(), large);
  p.positions = Positions::SAMPLES;
  expect();
  p.positions = Positions::CREST;
  p.min_size = {};
  p.min_strength = 0.0;
  EXPECT_EQ (expect(), many);
}

TEST (CrestSession, RepeatsNoMoreThanNeeded)
{
  Parameters p;
  CrestSession session (inputOf (makeCloud()), p);
  p.min_size = {30, 30};
  session.setThresholds (p);
  EXPECT_TRUE (stages (session).empty());
  p.angle = 30.0;
  session.setThresholds (p);
  EXPECT_EQ (stages (session).front(), "crest points");
}

// Where M is in the cloud's unit, its slider reaches as far as where it is not.
TEST (Thresholds, SliderOfAbsoluteMReachesAsFar)
{
  auto points = makeCloud();
  for (pcl::PointNormal& point : *points)
    point.getVector3fMap() *= 1e-3F;
  const auto linesAlong = [&points] (bool absolute) {
    Parameters p;
    p.preset = Preset::PAPER;
    p.absolute_maximality = absolute;
    CrestSession session (inputOf (points), p);
    const std::vector<Threshold> sliders = thresholdsOf (session);
    std::vector<std::size_t> lines;
    for (const double along : {0.0, 0.3, 0.5, 1.0}) {
      for (std::size_t i = 0; i < 2; ++i) {
        const double ratio = sliders[i].most / sliders[i].least;
        sliders[i].set (p, sliders[i].least * std::pow (ratio, along));
      }
      session.setThresholds (p);
      lines.push_back (session.getLines().size());
    }
    return lines;
  };
  const std::vector<std::size_t> relative = linesAlong (false);
  EXPECT_EQ (linesAlong (true), relative);
  EXPECT_NE (relative[1], relative[2]);
  EXPECT_GT (relative[2], 0U);
}

// One number cannot tell of two thresholds, nor may it take the place of both.
TEST (Thresholds, EachSHasASliderWhereTheyDiffer)
{
  Parameters p;
  p.preset = Preset::PAPER;
  p.min_size = {5, 60};
  const CrestSession session (inputOf (makeCloud()), p);
  std::vector<int> sizes;
  for (const Threshold& threshold : thresholdsOf (session))
    if (threshold.only_filters) {
      sizes.push_back (static_cast<int> (threshold.get (p)));
      takeSliderPlace (threshold, threshold.get (p) + 1.0, p);
    }
  EXPECT_EQ (sizes, (std::vector<int>{5, 60}));
  EXPECT_EQ (p.min_size.ridge, 6);
  EXPECT_EQ (p.min_size.valley, 61);
}

TEST (CommandLine, IsReadBackAsItWas)
{
  std::vector<Parameters> cases (4);
  for (Parameters& p : cases)
    p.batched_search = true;
  cases[1].preset = Preset::PAPER;
  cases[1].maximality = {0.1 + 0.2, 1e-7};
  cases[1].absolute_maximality = true;
  cases[1].prune = 3;
  cases[1].min_size = {0, 17};
  cases[1].wanted.valley = false;
  cases[1].boundaries = true;
  cases[1].k = 31;
  cases[2].angle = 12.5;
  cases[2].min_length = 1e3;
  cases[2].confidence = 0.0;
  cases[2].positions = Positions::SAMPLES;
  cases[2].min_strength = 1.0 / 3.0;
  cases[2].wanted.ridge = false;
  cases[2].batched_search = false;
  cases[3].radius = 0.25;
  for (const Parameters& p : cases) {
    std::istringstream words (optionsOf (p));
    std::vector<std::string> arguments{"program"};
    for (std::string word; words >> word;)
      arguments.push_back (word);
    std::vector<const char*> argv;
    for (const std::string& argument : arguments)
      argv.push_back (argument.c_str());
    Parameters read;
    Options options;
    addEstimationOptions (options, read);
    Arguments taken;
    EXPECT_EQ (
        takeArguments (
            static_cast<int> (argv.size()), argv.data(), {}, options, read, taken),
        "");
    EXPECT_EQ (optionsOf (read), optionsOf (p));
    EXPECT_EQ (read.maximality.ridge, p.maximality.ridge);
    EXPECT_EQ (read.min_size.valley, p.min_size.valley);
    EXPECT_EQ (read.min_strength, p.min_strength);
    EXPECT_EQ (read.angle, p.angle);
    EXPECT_EQ (read.radius, p.radius);
    EXPECT_EQ (read.wanted.ridge, p.wanted.ridge);
  }
  InputCloud cloud;
  cloud.options.classes = {2, 255};
  EXPECT_EQ (" -class 2,255", optionsOf (cloud));
  EXPECT_EQ (quoted ("a/b-1.pcd"), "a/b-1.pcd");
  EXPECT_EQ (quoted ("it's"), "'it'\\''s'");
}

TEST (Export, IsWhatTheLineToolWrites)
{
  // Near the origin, and on a map.
  for (const double place : {0.0, 4571990.0}) {
    const oracle::TemporaryDirectory directory;
    std::ostringstream text;
    text.precision (17);
    const auto points = makeCloud();
    for (const pcl::PointNormal& p : *points)
      text << (p.getVector3fMap().cast<double>().array() + place).transpose() << ' '
           << p.getNormalVector3fMap().transpose() << '\n';
    const std::string input = directory.file ("in put.xyz", text.str());
    Parameters p;
    p.batched_search = true;
    InputCloud cloud;
    std::string error;
    ASSERT_TRUE (readCloud (input, p.k, p.threads, cloud, error)) << error;
    EXPECT_EQ (place == 0.0, cloud.placement.offset.isZero (0.0));
    CrestSession session (cloud, p);
    p.angle = 5.0;
    p.confidence = 1.0;
    p.min_size = {8, 6};
    session.setThresholds (p);
    const std::size_t all = session.getLines().size();
    p.min_strength = median (session, &CrestLine::strength);
    session.setThresholds (p);
    EXPECT_LT (session.getLines().size(), all);
    const std::string prefix = directory.file ("out");
    ASSERT_TRUE (exportSession (session, input, prefix, error)) << error;

    const auto contents = [&] {
      auto statistics =
          nlohmann::json::parse (oracle::contentOf (prefix + "_statistics.json"));
      statistics.erase ("milliseconds");
      return std::vector<std::string>{oracle::contentOf (prefix + "_labels.pcd"),
                                      oracle::contentOf (prefix + "_lines.ply"),
                                      statistics.dump (1)};
    };
    const std::vector<std::string> exported = contents();
    EXPECT_FALSE (session.getLines().empty());
    for (const char* file : {"_labels.pcd", "_lines.ply", "_statistics.json"})
      std::filesystem::remove (prefix + file);
    std::string command = oracle::contentOf (prefix + "_command.txt");
    command.replace (0, command.find (' '), quoted (PCL_CREST_LINE_TOOL));
    command.back() = ' ';
    ASSERT_EQ (std::system ((command + ">/dev/null").c_str()), 0) << command;
    EXPECT_EQ (contents(), exported) << command;

    EXPECT_FALSE (exportSession (session, input, directory.file ("no/such"), error));
    EXPECT_NE (error.find ("no/such_labels.pcd"), std::string::npos) << error;
  }
}
