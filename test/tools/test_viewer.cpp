// SPDX-License-Identifier: BSD-3-Clause
// pcl_crest_viewer as its user calls it. Needs an X display.
#include <pcl/common/io.h>
#include <pcl/io/pcd_io.h>

#include <gtest/gtest.h>

#include "support/picture.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

using namespace oracle;
using pcl::crest::View;

namespace {

/** The share of the crest at `shift` from the winding axis that has its color. */
double
shareDrawn (const Picture& picture, const View& view, double shift, PixelTest& color)
{
  int drawn = 0, all = 0;
  for (double y = -0.8; y <= 0.8; y += 0.01, ++all) {
    const double z = 0.1 * std::cos (2.0 * M_PI * shift);
    drawn += isNear (picture, project (view, {windingOf (y) + shift, y, z}), 4, color);
  }
  return static_cast<double> (drawn) / all;
}

void
expectCrestsOfWaves (const Picture& picture, const View& view)
{
  EXPECT_GT (shareDrawn (picture, view, 0.0, isBlue), 0.95);
  EXPECT_GT (shareDrawn (picture, view, 0.5, isRed), 0.95);
  EXPECT_GT (shareDrawn (picture, view, -0.5, isRed), 0.95);
  EXPECT_EQ (shareDrawn (picture, view, 0.0, isRed), 0.0);
  EXPECT_EQ (shareDrawn (picture, view, 0.5, isBlue), 0.0);
  EXPECT_LT (count (picture, isBlue) + count (picture, isRed), SIZE * SIZE / 25);
}

bool
isLime (const std::array<int, 3>& pixel)
{
  return pixel[1] > pixel[0] + 60 && pixel[1] > pixel[2] + 60;
}

bool
isOwnColor (const std::array<int, 3>& pixel)
{
  return pixel == std::array<int, 3>{10, 200, 30};
}

/** Runs the viewer; its exit code, and what it said in `said`. */
int
runViewer (const std::string& before,
           const std::string& arguments,
           std::string* said = nullptr)
{
  const std::string log = testing::TempDir() + "test_viewer.log";
  const int status = std::system (
      (before + " " PCL_CREST_VIEWER " " + arguments + " > " + log + " 2>&1").c_str());
  if (said != nullptr) {
    std::ostringstream text;
    text << std::ifstream (log).rdbuf();
    *said = text.str();
  }
  return WIFEXITED (status) ? WEXITSTATUS (status) : -1;
}

std::string
contentOf (const std::string& file)
{
  std::ostringstream content;
  content << std::ifstream (file, std::ios::binary).rdbuf();
  return content.str();
}

} // namespace

class Viewer : public testing::Test {
protected:
  void
  SetUp () override
  {
    std::filesystem::create_directory (folder);
    pcl::io::savePCDFileBinary (input, *cloud);
  }
  void
  TearDown () override
  {
    std::filesystem::remove_all (folder);
  }

  const std::string folder = testing::TempDir() + "test_viewer";
  const std::string input = folder + "/waves.pcd";
  const std::string output = folder + "/waves.png";
  const std::string size =
      " -size " + std::to_string (SIZE) + "x" + std::to_string (SIZE);
  const pcl::PointCloud<pcl::PointNormal>::Ptr cloud = waves();
};

TEST_F (Viewer, DrawsTheCrestsOfAFile)
{
  const std::string arguments = input + " -screenshot ";
  ASSERT_EQ (runViewer ("", arguments + output + size), 0);
  View view = pcl::crest::fitView (*cloud, {SIZE, SIZE});
  const std::string png = contentOf (output);
  expectCrestsOfWaves (Picture (png), view);
  ASSERT_EQ (runViewer ("", arguments + output + size), 0);
  EXPECT_EQ (contentOf (output), png) << "pictures should be the same byte for byte";

  std::string said;
  ASSERT_EQ (
      runViewer ("",
                 arguments + output + " -cam 1,9/0.1,0,0/2,-1,4/0,1,0/0.6/450,500/0,0",
                 &said),
      0)
      << said;
  ASSERT_TRUE (
      pcl::crest::readView ("1,9/0.1,0,0/2,-1,4/0,1,0/0.6/450,500/0,0", view, said));
  const Picture oblique (contentOf (output));
  EXPECT_EQ (oblique.width(), 450);
  expectCrestsOfWaves (oblique, view);
  EXPECT_EQ (std::distance (std::filesystem::directory_iterator (folder), {}), 2)
      << "nothing else should be left behind";
}

