// SPDX-License-Identifier: BSD-3-Clause
// Meshes of large faces, as CAD programs write them, give their edges.
#include <pcl_crest/crest_line_estimation.h>
#include <pcl_crest/io/read_cloud.h>

#include <gtest/gtest.h>

#include "support/polygon_mesh.h"
#include "support/temporary_directory.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

using namespace pcl::crest;
using oracle::PolygonMesh;

namespace {

/** \brief Calls use for each face with its corners. */
template <typename Use>
void
forEachFace (const PolygonMesh& mesh, const Use& use)
{
  for (std::size_t face = 0; face < mesh.faces.size(); ++face)
    use (std::vector<pcl::crest::index_t> (
        mesh.faces.corners.begin() +
            static_cast<std::ptrdiff_t> (mesh.faces.begin (face)),
        mesh.faces.corners.begin() +
            static_cast<std::ptrdiff_t> (mesh.faces.ends[face])));
}

/** \brief Vertices, or faces, a line each. */
std::string
linesOf (const PolygonMesh& mesh, bool faces, const std::string& head)
{
  std::ostringstream text;
  text.precision (9);
  if (!faces)
    for (const Eigen::Vector3f& p : mesh.points)
      text << head << p.transpose() << '\n';
  else
    forEachFace (mesh, [&] (const std::vector<pcl::crest::index_t>& corners) {
      text << head << (head.empty() ? std::to_string (corners.size()) : "");
      for (const pcl::crest::index_t corner : corners)
        text << ' ' << corner + (head.empty() ? 0 : 1);
      text << '\n';
    });
  return text.str();
}

std::string
asOff (const PolygonMesh& mesh)
{
  return "OFF\n" + std::to_string (mesh.points.size()) + " " +
         std::to_string (mesh.faces.size()) + " 0\n" + linesOf (mesh, false, "") +
         linesOf (mesh, true, "");
}

std::string
asPly (const PolygonMesh& mesh)
{
  return "ply\nformat ascii 1.0\nelement vertex " +
         std::to_string (mesh.points.size()) +
         "\nproperty float x\nproperty float y\nproperty float z\nelement face " +
         std::to_string (mesh.faces.size()) +
         "\nproperty list uchar int vertex_indices\nend_header\n" +
         linesOf (mesh, false, "") + linesOf (mesh, true, "");
}

std::string
asVtk (const PolygonMesh& mesh)
{
  return "# vtk DataFile Version 3.0\nmesh\nASCII\nDATASET POLYDATA\nPOINTS " +
         std::to_string (mesh.points.size()) + " float\n" + linesOf (mesh, false, "") +
         "POLYGONS " + std::to_string (mesh.faces.size()) + " " +
         std::to_string (mesh.faces.size() + mesh.faces.corners.size()) + "\n" +
         linesOf (mesh, true, "");
}

/** \brief A fan of triangles for each face, which have to be convex. */
std::string
asStl (const PolygonMesh& mesh)
{
  std::ostringstream text;
  text.precision (9);
  text << "solid mesh\n";
  forEachFace (mesh, [&] (const std::vector<pcl::crest::index_t>& corners) {
    for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
      text << "facet normal 0 0 0\nouter loop\n";
      for (const pcl::crest::index_t corner : {corners[0], corners[i], corners[i + 1]})
        text << "vertex " << mesh.points[corner].transpose() << '\n';
      text << "endloop\nendfacet\n";
    }
  });
  return text.str() + "endsolid mesh\n";
}

class IoFaces : public testing::Test {
protected:
  const oracle::TemporaryDirectory directory_;

  InputCloud
  read (const std::string& name,
        const std::string& content,
        const ReadOptions& options = {}) const
  {
    InputCloud cloud;
    std::string error;
    EXPECT_TRUE (
        readCloud (directory_.file (name, content), 24, 2, cloud, error, options))
        << error;
    return cloud;
  }

  std::string
  refusal (const std::string& name, const std::string& content, double spacing) const
  {
    ReadOptions options;
    options.sample_spacing = spacing;
    InputCloud cloud;
    std::string error;
    EXPECT_FALSE (
        readCloud (directory_.file (name, content), 24, 2, cloud, error, options));
    return error;
  }
};

struct Lengths {
  double ridges = 0.0;
  double valleys = 0.0;
  std::size_t lines = 0;
};

Lengths
linesOf (const InputCloud& cloud)
{
  pcl::CrestLineEstimation<pcl::PointNormal> estimation;
  estimation.setInputCloud (cloud.points);
  estimation.setUseBatchedSearch (true);
  pcl::PointCloud<pcl::Label> labels;
  estimation.compute (labels);
  EXPECT_EQ (cloud.points->size(), labels.size());
  Lengths lengths;
  for (const CrestLine& line : estimation.getLines()) {
    (line.type == CrestType::RIDGE ? lengths.ridges : lengths.valleys) += line.length;
    ++lengths.lines;
  }
  return lengths;
}

TEST_F (IoFaces, TwelveTrianglesGiveTwelveEdges)
{
  const PolygonMesh box = oracle::cuboid (1.0F, 0.8F, 0.6F);
  const InputCloud stl = read ("a.stl", asStl (box));
  EXPECT_EQ (12U, stl.sampled.faces);
  EXPECT_TRUE (stl.sampled.sides_agree);
  EXPECT_NEAR (stl.sampled.spacing, std::sqrt (3.76 / 4e4), 1e-6);
  EXPECT_EQ (NormalSource::FACES, stl.normals);
  ASSERT_EQ (1U, stl.notes.size());
  EXPECT_NE (std::string::npos,
             stl.notes[0].find ("12 faces were sampled evenly, 0.0097"));
  const Lengths lengths = linesOf (stl);
  EXPECT_NEAR (lengths.ridges, 9.6, 0.1);
  EXPECT_EQ (lengths.valleys, 0.0);
  EXPECT_EQ (lengths.lines, 1U);
}

