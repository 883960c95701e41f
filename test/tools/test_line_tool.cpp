// SPDX-License-Identifier: BSD-3-Clause
// Runs pcl_crest_line_estimation as a user does.
#include <pcl_crest/crest_line_estimation.h>
#include <pcl_crest/io/read_cloud.h>
#include <pcl_crest/io/write_lines.h>
#include <pcl_crest/version.h>

#include <pcl/io/pcd_io.h>

#include <gtest/gtest.h>

#include "support/analytic_surface.h"
#include "support/sensors.h"
#include "support/temporary_directory.h"
#include <nlohmann/json.hpp>
#include <sys/wait.h>

#include <array>
#include <cstdlib>
#include <regex>
#include <set>
#include <sstream>

using namespace pcl::crest;

namespace {

struct Outcome {
  int code;
  std::string out;
  std::string error;
};

class LineTool : public testing::Test {
protected:
  const oracle::TemporaryDirectory directory_;
  /** where the program puts its output, apart from what the test puts there */
  const oracle::TemporaryDirectory outputs_;
  const pcl::PointCloud<pcl::PointNormal>::Ptr cloud_ =
      oracle::sample (oracle::bumpySphere(), 3000);

  std::string
  input () const
  {
    return write (*cloud_);
  }

  std::string
  write (const pcl::PointCloud<pcl::PointNormal>& cloud) const
  {
    std::ostringstream text;
    text.precision (9);
    for (const pcl::PointNormal& p : cloud)
      text << p.getVector3fMap().transpose() << ' '
           << p.getNormalVector3fMap().transpose() << '\n';
    return directory_.file ("in put.xyz", text.str());
  }

  Outcome
  run (const std::vector<std::string>& arguments, const std::string& before = "") const
  {
    std::string command = before + "'" + PCL_CREST_LINE_TOOL + "'";
    for (const std::string& argument : arguments)
      command += " '" + argument + "'";
    command +=
        " >'" + directory_.file ("out") + "' 2>'" + directory_.file ("err") + "'";
    const int status = std::system (command.c_str());
    return {WIFEXITED (status) ? WEXITSTATUS (status) : -1,
            oracle::contentOf (directory_.file ("out")),
            oracle::contentOf (directory_.file ("err"))};
  }