TEST_F (Viewer, DrawsTheChartOnRequest)
{
  const std::string arguments = input + " -screenshot " + output + size;
  const auto inCorner = [this] (PixelTest& test) {
    const Picture picture (contentOf (output));
    int pixels = 0;
    for (int y = SIZE * 65 / 100; y < SIZE; ++y)
      for (int x = SIZE * 65 / 100; x < SIZE; ++x)
        pixels += test (picture (x, y)) ? 1 : 0;
    return pixels;
  };
  ASSERT_EQ (runViewer ("", arguments), 0);
  const int white = inCorner (isWhite);
  ASSERT_EQ (runViewer ("", arguments + " -chart"), 0);
  EXPECT_GT (inCorner (isWhite), white + 1000);
  EXPECT_GT (inCorner (isBlue), 50);
  EXPECT_GT (inCorner (isRed), 50);
}

TEST_F (Viewer, OptionsOfPclViewer)
{
  const auto picture = [this] (const std::string& options) {
    std::string said;
    EXPECT_EQ (
        runViewer ("", input + " -screenshot " + output + size + " " + options, &said),
        0)
        << said;
    return Picture (contentOf (output));
  };
  const Picture surface = picture ("");
  EXPECT_EQ (count (picture ("-ax 0.5"), isLime), 0) << "the surface is in front of y";
  const Picture dots = picture ("-ps 1 -ax 0.9");
  EXPECT_LT (count (dots, isGrey), count (surface, isGrey) / 2);
  EXPECT_GT (count (dots, isLime), 20);
  const Picture faint = picture ("-opaque 0.02");
  EXPECT_LT (count (faint, isGrey), count (surface, isGrey) / 2);
  const Picture on_dark = picture ("-bc 0,0,0.25 -sliders -color k1");
  EXPECT_EQ (on_dark (1, SIZE - 2), (std::array<int, 3>{0, 0, 64}));
  EXPECT_GT (count (picture ("-lw 6"), isBlue), count (surface, isBlue) * 3 / 2);
  for (const char* wrong : {"-ps 0",
                            "-ps 65",
                            "-ps 1.5",
                            "-opaque 2",
                            "-bc 0,0",
                            "-bc 0,0,2",
                            "-bc 0,0,0,0",
                            "-ax -1",
                            "-lw 0",
                            "-color pink"}) {
    std::string said;
    EXPECT_EQ (runViewer ("", input + " -screenshot " + output + " " + wrong, &said),
               1);
    EXPECT_NE (said.find (std::string (wrong).substr (0, 3)), std::string::npos)
        << said;
  }
}

TEST_F (Viewer, ColorsOfTheFile)
{
  pcl::PointCloud<pcl::PointXYZRGBNormal> colored;
  pcl::copyPointCloud (*cloud, colored);
  for (auto& point : colored) {
    point.r = 10;
    point.g = 200;
    point.b = 30;
  }
  pcl::io::savePCDFileBinary (input, colored);
  const std::string arguments = input + " -screenshot " + output + size;
  ASSERT_EQ (runViewer ("", arguments + " -color rgb"), 0);
  const Picture picture (contentOf (output));
  EXPECT_GT (count (picture, isOwnColor), SIZE * SIZE / 2);
  pcl::io::savePCDFileBinary (input, *cloud);
  std::string said;
  EXPECT_EQ (runViewer ("", arguments + " -color rgb", &said), 2);
  EXPECT_NE (said.find ("waves.pcd: it has no colors"), std::string::npos) << said;
}

