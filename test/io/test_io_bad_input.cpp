// SPDX-License-Identifier: BSD-3-Clause
// Files that cannot be read are refused with a message that names them.
#include <pcl_crest/io/read_cloud.h>

#include <gtest/gtest.h>

#include "support/temporary_directory.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <map>
#include <random>

using namespace pcl::crest;

namespace {

const std::string PCD_HEADER =
    "VERSION .7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\n";
const std::string VTK_HEADER =
    "# vtk DataFile Version 3.0\nx\nASCII\nDATASET POLYDATA\n";

/** \brief A correct file of each format, in text. */
const std::map<std::string, std::string> GOOD{
    {"a.pcd",
     PCD_HEADER + "WIDTH 4\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS 4\nDATA ascii\n"
                  "0 0 0\n1 0 0\n0 1 0\n1 1 0\n"},
    {"a.ply",
     "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
     "property float z\nelement face 1\nproperty list uchar int vertex_indices\n"
     "end_header\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n3 0 1 2\n"},
    {"a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3\nf 2 4 3\n"},
    {"a.off", "OFF\n4 2 0\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n3 0 1 2\n3 1 3 2\n"},
    {"a.stl",
     "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n"
     "vertex 0 1 0\nendloop\nendfacet\nendsolid a\n"},
    {"a.vtk",
     VTK_HEADER +
         "POINTS 4 float\n0 0 0\n1 0 0\n0 1 0\n1 1 0\nPOLYGONS 1 4\n3 0 1 2\n"},
    {"a.ptx",
     "2\n2\n0 0 9\n1 0 0\n0 1 0\n0 0 1\n1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n"
     "0 0 1 .5\n1 0 1 .5\n0 1 1 .5\n1 1 1 .5\n"},
    {"a.xyz", "0 0 0\n1 0 0\n0 1 0\n1 1 0\n"}};

class IoBadInput : public testing::Test {
protected:
  const oracle::TemporaryDirectory directory_;

  /** \brief The message on a file that must be refused, without its name. */
  static std::string
  refusal (const std::string& file)
  {
    InputCloud cloud;
    cloud.notes = {"untouched"};
    std::string error;
    EXPECT_FALSE (readCloud (file, 4, 1, cloud, error)) << file;
    EXPECT_EQ (nullptr, cloud.points);
    EXPECT_EQ (1U, cloud.notes.size());
    EXPECT_EQ (0U, error.find (file)) << error;
    return error.substr (std::min (file.size(), error.size()));
  }