  void
  expectUsageError (const std::vector<std::string>& arguments,
                    const std::string& message) const
  {
    const Outcome result = run (arguments);
    EXPECT_EQ (1, result.code) << message;
    EXPECT_NE (std::string::npos, result.error.find (message)) << result.error;
    EXPECT_NE (std::string::npos, result.error.find ("-h tells")) << result.error;
    EXPECT_TRUE (outputs_.names().empty());
  }
};

TEST_F (LineTool, WritesWhatTheLibraryComputes)
{
  const std::vector<std::string> names{"c.pcd", "l.mtl", "l.obj", "o.pcd", "s.json"};
  const Outcome result = run ({input(),       outputs_.file ("o.pcd"),
                               "-preset",     "paper",
                               "-M_ridge",    "0.4",
                               "-M",          "0.2",
                               "-S",          "12",
                               "-S_valley",   "14",
                               "-k",          "20",
                               "-prune",      "6",
                               "-threads",    "1",
                               "-lines",      outputs_.file ("l.obj"),
                               "-stats",      outputs_.file ("s.json"),
                               "-curvatures", outputs_.file ("c.pcd")});
  ASSERT_EQ (0, result.code) << result.error;
  EXPECT_EQ ("", result.error);
  EXPECT_EQ (names, outputs_.names());
  for (const std::string& name : names)
    EXPECT_NE (std::string::npos, result.out.find ("Wrote " + outputs_.file (name)));
  EXPECT_NE (std::string::npos, result.out.find ("Read 3"));
  EXPECT_NE (std::string::npos, result.out.find ("normals: file"));

  InputCloud cloud;
  std::string error;
  ASSERT_TRUE (readCloud (input(), 20, 1, cloud, error)) << error;
  Parameters parameters;
  parameters.preset = Preset::PAPER;
  parameters.maximality = {0.4, 0.2};
  parameters.min_size = {12, 14};
  parameters.k = 20;
  parameters.prune = 6;
  pcl::CrestLineEstimation<pcl::PointNormal> estimation;
  estimation.setInputCloud (cloud.points);
  estimation.setParameters (parameters);
  pcl::PointCloud<pcl::Label> labels;
  estimation.compute (labels);
  pcl::PointCloud<pcl::PointXYZLNormal> written;
  ASSERT_EQ (0, pcl::io::loadPCDFile (outputs_.file ("o.pcd"), written));
  ASSERT_EQ (cloud_->size(), written.size());
  std::set<std::uint32_t> found;
  for (std::size_t i = 0; i < written.size(); ++i) {
    ASSERT_EQ (labels[i].label, written[i].label);
    ASSERT_EQ (estimation.getPrincipalCurvatures()[i].pc1, written[i].curvature);
    ASSERT_LE ((written[i].getVector3fMap() - (*cloud_)[i].getVector3fMap()).norm(),
               1e-6F);
    found.insert (written[i].label);
  }
  EXPECT_EQ (1U, found.count (LABEL_RIDGE));
  EXPECT_EQ (1U, found.count (LABEL_VALLEY));
  const auto json =
      nlohmann::json::parse (oracle::contentOf (outputs_.file ("s.json")));
  EXPECT_EQ (estimation.getLines().size(), json.at ("lines").size());
  EXPECT_EQ (0.4, json.at ("parameters").at ("M_ridge"));
  EXPECT_EQ (0.2, json.at ("parameters").at ("M_valley"));
  EXPECT_EQ (1, json.at ("threads"));
  EXPECT_EQ ("batched", json.at ("parameters").at ("search"));
  for (const std::string stage : {"reading", "normals", "surface graph", "writing"})
    EXPECT_TRUE (json.at ("milliseconds").contains (stage)) << stage;
}

TEST_F (LineTool, AutoOptionsAreThoseOfTheLibrary)
{
  // An open surface, for -boundaries.
  const std::string in = write (*oracle::sample (oracle::ridgeAndValley(), 4000));
  InputCloud cloud;
  std::string error;
  ASSERT_TRUE (readCloud (in, 24, 1, cloud, error)) << error;

  const auto expectSame = [&] (const std::vector<std::string>& options,
                               const Parameters& parameters) {
    pcl::CrestLineEstimation<pcl::PointNormal> estimation;
    estimation.setInputCloud (cloud.points);
    estimation.setParameters (parameters);
    pcl::PointCloud<pcl::Label> labels;
    estimation.compute (labels);
    std::vector<std::string> arguments{in,
                                       outputs_.file ("o.pcd"),
                                       "-lines",
                                       outputs_.file ("l.ply"),
                                       "-stats",
                                       outputs_.file ("s.json")};
    arguments.insert (arguments.end(), options.begin(), options.end());
    const Outcome result = run (arguments);
    ASSERT_EQ (0, result.code) << result.error;
    pcl::PointCloud<pcl::PointXYZLNormal> written;
    ASSERT_EQ (0, pcl::io::loadPCDFile (outputs_.file ("o.pcd"), written));
    ASSERT_EQ (labels.size(), written.size());
    for (std::size_t i = 0; i < written.size(); ++i)
      ASSERT_EQ (labels[i].label, written[i].label);
    ASSERT_TRUE (writeLines (directory_.file ("l.ply"),
                             *estimation.getLineCloud(),
                             estimation.getLines(),
                             error));
    EXPECT_EQ (oracle::contentOf (directory_.file ("l.ply")),
               oracle::contentOf (outputs_.file ("l.ply")));
    const auto json =
        nlohmann::json::parse (oracle::contentOf (outputs_.file ("s.json")));
    ASSERT_EQ (estimation.getLines().size(), json.at ("lines").size());
    for (std::size_t i = 0; i < json.at ("lines").size(); ++i) {
      EXPECT_EQ (estimation.getLines()[i].length, json.at ("lines")[i].at ("length"));
      EXPECT_EQ (estimation.getLines()[i].strength,
                 json.at ("lines")[i].at ("strength"));
    }
  };
  expectSame ({}, {});
  expectSame ({"-preset", "auto"}, {});
  Parameters parameters;
  parameters.angle = 60.0;
  expectSame ({"-angle", "60"}, parameters);
  parameters = {};
  parameters.min_length = 50.5;
  expectSame ({"-min_length", "50.5"}, parameters);
  parameters = {};
  parameters.confidence = 8.0;
  expectSame ({"-confidence", "8"}, parameters);
  parameters = {};
  parameters.positions = Positions::SAMPLES;
  expectSame ({"-positions", "samples"}, parameters);
  parameters = {};
  parameters.boundaries = true;
  expectSame ({"-boundaries", "-positions", "crest"}, parameters);
  parameters = {};
  parameters.min_size = {60, 5};
  expectSame ({"-S_valley", "5", "-S", "60"}, parameters);
  parameters = {};
  parameters.preset = Preset::PAPER;
  parameters.boundaries = true;
  expectSame ({"-preset", "paper", "-boundaries"}, parameters);
}

TEST_F (LineTool, TellsHowTheCloudWasSampled)
{
  const double h = oracle::meanSpacing (*cloud_);
  for (const bool clumped : {false, true}) {
    const std::string file =
        write (clumped ? oracle::accumulatedFrames (*cloud_, 5, 0.02 * h) : *cloud_);
    const std::string statistics = outputs_.file ("s.json");
    const Outcome result = run ({file, outputs_.file ("o.pcd"), "-stats", statistics});
    ASSERT_EQ (0, result.code) << result.error;
    EXPECT_NE (result.out.find ("Sampling: spacing "), std::string::npos) << result.out;
    EXPECT_EQ (result.out.find ("nodes") != std::string::npos, clumped) << result.out;
    const auto json = nlohmann::json::parse (oracle::contentOf (statistics));
    const auto& sampling = json.at ("sampling");
    EXPECT_NEAR (sampling.at ("spacing").get<double>() / h, 1.0, 0.3);
    EXPECT_EQ (sampling.at ("gathered_points").get<std::size_t>() > 0, clumped);
    EXPECT_EQ (sampling.at ("flawed_windows").at ("clumps").get<std::size_t>() > 0,
               clumped);
  }
}

TEST_F (LineTool, TellsThatFacesWereSampled)
{
  const std::string tetrahedron = directory_.file (
      "a.off",
      "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n");
  const auto statisticsWith = [&] (const std::vector<std::string>& options) {
    const std::string file = outputs_.file ("s.json");
    std::vector<std::string> arguments{
        tetrahedron, outputs_.file ("o.pcd"), "-stats", file};
    arguments.insert (arguments.end(), options.begin(), options.end());
    const Outcome result = run (arguments);
    EXPECT_EQ (0, result.code) << result.error;
    EXPECT_EQ (options.empty() || options[1] != "off",
               result.out.find ("4 faces were sampled evenly") != std::string::npos);
    return nlohmann::json::parse (oracle::contentOf (file));
  };
  const auto chosen = statisticsWith ({});
  EXPECT_EQ (4, chosen.at ("sampled_faces"));
  EXPECT_GT (chosen.at ("points").get<int>(), 30000);
  EXPECT_EQ (0.1, statisticsWith ({"-sample", "0.1"}).at ("sample_spacing"));
  const auto off = statisticsWith ({"-sample", "off"});
  EXPECT_EQ (4, off.at ("points"));
  EXPECT_EQ (0U, off.count ("sampled_faces"));
}

TEST_F (LineTool, CountsAreGrammatical)
{
  const Outcome result = run ({input(), outputs_.file ("o.pcd"), "-S", "100000"});
  EXPECT_NE (std::string::npos, result.out.find (", 0 lines\n")) << result.out;
  const Outcome one =
      run ({directory_.file ("a.xyz", "1 2 3\n"), outputs_.file ("o.pcd")});
  EXPECT_NE (std::string::npos, one.out.find ("Read 1 point from")) << one.out;
  EXPECT_NE (std::string::npos, one.out.find ("Invalid:  1 point,")) << one.out;
}

TEST_F (LineTool, TypeRadiusAndAbsoluteAreHeeded)
{
  const auto labelsOf = [this] (std::vector<std::string> options) {
    options.insert (options.begin(), {input(), outputs_.file ("o.pcd")});
    const Outcome result = run (options);
    EXPECT_EQ (0, result.code) << result.error;
    pcl::PointCloud<pcl::PointXYZLNormal> written;
    pcl::io::loadPCDFile (outputs_.file ("o.pcd"), written);
    std::array<std::size_t, 7> count{};
    for (const pcl::PointXYZLNormal& point : written)
      ++count.at (point.label);
    return count;
  };
  const auto ridges = labelsOf ({"-type", "ridges"});
  EXPECT_GT (ridges[LABEL_RIDGE], 0U);
  EXPECT_EQ (0U, ridges[LABEL_VALLEY] + ridges[LABEL_VALLEY_GROWN]);
  const auto valleys = labelsOf ({"-type", "valleys"});
  EXPECT_EQ (0U, valleys[LABEL_RIDGE] + valleys[LABEL_RIDGE_GROWN]);
  EXPECT_GT (valleys[LABEL_VALLEY], 0U);
  const auto both = labelsOf ({"-type", "both"});
  EXPECT_EQ (ridges[LABEL_RIDGE], both[LABEL_RIDGE]);
  EXPECT_EQ (both, labelsOf ({"-search", "kdtree"}));
  EXPECT_EQ (both, labelsOf ({"-search", "batched"}));

  // M in the file's unit, with the same value in the relative one.
  Eigen::AlignedBox3f box;
  for (const pcl::PointNormal& p : *cloud_)
    box.extend (p.getVector3fMap());
  const double tenth = box.sizes().maxCoeff() / 10.0;
  const auto relative = labelsOf ({"-preset", "paper", "-M", "0.5"});
  EXPECT_EQ (relative,
             labelsOf ({"-preset",
                        "paper",
                        "-absolute",
                        "-M",
                        std::to_string (0.5 / (tenth * tenth))}));
  EXPECT_NE (relative, labelsOf ({"-preset", "paper"}));
  // No point has neighbours within so small a radius.
  EXPECT_EQ (cloud_->size(), labelsOf ({"-radius", "1e-6"})[LABEL_INVALID]);
}

TEST_F (LineTool, ARadiusInTheWrongUnitIsRefused)
{
  const Outcome result = run ({input(), outputs_.file ("o.pcd"), "-radius", "1000"});
  EXPECT_EQ (1, result.code);
  EXPECT_NE (std::string::npos, result.error.find ("The search radius of 1000 holds"))
      << result.error;
  EXPECT_TRUE (outputs_.names().empty());
}

TEST_F (LineTool, HelpGoesToTheStandardOutput)
{
  for (const std::vector<std::string>& arguments :
       std::vector<std::vector<std::string>>{
           {"-h"}, {"--help"}, {"a", "b.pcd", "-h"}}) {
    const Outcome result = run (arguments);
    EXPECT_EQ (0, result.code);
    EXPECT_EQ ("", result.error);
    for (const char* option : {"-k ",
                               "-radius ",
                               "-M ",
                               "-M_ridge ",
                               "-M_valley ",
                               "-absolute ",
                               "-S ",
                               "-S_ridge ",
                               "-S_valley ",
                               "-strength ",
                               "-prune ",
                               "-preset ",
                               "-angle ",
                               "-min_length ",
                               "-confidence ",
                               "-positions ",
                               "-boundaries ",
                               "-type ",
                               "-threads ",
                               "-lines ",
                               "-stats ",
                               "-curvatures ",
                               "-search ",
                               "-quiet ",
                               "-h ",
                               "-estimate_normals ",
                               "-version ",
                               "(default 24)",
                               "Output:\n",
                               "\nInput:\n",
                               "\nCrest lines:\n"})
      EXPECT_NE (std::string::npos, result.out.find (option)) << option;
  }
}

TEST_F (LineTool, VersionTellsOfPresetsAndKernels)
{
  std::string kernels;
  for (const std::string& name : kernelNames())
    kernels += (kernels.empty() ? "" : ", ") + name;
  const std::string expected =
      "pcl_crest_line_estimation " + version() +
      "\npresets: auto (default), paper\nkernels: " + kernelNames().front() + " (of " +
      kernels + ")\n";
  for (const std::vector<std::string>& arguments :
       std::vector<std::vector<std::string>>{
           {"-version"}, {"--version"}, {"a", "-wrong", "--version", "b.pcd"}}) {
    const Outcome result = run (arguments);
    EXPECT_EQ (0, result.code);
    EXPECT_EQ ("", result.error);
    EXPECT_EQ (expected, result.out);
  }
  EXPECT_TRUE (std::regex_match (version(), std::regex ("[0-9]+\\.[0-9]+\\.[0-9]+")));
#if defined(__x86_64__)
  EXPECT_EQ (__builtin_cpu_supports ("avx2") != 0, kernelNames().front() == "avx2");
#endif
  EXPECT_EQ ("portable", kernelNames().back());
}

TEST_F (LineTool, QuietPrintsErrorsOnly)
{
  const Outcome result = run ({input(), outputs_.file ("o.pcd"), "-quiet"});
  EXPECT_EQ (0, result.code);
  EXPECT_EQ ("", result.out);
  EXPECT_EQ ("", result.error);
  EXPECT_EQ (std::vector<std::string>{"o.pcd"}, outputs_.names());
  EXPECT_NE ("", run ({"nowhere.xyz", outputs_.file ("p.pcd"), "-quiet"}).error);
}

TEST_F (LineTool, WrongUsage)
{
  const std::string in = input();
  const std::string out = outputs_.file ("o.pcd");
  expectUsageError ({}, "found 0");
  expectUsageError ({in}, "found 1");
  expectUsageError ({in, out, "more"}, "found 3");
  expectUsageError ({in, ""}, "expected the name of a file for OUTPUT, found \"\"");
  expectUsageError ({"", out}, "expected the name of a file for INPUT, found \"\"");
  expectUsageError ({in, out, "-quadrants", "2"}, "no option \"-quadrants\"");
  expectUsageError ({in, out, "--halp"}, "no option \"--halp\"");
  expectUsageError ({in, out, "--k", "5"}, "no option \"--k\"");
  expectUsageError ({in, out, "-k=5"}, "no option \"-k=5\"");
  expectUsageError ({in, out, "-thr", "1"}, "no option \"-thr\"");
  expectUsageError ({in, out, "-"}, "no option \"-\"");
  expectUsageError ({in, out, "--"}, "no option \"--\"");
  expectUsageError ({in, "k=5", out}, "found 3");
  expectUsageError ({in, out, "-boundaries", "-boundaries"},
                    "-boundaries is given twice");
  // Of two values the one of the option that comes first in the usage.
  expectUsageError ({in, out, "-M", "x", "-angle", "y"}, "-angle is \"y\"");
  expectUsageError ({in, out, "-k"}, "-k needs a value");
  expectUsageError ({in, out, "-lines", "-stats"}, "-lines needs a value");
  expectUsageError ({in, out, "-k", "8", "-k", "9"}, "-k is given twice");
  expectUsageError ({in, out, "-k", "1x"}, "-k is \"1x\", but must be a whole number");
  expectUsageError ({in, out, "-k", "2.5"}, "must be a whole number");
  expectUsageError ({in, out, "-k", ""}, "must be a whole number");
  expectUsageError ({in, out, "-k", "3"}, "k is 3, but must be from 4");
  expectUsageError ({in, out, "-k", "9", "-radius", "1"}, "exclude each other");
  expectUsageError ({in, out, "-radius", "0"}, "above 0");
  expectUsageError ({in, out, "-radius", "nan"}, "above 0");
  expectUsageError ({in, out, "-M", "0,5"}, "must be a number");
  expectUsageError ({in, out, "-preset", "paper", "-M_valley", "-1"},
                    "M of valleys is -1, but must be finite and not negative");
  expectUsageError ({in, out, "-preset", "paper", "-M_ridge", "inf"},
                    "M of ridges is inf");
  expectUsageError ({in, out, "-preset", "paper", "-M", "nan"}, "M is nan");
  expectUsageError ({in, out, "-S", "-2"}, "S is -2, but must be not negative");
  expectUsageError ({in, out, "-S_ridge", "-2"}, "S of ridges is -2");
  expectUsageError ({in, out, "-S_valley", "-3"}, "S of valleys is -3");
  expectUsageError ({in, out, "-preset", "paper", "-prune", "-1"}, "-1");
  expectUsageError ({in, out, "-preset", "fast"}, "must be auto or paper");
  expectUsageError ({in, out, "-search", "fast"}, "must be batched or kdtree");
  expectUsageError ({in, out, "-search", "batched", "-radius", "1"}, "has no radius");
  expectUsageError ({in, out, "-angle", "-1"}, "the turning angle is -1");
  expectUsageError ({in, out, "-angle", "181"}, "from 0 to 180 degrees");
  expectUsageError ({in, out, "-angle", "30deg"}, "must be a number");
  expectUsageError ({in, out, "-min_length", "-1"}, "least length of a line is -1");
  expectUsageError (
      {in, out, "-min_length", "inf"},
      "least length of a line is inf, but must be finite and not negative");
  expectUsageError ({in, out, "-confidence", "nan"}, "the confidence is nan");
  expectUsageError ({in, out, "-positions", "edges"}, "must be crest or samples");
  for (const char* option : {"-M", "-M_ridge", "-M_valley", "-prune"})
    expectUsageError ({in, out, option, "1"},
                      "the option " + std::string (option) +
                          " belongs to -preset paper");
  expectUsageError ({in, out, "-absolute"}, "-absolute belongs to -preset paper");
  for (const std::vector<std::string>& option :
       std::vector<std::vector<std::string>>{{"-angle", "25"},
                                             {"-min_length", "5"},
                                             {"-confidence", "2"},
                                             {"-positions", "crest"}})
    expectUsageError ({in, out, "-preset", "paper", option[0], option[1]},
                      "the option " + option[0] + " belongs to -preset auto");
  expectUsageError ({in, out, "-type", "creases"}, "ridges, valleys or both");
  expectUsageError ({in, out, "-threads", "-1"}, "not negative");
  expectUsageError ({in, out, "-threads", "99999"}, "at most");
  expectUsageError ({in, outputs_.file ("o.txt")}, "must be .pcd, .ply or .las");
  expectUsageError ({in, out, "-lines", outputs_.file ("l.stl")},
                    ".dxf, .geojson, .csv, .gpkg or .shp");
  expectUsageError ({in, out, "-crs", "EPSG:25832"}, "-lines tells where");
  expectUsageError ({in, out, "-lines", outputs_.file ("l.ply"), "-crs", "EPSG:25832"},
                    "into .geojson, .gpkg and .shp alone");
  expectUsageError ({in, out, "-lines", outputs_.file ("l.geojson"), "-crs", "utm"},
                    "is \"utm\", but must be EPSG: and its number");
  expectUsageError ({in, out, "-lines", outputs_.file ("l.geojson"), "-crs", ""},
                    "-crs is \"\"");
  expectUsageError ({in, out, "-format", "doc"}, "must be pcd, ply");
  expectUsageError ({in, out, "-columns", "x,y"}, "as in x,y,z,-,nx,ny,nz");
  expectUsageError ({in, out, "-columns", "x,y,z,x"}, "as in x,y,z,-,nx,ny,nz");
  for (const char* const classes : {"ground", "256", "2,,6", "-2", "2,6,"})
    expectUsageError ({in, out, "-class", classes},
                      "must be whole numbers from 0 to 255, as in 2 or 2,6");
  for (const char* const spacing : {"0", "-1", "inf", "on"})
    expectUsageError ({in, out, "-sample", spacing},
                      "must be a number above 0, or off");
  expectUsageError ({in, out, "-stats", outputs_.file ("s.txt")}, "must be .json");
  expectUsageError ({in, out, "-curvatures", out}, "named twice");
  expectUsageError ({out, out}, "named twice");
  expectUsageError ({outputs_.file ("l.mtl"), out, "-lines", outputs_.file ("l.obj")},
                    "l.mtl is named twice");
  expectUsageError (
      {in, out, "-curvatures", outputs_.file ("../") + out.substr (out.find ("pcl_"))},
      "named twice");
}

TEST_F (LineTool, InputsThatCannotBeRead)
{
  const std::string bad = directory_.file ("bad.off", "OFF\n3 0 0\n0 0 0\n1 0\n");
  for (const auto& [file, message] : std::vector<std::array<std::string, 2>>{
           {directory_.file ("lost.pcd"), "there is no such file"},
           {bad, ":4: expected 3 coordinates, found 2"},
           {directory_.file ("a.las", "LASF"),
            "byte 4: the file ends within its header"},
           {directory_.file ("a.laz", "x"), "it is a LAZ file, whose points are"},
           {directory_.file ("a.doc", "x"), "none of .pcd"}}) {
    const Outcome result =
        run ({file, outputs_.file ("o.pcd"), "-stats", outputs_.file ("s.json")});
    EXPECT_EQ (2, result.code);
    EXPECT_NE (std::string::npos, result.error.find (file)) << result.error;
    EXPECT_NE (std::string::npos, result.error.find (message)) << result.error;
    EXPECT_EQ (1, std::count (result.error.begin(), result.error.end(), '\n'));
    EXPECT_TRUE (outputs_.names().empty());
  }
}

TEST_F (LineTool, FarCoordinatesAndPointsSetApartAreSaid)
{
  std::ostringstream text;
  text.precision (12);
  for (const pcl::PointNormal& p : *cloud_)
    text << 32351990.0 + p.x << ' ' << 5717990.0 + p.y << ' ' << p.z << ' '
         << p.getNormalVector3fMap().transpose() << '\n';
  text << "32351990 5717990 -9999 0 0 1\n0 0 0 0 0 1\n";
  const Outcome result = run ({directory_.file ("a.xyz", text.str()),
                               outputs_.file ("o.pcd"),
                               "-stats",
                               outputs_.file ("s.json")});
  ASSERT_EQ (0, result.code) << result.error;
  EXPECT_NE (std::string::npos,
             result.out.find ("far from the origin: 32351990 5717990 0 is taken off"))
      << result.out;
  EXPECT_NE (std::string::npos, result.out.find ("2 of 3")) << result.out;
  EXPECT_NE (std::string::npos, result.out.find ("points are set apart"));
  const auto json =
      nlohmann::json::parse (oracle::contentOf (outputs_.file ("s.json")));
  EXPECT_EQ (2, json.at ("points_set_apart"));
  EXPECT_EQ (2, json.at ("invalid_points"));
  EXPECT_EQ (nlohmann::json::parse ("[32351990, 5717990, 0]"), json.at ("offset"));

  const Outcome near =
      run ({input(), outputs_.file ("o.pcd"), "-stats", outputs_.file ("s.json")});
  EXPECT_EQ (std::string::npos, near.out.find ("far from the origin")) << near.out;
  EXPECT_EQ (std::string::npos, near.out.find ("set apart")) << near.out;
  const auto of_near =
      nlohmann::json::parse (oracle::contentOf (outputs_.file ("s.json")));
  EXPECT_EQ (0, of_near.at ("points_set_apart"));
  EXPECT_EQ (nlohmann::json::parse ("[0, 0, 0]"), of_near.at ("offset"));
}

TEST_F (LineTool, OutputsThatCannotBeWrittenAreFoundOutFirst)
{
  std::filesystem::create_directory (outputs_.file ("d.json"));
  const std::vector<std::string> left{"d.json"};
  for (const std::vector<std::string>& arguments :
       std::vector<std::vector<std::string>>{
           {outputs_.file ("no/o.pcd")},
           {outputs_.file ("o.pcd"), "-stats", outputs_.file ("d.json")},
           {outputs_.file ("o.pcd"), "-lines", outputs_.file ("no/l.ply")}}) {
    std::vector<std::string> all{input()};
    all.insert (all.end(), arguments.begin(), arguments.end());
    const Outcome result = run (all);
    EXPECT_EQ (2, result.code);
    EXPECT_NE (std::string::npos, result.error.find (arguments.back()));
    EXPECT_EQ ("", result.out) << "it has begun to compute";
    EXPECT_EQ (left, outputs_.names());
  }
}

TEST_F (LineTool, AFullDiskLeavesNothing)
{
  const Outcome result = run ({input(), outputs_.file ("o.pcd")}, "ulimit -f 8; ");
  EXPECT_EQ (2, result.code);
  EXPECT_NE (std::string::npos, result.error.find (outputs_.file ("o.pcd")));
  EXPECT_TRUE (outputs_.names().empty());
}

TEST_F (LineTool, OutputsAreThereAllOrNone)
{
  // In 128 000 bytes labels, 40 of each of 3 000 points, find room, curvatures, 44, do
  // not.
  const std::string old = outputs_.file ("o.pcd", "old");
  const Outcome result = run ({input(),
                               old,
                               "-curvatures",
                               outputs_.file ("c.pcd"),
                               "-lines",
                               outputs_.file ("l.obj")},
                              "ulimit -f 250; ");
  EXPECT_EQ (2, result.code);
  EXPECT_NE (std::string::npos, result.error.find (outputs_.file ("c.pcd")))
      << result.error;
  EXPECT_EQ ("old", oracle::contentOf (old));
  EXPECT_EQ (std::vector<std::string>{"o.pcd"}, outputs_.names());
}

TEST_F (LineTool, EndedAtAnyMomentItLeavesAllOrNothing)
{
  const std::string old = outputs_.file ("o.pcd", "old");
  const std::vector<std::string> before{"o.pcd"};
  const std::vector<std::string> after{"l.ply", "o.pcd", "s.json"};
  const std::string cloud = input();
  for (int moment = 1; moment <= 20; ++moment) {
    const std::string command = "timeout -s " +
                                std::string (moment % 2 == 0 ? "INT " : "TERM ") +
                                std::to_string (0.01 * moment) + " ";
    const Outcome result = run ({cloud,
                                 old,
                                 "-lines",
                                 outputs_.file ("l.ply"),
                                 "-stats",
                                 outputs_.file ("s.json")},
                                command);
    const bool is_done = outputs_.names() == after;
    EXPECT_TRUE (is_done || outputs_.names() == before);
    EXPECT_EQ (!is_done, oracle::contentOf (old) == "old");
    for (const std::string& name : after)
      std::filesystem::remove (outputs_.file (name));
    outputs_.file ("o.pcd", "old");
  }
}

TEST_F (LineTool, CloudsWithoutAnyShapeAreLabelledInvalidOrNone)
{
  std::string line;
  std::string equal;
  std::string plane;
  for (int i = 0; i < 100; ++i) {
    line += std::to_string (i) + " 0 0\n";
    equal += "1 2 3\n";
    plane += std::to_string (i % 10) + " " + std::to_string (i / 10) + " 0\n";
  }
  for (const std::string& content :
       {line, equal, plane, std::string ("1 2 3\n"), std::string ("nan 0 0\n")}) {
    const Outcome result =
        run ({directory_.file ("a.xyz", content), outputs_.file ("o.pcd")});
    EXPECT_EQ (0, result.code) << result.error;
    pcl::PointCloud<pcl::PointXYZLNormal> written;
    ASSERT_EQ (0, pcl::io::loadPCDFile (outputs_.file ("o.pcd"), written));
    EXPECT_EQ (std::count (content.begin(), content.end(), '\n'), written.size());
    for (const pcl::PointXYZLNormal& point : written)
      EXPECT_TRUE (point.label == LABEL_NONE || point.label == LABEL_INVALID);
  }
}

} // namespace