TEST_F (IoFaces, OfAllFormatsAreSampledTheSame)
{
  const PolygonMesh mesh = oracle::lProfile();
  const InputCloud off = read ("a.off", asOff (mesh));
  EXPECT_EQ (20U, off.sampled.faces);
  for (const InputCloud& other :
       {read ("a.ply", asPly (mesh)),
        read ("a.vtk", asVtk (mesh)),
        read ("a.obj", linesOf (mesh, false, "v ") + linesOf (mesh, true, "f "))}) {
    ASSERT_EQ (off.points->size(), other.points->size());
    for (std::size_t i = 0; i < off.points->size(); ++i)
      ASSERT_EQ ((*off.points)[i].getVector3fMap(),
                 (*other.points)[i].getVector3fMap());
  }
  const Lengths lengths = linesOf (off);
  EXPECT_NEAR (lengths.ridges, 2 * 14.0 + 5 * 10.0, 0.5);
  EXPECT_NEAR (lengths.valleys, 10.0, 0.2);
}

TEST_F (IoFaces, FacetsOfACylinderAreNoEdges)
{
  for (const int facets : {24, 64}) {
    const Lengths lengths =
        linesOf (read ("a.stl", asStl (oracle::cylinder (facets, 3.0F))));
    EXPECT_EQ (2U, lengths.lines);
    EXPECT_NEAR (lengths.ridges, 4.0 * facets * std::sin (M_PI / facets), 0.1);
    EXPECT_EQ (lengths.valleys, 0.0);
  }
}

TEST_F (IoFaces, WhatIsWrongWithThemIsPutRight)
{
  // Triangles that run either way, some of them twice, and one of no area.
  PolygonMesh box = oracle::cuboid (1.0F, 0.8F, 0.6F);
  for (const std::size_t face : {1U, 3U})
    std::reverse (box.faces.corners.begin() + 4 * face,
                  box.faces.corners.begin() + 4 * face + 4);
  box.add ({0, 1, 5, 4});
  box.add ({0, 1, 1});
  const InputCloud cloud = read ("a.stl", asStl (box));
  EXPECT_EQ (12U, cloud.sampled.faces);
  EXPECT_FALSE (cloud.sampled.sides_agree);
  EXPECT_EQ (0U, cloud.notes.at (0).find ("4 of 12 faces run around the other way"));
  const Eigen::Vector3f middle (0.5F, 0.4F, 0.3F);
  for (const pcl::PointNormal& p : *cloud.points)
    ASSERT_GT (p.getNormalVector3fMap().dot (p.getVector3fMap() - middle), 0.0F);
}

TEST_F (IoFaces, TakeTheSideOfTheNormalsOfTheFile)
{
  // All run clockwise, but the normals look outward.
  PolygonMesh box = oracle::cuboid (1.0F, 1.0F, 1.0F);
  std::reverse (box.faces.corners.begin(), box.faces.corners.end());
  std::string text = "NOFF\n8 6 0\n";
  for (const Eigen::Vector3f& p : box.points) {
    std::ostringstream line;
    line << p.transpose() << ' ' << (p - Eigen::Vector3f::Constant (0.5F)).transpose();
    text += line.str() + '\n';
  }
  const InputCloud cloud = read ("a.off", text + linesOf (box, true, ""));
  EXPECT_EQ (12U, cloud.sampled.faces);
  for (const pcl::PointNormal& p : *cloud.points)
    ASSERT_GT (p.getNormalVector3fMap().dot (p.getVector3fMap() -
                                             Eigen::Vector3f::Constant (0.5F)),
               0.0F);
}

TEST_F (IoFaces, AreSampledAsOptionsSay)
{
  const std::string box = asStl (oracle::cuboid (1.0F, 0.8F, 0.6F));
  ReadOptions off;
  off.samples_faces = false;
  const InputCloud vertices = read ("a.stl", box, off);
  EXPECT_EQ (8U, vertices.points->size());
  EXPECT_EQ (0U, vertices.sampled.faces);

  ReadOptions wide;
  wide.sample_spacing = 0.05;
  const InputCloud samples = read ("a.stl", box, wide);
  EXPECT_EQ (0.05, samples.sampled.spacing);
  EXPECT_NEAR (static_cast<double> (samples.points->size()), 3.76 / 0.0025, 80.0);

  wide.normals.always_estimate = true;
  EXPECT_EQ (NormalSource::ESTIMATED, read ("a.stl", box, wide).normals);
}

TEST_F (IoFaces, SpacingsThatWillNotDoAreRefused)
{
  const std::string box = asStl (oracle::cuboid (1.0F, 0.8F, 0.6F));
  EXPECT_NE (
      std::string::npos,
      refusal ("a.stl", box, 1e-6)
          .find ("a.stl: a spacing of 1e-06 makes 3.76e+12 samples of its faces, "
                 "whose area is 3.76, but -sample has to make at most 2e+07"));
  EXPECT_NE (std::string::npos,
             refusal ("a.stl", box, 3.0).find ("makes 0.418 samples of its faces"));
  EXPECT_NE (std::string::npos,
             refusal ("a.xyz", "0 0 0\n1 0 0\n", 0.1)
                 .find ("it has no faces that -sample could sample"));
  EXPECT_NE (std::string::npos,
             refusal ("a.stl", box, std::numeric_limits<double>::quiet_NaN())
                 .find ("the spacing of samples must be a number above 0"));
}

} // namespace