  std::string
  refusal (const std::string& name, const std::string& content) const
  {
    return refusal (directory_.file (name, content));
  }
};

TEST_F (IoBadInput, GoodFilesAreRead)
{
  for (const auto& [name, content] : GOOD) {
    InputCloud cloud;
    std::string error;
    EXPECT_TRUE (readCloud (directory_.file (name, content), 4, 1, cloud, error))
        << error;
  }
}

TEST_F (IoBadInput, WhatIsNoFile)
{
  for (const auto& [name, content] : GOOD) {
    EXPECT_EQ (": there is no such file", refusal (directory_.file (name)));
    EXPECT_EQ (": it is empty", refusal (name, ""));
    std::filesystem::remove (directory_.file (name));
    std::filesystem::create_directory (directory_.file (name));
    EXPECT_EQ (": it is a directory, but a file is needed",
               refusal (directory_.file (name)));
  }
  EXPECT_EQ (": it is not a regular file", refusal ("/dev/null"));
  const std::string extension = refusal ("a.doc", "0 0 0\n");
  EXPECT_NE (std::string::npos, extension.find ("\".doc\" is none of .pcd, .ply"));
  EXPECT_NE (std::string::npos, refusal ("a", "0 0 0\n").find ("none of .pcd"));
}

TEST_F (IoBadInput, Garbage)
{
  std::mt19937 random (1);
  std::string noise;
  for (int i = 0; i < 5000; ++i)
    noise += static_cast<char> (random());
  for (const auto& [name, content] : GOOD) {
    refusal (name, noise);
    refusal (name, "This is a text that has nothing to do with points.\n");
    refusal (name, std::string (1000, '\0'));
    refusal (name, "\n\n\n");
  }
}

TEST_F (IoBadInput, MistakesAreNamedWithTheirLine)
{
  const std::map<std::string, std::vector<std::array<std::string, 2>>> mistakes{
      {"a.off",
       {{"OFF\n3 0 0\n0 0 0\n1 0\n", ":4: expected 3 coordinates, found 2"},
        {"OFF\n3 0 0\n0 0 0\n1 x 0\n", ":4: expected a coordinate, found \"x\""},
        {"OFF\n2 0 0\n0 0 0\n", ":3: the file ends after 1 of 2 vertices"},
        {"OFF\n1 1 0\n0 0 0\n3 0 0 1\n",
         ":4: vertex 1 is not one of the 1 (they count from 0)"},
        {"OFF\n1 1 0\n0 0 0\n3 0 0\n", ":4: expected 3 vertices, found 2"},
        {"OFF\n-1 1 0\n",
         ":2: the numbers of vertices and of faces must not be negative"},
        {"OFF\n0 0 0\n", ": it has no points"},
        {"4OFF\n0 0 0\n",
         ":1: OFF files with the header \"4OFF\" are not supported, only OFF, COFF, "
         "NOFF and CNOFF are"}}},
      {"a.obj",
       {{"v 0 0\n", ":1: expected 3 coordinates, found 2"},
        {"v 0 0 0\nf 1 1 2\n",
         ": a face has the corner 1, counted from 0, but there are only 1 points"},
        {"v 0 0 0\n\nf 1 1 0\n",
         ":3: there is no vertex or normal 0 (they count from 1, or backwards from "
         "-1)"},
        {"v 0 0 0\nf 1 1\n", ":2: expected at least 3 vertices, found 2"},
        {"v 0,5 0 0\n", ":1: expected a coordinate, found \"0,5\""},
        {"vn 0 0 1\n", ": it has no points"}}},
      {"a.xyz",
       {{"0 0 0\n1 2\n", ":2: expected 3 columns as in the other lines, found 2"},
        {"0 0\n",
         ":1: expected at least 3 numbers, x y z, parted by blanks, tabs, commas or "
         "semicolons, found \"0 0\""},
        {"# only a comment\n", ": it has no points"}}},
      {"a.ptx",
       {{"2\n2\n0 0\n",
         ":3: expected the position of the scanner, 3 numbers, found 2 words"},
        {"1\n1\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n"
         "1 2 3 0 4 5 256\n",
         ":11: expected a color up to 255, found \"256\""},
        {"2000000000\n1\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 0 0 0\n0 1 0 0\n0 0 1 0\n"
         "0 0 0 1\n1 2 3 0\n",
         ":10: the scan should have 2000000000 points, but the file is too short for "
         "them"}}},
      {"a.stl",
       {{"solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0\n",
         ":5: the file ends where a coordinate was expected"},
        {"solid a\nendsolid a\n", ": it has no points"}}},
      {"a.ply",
       {{"ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n0\n",
         ": its vertices need the properties x, y and z"},
        {"ply\nformat ascii 1.0\nelement vertex 0\nproperty float x\n"
         "element vertex 2\nproperty float x\n",
         ":5: the header has the element \"vertex\" twice"},
        {"ply\nformat ascii 1.0\nproperty float x\n",
         ":3: a property comes after an element"},
        {"ply\nformat ascii 1.0\nelement vertex 1\n",
         ":3: the file ends within its header, before \"end_header\""}}},
      {"a.vtk",
       {{"# vtk DataFile Version 3.0\nx\nASCII\nDATASET RECTILINEAR_GRID\n",
         ":4: only the datasets POLYDATA and UNSTRUCTURED_GRID are supported, found "
         "\"RECTILINEAR_GRID\""},
        {VTK_HEADER + "POINTS 1 float\n0 0 0\nPOLYGONS 1 4\n3 0 0 1\n",
         ":8: a face has a corner that is not one of the 1 points"}}},
      {"a.pcd",
       {{"VERSION .7\nFIELDS x y\nSIZE 4 4\nTYPE F F\nWIDTH 1\nHEIGHT 1\nPOINTS 1\n"
         "DATA ascii\n0 0\n",
         ": it has the fields \"x y\", but x, y and z are needed"},
        {PCD_HEADER + "WIDTH 2\nHEIGHT 2\nPOINTS 3\nDATA ascii\n",
         ": its header announces 3 points, but a width of 2 and a height of 2"},
        {PCD_HEADER + "WIDTH 0\nHEIGHT 1\nPOINTS 0\nDATA ascii\n",
         ": it has no points"}}}};
  for (const auto& [name, cases] : mistakes)
    for (const auto& [content, message] : cases)
      EXPECT_EQ (message, refusal (name, content)) << content;
}

TEST_F (IoBadInput, HeadersThatAnnounceMoreThanThereIs)
{
  const std::string ply = "element vertex 2000000000\nproperty float x\n"
                          "property float y\nproperty float z\nend_header\n0 0 0\n";
  const std::vector<std::array<std::string, 2>> files{
      {"a.off", "OFF\n2000000000 2000000000 0\n0 0 0\n"},
      {"a.ply", "ply\nformat ascii 1.0\n" + ply},
      {"a.ply", "ply\nformat binary_little_endian 1.0\n" + ply},
      {"a.ply",
       "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
       "property float z\nelement face 1\nproperty list int int vertex_index\n"
       "end_header\n0 0 0\n2000000000 0 0 0\n"},
      {"a.vtk", VTK_HEADER + "POINTS 2000000000 float\n0 0 0\n"},
      {"a.vtk", VTK_HEADER + "POINTS 6148914691236517206 float\n0 0 0\n"},
      {"a.vtk", VTK_HEADER + "POINTS 1 float\n0 0 0\nPOLYGONS 1 2000000000\n3 0 0 0\n"},
      {"a.vtk",
       VTK_HEADER +
           "POINTS 1 float\n0 0 0\nFIELD f 1\na 99999999999 99999999999 int\n"},
      {"a.stl", std::string (80, ' ') + "\xFF\xFF\xFF\x7F" + std::string (50, '\0')},
      {"a.pcd",
       PCD_HEADER +
           "WIDTH 2000000000\nHEIGHT 1\nPOINTS 2000000000\nDATA ascii\n0 0 0\n"},
      {"a.pcd",
       PCD_HEADER + "WIDTH 2000000000\nHEIGHT 1\nPOINTS 2000000000\nDATA binary\nxx"},
      {"a.pcd",
       PCD_HEADER +
           "WIDTH 100000000\nHEIGHT 1\nPOINTS 100000000\n"
           "DATA binary_compressed\n" +
           std::string ("\x04\0\0\0\0\x8C\x86\x47xxxx", 12)}};
  for (const auto& [name, content] : files)
    refusal (name, content);
}

TEST_F (IoBadInput, HeadersThatAnnounceMoreThanIndicesReach)
{
  const std::string coordinates =
      "property float x\nproperty float y\nproperty float z\nend_header\n0 0 0\n";
  const std::vector<std::array<std::string, 2>> files{
      {"a.off", "OFF\n3000000000 0 0\n0 0 0\n"},
      {"a.ply", "ply\nformat ascii 1.0\nelement vertex 3000000000\n" + coordinates},
      {"a.ply",
       "ply\nformat binary_little_endian 1.0\nelement vertex 3000000000\n" +
           coordinates},
      {"a.vtk", VTK_HEADER + "POINTS 3000000000 float\n0 0 0\n"},
      {"a.pcd",
       PCD_HEADER + "WIDTH 3000000000\nHEIGHT 1\nPOINTS 3000000000\nDATA binary\nxx"},
      {"a.pcd", PCD_HEADER + "WIDTH 50000\nHEIGHT 60000\nDATA ascii\n0 0 0\n"}};
  for (const auto& [name, content] : files)
    EXPECT_EQ (": 3000000000 points are too large a cloud for 32-bit indices, which "
               "tell 2147483647 points apart",
               refusal (name, content))
        << content;
}

TEST_F (IoBadInput, PcdFieldsThatNoPointCanHave)
{
  // Beside x y z of 4 bytes each, so many fields of these sizes and counts.
  const auto pcd =
      [] (int fields, const std::string& size, const std::string& count, int points) {
        std::string names = "FIELDS x y z";
        std::string sizes = "\nSIZE 4 4 4";
        std::string types = "\nTYPE F F F";
        std::string counts = "\nCOUNT 1 1 1";
        for (int i = 0; i < fields; ++i) {
          names += " f" + std::to_string (i);
          sizes += " " + size;
          types += " F";
          counts += " " + count;
        }
        return "VERSION .7\n" + names + sizes + types + counts + "\nWIDTH " +
               std::to_string (points) + "\nHEIGHT 1\nDATA binary\n" +
               std::string (1000000, '\0');
      };
  // But for x y z, the size of all points is 0 modulo 2^64.
  EXPECT_EQ (":3: a field has numbers of 1048576 bytes, but must have 1, 2, 4 or 8",
             refusal ("a.pcd", pcd (256, "1048576", "1048576", 65536)));
  EXPECT_EQ (":3: a field has numbers of 3 bytes, but must have 1, 2, 4 or 8",
             refusal ("a.pcd", pcd (1, "3", "1", 1)));
  EXPECT_EQ (":5: a field has a count of 1048577, but must have one up to 1048576",
             refusal ("a.pcd", pcd (1, "8", "1048577", 1)));
  EXPECT_EQ (": its header announces points of 2147483660 bytes, but at most "
             "2147483647 are supported",
             refusal ("a.pcd", pcd (256, "8", "1048576", 1)));
  EXPECT_EQ (": its header announces 2000000000 points, which take at least "
             "4278190104000000000 bytes, but only 1000000 follow",
             refusal ("a.pcd", pcd (255, "8", "1048576", 2000000000)));
}

TEST_F (IoBadInput, PcdHeadersThatContradictThemselves)
{
  const std::string rest = "WIDTH 4\nHEIGHT 1\nPOINTS 4\nDATA ascii\n"
                           "0 0 0\n1 0 0\n0 1 0\n1 1 0\n";
  const std::vector<std::array<std::string, 2>> mistakes{
      {"FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nSIZE 8 8 8\n" + rest,
       ":4: the header has the line SIZE twice"},
      {"FIELDS x y z\nCOLUMNS z y x\nSIZE 4 4 4\nTYPE F F F\n" + rest,
       ":2: the header has the line FIELDS twice"},
      {"FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nPOINTS 9\n" + rest,
       ":7: the header has the line POINTS twice"},
      {"FIELDS x y z\nSIZE 4 4 4\nTYPE FF F\n" + rest,
       ":3: a field has the type \"FF\", but must have I, U or F"},
      {"FIELDS x y z\nSIZE 4 4 4\nTYPE F F\n" + rest,
       ": its header needs FIELDS, SIZE, TYPE and COUNT of equal numbers"},
      {PCD_HEADER + "VIEWPOINT 0 0 1e400 1 0 0 0\n" + rest,
       ":6: a number of the viewpoint is 1e400, but must be one that a float can hold"},
      {PCD_HEADER + "VIEWPOINT 0 nan 0 1 0 0 0\n" + rest,
       ":6: a number of the viewpoint is nan, but must be one that a float can hold"},
      {PCD_HEADER + "VIEWPOINT 0 0 0 1 0 0\n" + rest,
       ":6: expected a viewpoint of 7 numbers"},
      // Names of fields may be anything, and do not reach a terminal as they are.
      {"FIELDS x \x1b[2J\x07 z\nSIZE 4 4 4\nTYPE F F F\n" + rest,
       ": it has the fields \"x ?[2J? z\", but x, y and z are needed"}};
  for (const auto& [content, message] : mistakes)
    EXPECT_EQ (message, refusal ("a.pcd", content)) << content;
}

TEST_F (IoBadInput, PcdHeadersOfAnyOrder)
{
  const std::string rows = "0 0 0\n1 0 0\n# a comment\n0 1 0\n1\v1\v0\n";
  std::vector<std::string> lines{"VERSION .7",
                                 "FIELDS x y z",
                                 "SIZE 4 4 4",
                                 "TYPE F F F",
                                 "COUNT 1 1 1",
                                 "WIDTH 4",
                                 "HEIGHT 1",
                                 "VIEWPOINT 0 0 0 1 0 0 0",
                                 "POINTS 4"};
  std::mt19937 random (3);
  for (int round = 0; round < 50; ++round) {
    std::shuffle (lines.begin(), lines.end(), random);
    std::string header;
    for (const std::string& line : lines)
      header += line + "\n";
    header += "DATA ascii\n";
    InputCloud cloud;
    std::string error;
    ASSERT_TRUE (
        readCloud (directory_.file ("a.pcd", header + rows), 4, 1, cloud, error))
        << error;
    ASSERT_EQ (4U, cloud.points->size());
    EXPECT_EQ (Eigen::Vector3f (1, 1, 0), (*cloud.points)[3].getVector3fMap());
  }
}

TEST_F (IoBadInput, PcdDataThatLookLikeAHeader)
{
  // The first bytes of the points are text, which may say anything.
  for (std::string data : {"\nCOUNT 9 9 9\nWIDTH 7\n", "\nPOINTS 2000000000\nDATA x"}) {
    data.resize (48, '\0');
    const std::string header =
        PCD_HEADER + "WIDTH 4\nHEIGHT 1\nPOINTS 4\nDATA binary\n";
    InputCloud cloud;
    std::string error;
    ASSERT_TRUE (
        readCloud (directory_.file ("a.pcd", header + data), 4, 1, cloud, error))
        << error;
    std::array<float, 12> expected;
    std::memcpy (expected.data(), data.data(), sizeof (expected));
    ASSERT_EQ (4U, cloud.points->size());
    for (std::size_t i = 0; i < expected.size(); ++i)
      EXPECT_EQ (expected[i], (*cloud.points)[i / 3].data[i % 3]) << i;
  }
}

TEST_F (IoBadInput, PcdCompressedDataThatAreNone)
{
  const auto pcd = [] (const std::string& data) {
    const std::string size (1, static_cast<char> (data.size()));
    return PCD_HEADER + "WIDTH 4\nHEIGHT 1\nDATA binary_compressed\n" + size +
           std::string ("\0\0\0\x30\0\0\0", 7) + data;
  };
  const std::string run = "\x1f" + std::string (32, 'a');
  InputCloud cloud;
  std::string error;
  // Of 48 bytes the last are as those before: 2 + 14 of them, two of which repeat.
  const std::string good = pcd (run + "\xe0\x07\x01");
  EXPECT_TRUE (readCloud (directory_.file ("a.pcd", good), 4, 1, cloud, error))
      << error;
  const std::vector<std::array<std::string, 2>> mistakes{
      {run, ": its compressed data hold 32 bytes, but its points take 48"},
      {run + "\xe0", ": its compressed data are cut off"},
      {run + "\x1f" + "abc", ": its compressed data are cut off"},
      {run + run, ": its compressed data hold more than the 48 bytes of its points"},
      {run + std::string ("\xe0\xff\0", 3),
       ": its compressed data hold more than the 48 bytes of its points"},
      {run + std::string ("\xe0\x07\x20", 3),
       ": its compressed data refer to bytes before their first"}};
  for (const auto& [data, message] : mistakes)
    EXPECT_EQ (message, refusal ("a.pcd", pcd (data)));
}

TEST_F (IoBadInput, NoFileIsReadInPart)
{
  // Cut off anywhere before its last point, none of the files is taken for a whole one,
  // but those that have neither a number of points nor an end.
  for (const auto& [name, content] : GOOD)
    if (name != "a.obj" && name != "a.xyz")
      for (std::size_t length = 1; length + 26 < content.size(); ++length)
        refusal (name, content.substr (0, length));
}

TEST_F (IoBadInput, DamagedFilesAreReadOrRefused)
{
  std::mt19937 random (5);
  for (const auto& [name, content] : GOOD)
    for (int round = 0; round < 300; ++round) {
      std::string damaged = content;
      for (unsigned i = 0; i <= random() % 4; ++i)
        if (random() % 2 == 0)
          damaged[random() % damaged.size()] = static_cast<char> (random());
        else
          damaged.insert (random() % damaged.size(), std::to_string (random()));
      const std::string file = directory_.file (name, damaged);
      InputCloud cloud;
      std::string error;
      if (readCloud (file, 4, 1, cloud, error)) {
        ASSERT_FALSE (cloud.points->empty());
        ASSERT_EQ (cloud.points->size(), cloud.points->width * cloud.points->height);
      }
      else
        ASSERT_EQ (0U, error.find (file)) << error;
    }
}

TEST_F (IoBadInput, FewAndDegeneratePointsAreReadAllTheSame)
{
  std::string line;
  for (int i = 0; i < 30; ++i)
    line += std::to_string (i) + " 0 0\n";
  std::string equal;
  for (int i = 0; i < 30; ++i)
    equal += "1 2 3\n";
  for (const std::string& content :
       {std::string ("1 2 3\n"), std::string ("nan nan nan\n"), line, equal}) {
    InputCloud cloud;
    std::string error;
    EXPECT_TRUE (readCloud (directory_.file ("a.xyz", content), 24, 1, cloud, error))
        << error;
  }
}

} // namespace
