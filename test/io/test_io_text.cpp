// SPDX-License-Identifier: BSD-3-Clause
// Text in every dialect gives the same points as the plain file, and what is in doubt
// is refused.
#include <pcl_crest/io/read_cloud.h>

#include <gtest/gtest.h>

#include "support/sphere_mesh.h"
#include "support/temporary_directory.h"

#include <functional>
#include <sstream>

using namespace pcl::crest;

namespace {

using Words = std::vector<std::string>;

class IoText : public testing::Test {
protected:
  const oracle::TemporaryDirectory directory_;
  const std::vector<Eigen::Vector3f> points_ = oracle::cubeSphere (4).points;

  static std::string
  word (double number)
  {
    std::ostringstream text;
    text.precision (9);
    text << std::fixed << number;
    return text.str();
  }

  static std::string
  join (const Words& words, const std::string& separator)
  {
    std::string row;
    for (const std::string& word : words)
      row += (row.empty() ? "" : separator) + word;
    return row;
  }

  /** \brief A row for each point of the sphere.
   * \param[in] more what comes behind x y z of a point of this number
   */
  std::string
  rows (const std::string& separator,
        const std::string& end = "\n",
        const std::function<Words (std::size_t)>& more = {}) const
  {
    std::string text;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      Words words{word (points_[i].x()), word (points_[i].y()), word (points_[i].z())};
      for (const std::string& extra : more ? more (i) : Words())
        words.push_back (extra);
      text += join (words, separator) + end;
    }
    return text;
  }

  /** \brief The normal of a sphere turned over, which no estimation gives. */
  Words
  normal (std::size_t i) const
  {
    const Eigen::Vector3f n = -points_[i].normalized();
    return {word (n.x()), word (n.y()), word (n.z())};
  }

  static std::string
  withCommas (std::string text)
  {
    for (char& c : text)
      c = c == '.' ? ',' : c;
    return text;
  }

  InputCloud
  read (const std::string& text, const ReadOptions& options = {}) const
  {
    InputCloud cloud;
    std::string error;
    EXPECT_TRUE (
        readCloud (directory_.file ("a.txt", text), 12, 1, cloud, error, options))
        << error;
    if (!cloud.points)
      cloud.points.reset (new pcl::PointCloud<pcl::PointNormal>);
    return cloud;
  }

  std::string
  refusal (const std::string& text, const ReadOptions& options = {}) const
  {
    InputCloud cloud;
    std::string error;
    const std::string file = directory_.file ("bad.txt", text);
    EXPECT_FALSE (readCloud (file, 12, 1, cloud, error, options)) << text;
    return error.substr (std::min (file.size(), error.size()));
  }

  void
  expectPoints (const InputCloud& cloud, NormalSource normals) const
  {
    ASSERT_EQ (points_.size(), cloud.points->size());
    EXPECT_EQ (normals, cloud.normals);
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const pcl::PointNormal& point = (*cloud.points)[i];
      ASSERT_LE ((point.getVector3fMap() - points_[i]).norm(), 1e-6F);
      ASSERT_EQ (normals == NormalSource::FILE,
                 point.getNormalVector3fMap().dot (points_[i]) < 0.0F);
    }
  }
};

TEST_F (IoText, EveryDialect)
{
  const auto with_normals = [this] (std::size_t i) { return normal (i); };
  for (const std::string separator : {" ", "  ", "\t", ",", ", ", ";", " ; "})
    for (const std::string end : {"\n", "\r", "\r\n", " \n", "\n\n"})
      for (const bool commas : {false, true}) {
        if (commas && separator[0] == ',')
          continue;
        const auto written = [commas] (const std::string& text) {
          return commas ? withCommas (text) : text;
        };
        SCOPED_TRACE (testing::Message()
                      << "separator \"" << separator << "\" end \"" << end << "\"");
        expectPoints (read (written (rows (separator, end))), NormalSource::ESTIMATED);
        expectPoints (read (written (rows (separator, end, with_normals))),
                      NormalSource::FILE);
      }
  for (const std::string end : {",\n", ";\r\n", "\t\n"})
    expectPoints (read (rows (end.substr (0, 1), end)), NormalSource::ESTIMATED);
}