TEST_F (Viewer, SaysWhatIsWrongWithTheCloud)
{
  const auto fails = [this] (const std::string& content, const std::string& why) {
    std::ofstream (folder + "/bad.xyz") << content;
    for (const std::string& way : {std::string(), " -screenshot " + output}) {
      std::string said;
      EXPECT_EQ (runViewer ("", folder + "/bad.xyz" + way, &said), 2) << way;
      EXPECT_NE (said.find ("bad.xyz"), std::string::npos) << said;
      EXPECT_NE (said.find (why), std::string::npos) << said;
    }
  };
  fails ("", "it is empty");
  fails ("nan nan nan\nnan nan nan\n", "nothing to show");
  fails ("1 2 three\n", "expected");
  EXPECT_FALSE (std::filesystem::exists (output));
}

TEST_F (Viewer, SaysThatItNeedsADisplay)
{
  for (const std::string before : {"env -u DISPLAY", "env DISPLAY=:4711"})
    for (const std::string& arguments : {input, input + " -screenshot " + output}) {
      std::string said;
      EXPECT_EQ (runViewer (before, arguments, &said), 2);
      EXPECT_NE (said.find ("needs an X display"), std::string::npos) << said;
      EXPECT_NE (said.find ("xvfb-run"), std::string::npos) << said;
    }
  // Of two mistakes the user's own is told first.
  std::string said;
  EXPECT_EQ (runViewer ("env -u DISPLAY", folder + "/missing.pcd", &said), 2);
  EXPECT_NE (said.find ("there is no such file"), std::string::npos) << said;
  EXPECT_FALSE (std::filesystem::exists (output));
}

TEST_F (Viewer, ExitsAsItsMistakesAre)
{
  const std::string screenshot = " -screenshot " + output;
  std::string said;
  EXPECT_EQ (runViewer ("", "-h", &said), 0);
  EXPECT_NE (said.find ("-screenshot"), std::string::npos);
  EXPECT_EQ (runViewer ("", "-wrong --version", &said), 0);
  EXPECT_EQ (said.find ("pcl_crest_viewer "), 0U);
  EXPECT_NE (said.find ("\npresets: auto (default), paper\nkernels: "),
             std::string::npos);
  EXPECT_EQ (runViewer ("", ""), 1);
  EXPECT_EQ (runViewer ("", input + " " + input + screenshot), 1);
  EXPECT_EQ (runViewer ("", input + screenshot + " -size 0x9"), 1);
  EXPECT_EQ (runViewer ("", input + screenshot + " -size 9x9x9"), 1);
  EXPECT_EQ (runViewer ("", input + screenshot + " -cam nothing"), 1);
  EXPECT_EQ (runViewer ("", input + screenshot + " -x"), 1);
  EXPECT_EQ (runViewer ("", input + " -screenshot " + folder + "/waves.jpg"), 1);
  EXPECT_EQ (runViewer ("", folder + "/missing.pcd" + screenshot), 2);
  EXPECT_EQ (runViewer ("timeout 60", folder + "/missing.pcd", &said), 2);
  EXPECT_NE (said.find ("missing.pcd"), std::string::npos) << said;
  EXPECT_EQ (runViewer ("", input + " -screenshot " + folder + "/no/waves.png"), 2);

  cloud->points.resize (3);
  cloud->width = 3;
  cloud->height = 1;
  pcl::io::savePCDFileBinary (input, *cloud);
  EXPECT_EQ (runViewer ("", input + screenshot, &said), 2);
  EXPECT_NE (said.find ("nothing to show"), std::string::npos) << said;
  EXPECT_FALSE (std::filesystem::exists (output));
}