TEST_F (IoText, WhatStandsAboveThePoints)
{
  const std::string count = std::to_string (points_.size());
  for (const std::string& head : {std::string ("\xEF\xBB\xBF"),
                                  "\xEF\xBB\xBF" + count + "\n",
                                  std::string ("# anything at all, 1 2 3\n\n"),
                                  std::string ("// x y z\n"),
                                  std::string ("X Y Z\n"),
                                  std::string ("x,y,z\n"),
                                  std::string ("easting [m];northing [m];height [m]\n"),
                                  "//X Y Z\n" + count + "\n",
                                  count + "\r\n"})
    expectPoints (read (head + rows (" ")), NormalSource::ESTIMATED);
}

TEST_F (IoText, SeveralCloudsWithACountEach)
{
  const std::string cloud = std::to_string (points_.size()) + "\n" + rows (" ");
  EXPECT_EQ (2 * points_.size(), read (cloud + cloud).points->size());
}

TEST_F (IoText, ColumnsByTheirNames)
{
  const InputCloud cloud =
      read ("//X;Y;Z;Rf;Gf;Bf;Scalar_field;Nx;Ny;Nz\n" + rows (";", "\n", [&] (auto i) {
              Words words{"1.0", "0.2", "0", i % 2 == 0 ? "" : "-7"};
              for (const std::string& n : normal (i))
                words.push_back (n);
              return words;
            }));
  expectPoints (cloud, NormalSource::FILE);
  ASSERT_EQ (points_.size(), cloud.colors.size());
  EXPECT_EQ ((std::array<unsigned char, 3>{255, 51, 0}), cloud.colors[3]);
  EXPECT_EQ ("The columns are x,y,z,r,g,b,-,nx,ny,nz, by their names.",
             cloud.notes.at (0));
  const InputCloud turned = read ("z x y\n1 2 3\n4 5 6\n7 8 9\n");
  EXPECT_EQ (Eigen::Vector3f (5, 6, 4), (*turned.points)[1].getVector3fMap());
}

TEST_F (IoText, ColumnsByTheirValues)
{
  struct Case {
    std::function<Words (std::size_t)> more;
    std::string columns;
    bool has_colors;
  };
  const std::vector<Case> cases{
      {[] (auto i) { return Words{std::to_string (i * 37 % 2000)}; }, "x,y,z,-", false},
      {[] (auto i) {
         return Words{std::to_string (1.0 * (i % 7) / 7), "0.5", "0.25"};
       },
       "x,y,z,r,g,b",
       true},
      {[] (auto i) {
         return Words{std::to_string (i % 256), "0", "255"};
       },
       "x,y,z,r,g,b",
       true},
      {[] (auto i) {
         return Words{std::to_string (i * 37 % 2000), "2", "1"};
       },
       "x,y,z,-,-,-",
       false},
      {[] (auto i) {
         return Words{std::to_string (i - 20.5), std::to_string (i % 256), "0", "255"};
       },
       "x,y,z,-,r,g,b",
       true},
      {[] (auto i) { return Words{i % 2 == 0 ? "tree" : "soil"}; }, "x,y,z,-", false}};
  for (const Case& c : cases) {
    const InputCloud cloud = read (rows (" ", "\n", c.more));
    expectPoints (cloud, NormalSource::ESTIMATED);
    EXPECT_EQ ("The columns are " + c.columns + ", by their values, without normals.",
               cloud.notes.at (0));
    EXPECT_EQ (c.has_colors ? points_.size() : 0, cloud.colors.size());
  }
  const InputCloud with_normals = read (rows (" ", "\n", [&] (auto i) {
    Words words{std::to_string (i % 256), "7", "255", "-0.125"};
    for (const std::string& n : normal (i))
      words.push_back (n);
    return words;
  }));
  expectPoints (with_normals, NormalSource::FILE);
  EXPECT_EQ (points_.size(), with_normals.colors.size());
}

TEST_F (IoText, NumbersOrNamesOfPointsFirst)
{
  for (const std::string name : {"", "P"}) {
    std::istringstream plain (rows (","));
    std::string text;
    std::string row;
    for (int i = 7; std::getline (plain, row); ++i)
      text.append (name).append (std::to_string (i)).append (",").append (row) += '\n';
    const InputCloud cloud = read (text);
    expectPoints (cloud, NormalSource::ESTIMATED);
    EXPECT_EQ ("The columns are -,x,y,z, by their values, without normals.",
               cloud.notes.at (0));
  }
}

TEST_F (IoText, ColumnsThatAreGiven)
{
  std::istringstream plain (rows (" "));
  std::string text = "some title\n";
  std::string row;
  for (int i = 0; std::getline (plain, row); ++i)
    text += std::to_string (i * i) + " n/a " + row + "\n";
  ReadOptions options;
  options.columns = {"-", "-", "x", "y", "z"};
  expectPoints (read (text, options), NormalSource::ESTIMATED);
  options.columns = {"x", "y", "z"};
  EXPECT_NE (std::string::npos, refusal (text, options).find ("-columns"));
  options.columns = {"x", "y", "x"};
  EXPECT_EQ (": the column x is given twice", refusal (text, options));
  options.columns = {"x", "y"};
  EXPECT_EQ (": the columns lack z", refusal (text, options));
  options.columns = {"x", "y", "z", "w"};
  EXPECT_NE (std::string::npos, refusal (text, options).find ("no column \"w\""));
}

TEST_F (IoText, FormatThatIsGiven)
{
  ReadOptions options;
  options.format = "csv";
  InputCloud cloud;
  std::string error;
  const std::string file = directory_.file ("scan.data", rows (","));
  ASSERT_TRUE (readCloud (file, 12, 1, cloud, error, options)) << error;
  expectPoints (cloud, NormalSource::ESTIMATED);
  options.format = "ply";
  EXPECT_FALSE (readCloud (file, 12, 1, cloud, error, options));
  options.format = "doc";
  EXPECT_FALSE (readCloud (file, 12, 1, cloud, error, options));
  EXPECT_NE (std::string::npos, error.find ("\"doc\" is none of pcd, ply"));
}

TEST_F (IoText, DoubtIsRefused)
{
  std::string with_numbers;
  std::string decimals;
  std::string two_normals;
  for (int i = 0; i < 20; ++i) {
    const std::string z = "0." + std::to_string (10 + i);
    with_numbers += std::to_string (i * 29 % 20) + " 1.5 " + z + " 2.5\n";
    decimals += "0,9" + std::to_string (i + 10) + ",-1,009,0,014\n";
    two_normals += "1.5 " + z + " 2.5 0 0 1 0.5 0 1 0\n";
  }
  EXPECT_EQ (
      ": column 1 may be x, or the number of the point: -columns tells it, as in "
      "-columns x,y,z,-,nx,ny,nz",
      refusal (with_numbers));
  EXPECT_NE (std::string::npos, refusal (two_normals).find ("-columns"));
  EXPECT_EQ (":1: its commas may part the columns, or decimals from whole numbers: "
             "-columns says that they part the columns; else part these by semicolons",
             refusal (decimals));
  EXPECT_NE (std::string::npos, refusal ("a b c\n1 2 3\n").find ("-columns"));
  EXPECT_NE (std::string::npos, refusal ("x y\n1 2 3\n").find ("-columns"));
  EXPECT_NE (std::string::npos, refusal ("x y z x\n1 2 3 4\n").find ("-columns"));
  EXPECT_NE (std::string::npos,
             refusal ("ncols 4\nnrows 4\n1 2 3 4\n").find ("gdal_translate"));
}

TEST_F (IoText, MistakesAreNamedWithTheirLine)
{
  std::string million = "x,y,z\n";
  while (million.size() < 6000000)
    million += "1.5,2.5,3\n";
  const auto line = std::count (million.begin(), million.end(), '\n') + 1;
  const std::string where = ":" + std::to_string (line) + ": ";
  EXPECT_EQ (where + "expected a number in column 2, found \"2.5x\"",
             refusal (million + "1.5,2.5x,3\n" + million.substr (6)));
  EXPECT_EQ (where + "expected a number in column 3, found \"\"",
             refusal (million + "1.5,2.5\n" + million.substr (6)));
  EXPECT_EQ (where + "expected 3 columns as in the other lines, found 4",
             refusal (million + "1,2,3,4\n" + million.substr (6)));
  EXPECT_EQ (":4: the file ends after 2 of the 3 points that it announces",
             refusal ("3\n0 0 0\n1 0 0\n\n"));
  EXPECT_EQ (":3: expected 1 points, as the row above them announces, found more",
             refusal ("1\n0 0 0\n1 0 0\n"));
}

} // namespace
