// SPDX-License-Identifier: BSD-3-Clause
// Coordinates with more digits than floats have, and points that are far from all
// others: the same cloud near the origin, and without these points, is the oracle.
#include <pcl_crest/crest_line_estimation.h>
#include <pcl_crest/io/read_cloud.h>
#include <pcl_crest/io/write_labels.h>
#include <pcl_crest/io/write_lines.h>

#include <pcl/io/pcd_io.h>
#include <pcl/PCLPointCloud2.h>

#include <gtest/gtest.h>

#include <vtkCellArray.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataReader.h>
#include <vtkPolyDataWriter.h>

#include "support/temporary_directory.h"

#include <cmath>
#include <cstring>
#include <functional>
#include <iomanip>
#include <limits>
#include <random>
#include <sstream>

using namespace pcl::crest;

namespace {

using Positions = std::vector<Eigen::Vector3d>;
using Cloud = pcl::PointCloud<pcl::PointNormal>;

constexpr double NOT_A_NUMBER = std::numeric_limits<double>::quiet_NaN();
const Eigen::Vector3d MAP (32351990.0, 5717990.0, 0.0);

/** \brief A roof of N x N points about a place, whose coordinates are multiples of a
 * step.
 */
constexpr int N = 41;
Positions
roofAt (const Eigen::Vector3d& place, double step = 0.125)
{
  std::mt19937 random (3);
  std::uniform_real_distribution<double> jitter (-0.4, 0.4);
  Positions roof;
  for (int i = 0; i < N; ++i)
    for (int j = 0; j < N; ++j) {
      const double x = 2.0 * i - N + 1 + jitter (random);
      const Eigen::Vector3d local (
          x, 2.0 * j - N + 1 + jitter (random), 30.0 - 0.5 * std::abs (x));
      roof.emplace_back (place + step * (local / step).array().round().matrix());
    }
  return roof;
}

/** \brief The triangles of a roof, counter-clockwise from above. */
std::vector<std::array<int, 3>>
trianglesOfRoof ()
{
  std::vector<std::array<int, 3>> triangles;
  for (int i = 0; i + 1 < N; ++i)
    for (int j = 0; j + 1 < N; ++j) {
      const int corner = i * N + j;
      triangles.push_back ({corner, corner + N, corner + N + 1});
      triangles.push_back ({corner, corner + N + 1, corner + 1});
    }
  return triangles;
}

Positions
moved (Positions positions, const Eigen::Vector3d& by)
{
  for (Eigen::Vector3d& position : positions)
    position += by;
  return positions;
}

std::string
linesOf (const Positions& positions, const std::string& prefix = "")
{
  std::ostringstream text;
  text << std::fixed << std::setprecision (3);
  for (const Eigen::Vector3d& p : positions)
    text << prefix << p.x() << ' ' << p.y() << ' ' << p.z() << '\n';
  return text.str();
}

std::string
facesOf (const std::string& prefix, int first)
{
  std::ostringstream text;
  for (const auto& [a, b, c] : trianglesOfRoof())
    text << prefix << a + first << ' ' << b + first << ' ' << c + first << '\n';
  return text.str();
}

std::string
asStl (const Positions& positions)
{
  std::string text = "solid roof\n";
  for (const auto& triangle : trianglesOfRoof()) {
    text += "facet normal 0 0 1\nouter loop\n";
    for (const int corner : triangle)
      text += linesOf ({positions[corner]}, "vertex ");
    text += "endloop\nendfacet\n";
  }
  return text + "endsolid\n";
}

std::string
asPly (const Positions& positions)
{
  std::string text = "ply\nformat binary_little_endian 1.0\nelement vertex " +
                     std::to_string (positions.size()) +
                     "\nproperty double x\nproperty double y\nproperty double z\n"
                     "end_header\n";
  text.append (reinterpret_cast<const char*> (positions.data()),
               positions.size() * sizeof (Eigen::Vector3d));
  return text;
}

/** \brief One scan, whose matrix moves it to the place. */
std::string
asPtx (const Positions& positions)
{
  const Eigen::Vector3d place (0, 0, 100);
  std::ostringstream text;
  text << std::fixed << std::setprecision (3) << N << '\n' << N << '\n';
  // Where the scanner stood, which is above the roof.
  const Eigen::Vector3d& middle = positions[positions.size() / 2];
  text << linesOf ({middle + place}) << "1 0 0\n0 1 0\n0 0 1\n"
       << "1 0 0 0\n0 1 0 0\n0 0 1 0\n"
       << middle.x() << ' ' << middle.y() << " 0 1\n";
  for (const Eigen::Vector3d& p : positions)
    text << p.x() - middle.x() << ' ' << p.y() - middle.y() << ' ' << p.z() << " 0.5\n";
  return text.str();
}

pcl::PCLPointCloud2
asCloudOfDoubles (const Positions& positions)
{
  pcl::PCLPointCloud2 cloud;
  cloud.width = static_cast<std::uint32_t> (positions.size());
  cloud.height = 1;
  cloud.point_step = sizeof (Eigen::Vector3d);
  cloud.row_step = cloud.point_step * cloud.width;
  for (const char* const name : {"x", "y", "z"}) {
    pcl::PCLPointField field;
    field.name = name;
    field.offset = static_cast<std::uint32_t> (cloud.fields.size() * sizeof (double));
    field.datatype = pcl::PCLPointField::FLOAT64;
    field.count = 1;
    cloud.fields.push_back (field);
  }
  const auto* const bytes = reinterpret_cast<const std::uint8_t*> (positions.data());
  cloud.data.assign (bytes, bytes + cloud.row_step);
  return cloud;
}

void
writeVtk (const std::string& file, const Positions& positions, bool binary)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const Eigen::Vector3d& p : positions)
    points->InsertNextPoint (p.data());
  vtkNew<vtkCellArray> cells;
  for (const auto& t : trianglesOfRoof()) {
    const vtkIdType corners[3] = {t[0], t[1], t[2]};
    cells->InsertNextCell (3, corners);
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints (points);
  data->SetPolys (cells);
  vtkNew<vtkPolyDataWriter> writer;
  writer->SetFileName (file.c_str());
  writer->SetInputData (data);
  binary ? writer->SetFileTypeToBinary() : writer->SetFileTypeToASCII();
  ASSERT_EQ (1, writer->Write());
}

/** \brief What a cloud is read with, with a note that holds some words. */
bool
says (const InputCloud& cloud, const std::string& words)
{
  return std::any_of (
      cloud.notes.begin(), cloud.notes.end(), [&words] (const std::string& note) {
        return note.find (words) != std::string::npos;
      });
}

struct Lines {
  pcl::CrestLineEstimation<pcl::PointNormal> estimation;
  pcl::PointCloud<pcl::Label> labels;

  explicit Lines (const InputCloud& cloud)
  {
    estimation.setInputCloud (cloud.points);
    estimation.compute (labels);
  }
};

class Placed : public testing::Test {
protected:
  const oracle::TemporaryDirectory directory_;

  static InputCloud
  read (const std::string& file, const ReadOptions& options = {})
  {
    InputCloud cloud;
    std::string error;
    EXPECT_TRUE (readCloud (file, 24, 1, cloud, error, options)) << error;
    if (!cloud.points)
      cloud.points.reset (new Cloud);
    return cloud;
  }

  InputCloud
  readText (const Positions& positions) const
  {
    return read (directory_.file ("a.xyz", linesOf (positions)));
  }

  /** \brief The positions of a PCD file as PCL reads them. */
  static Positions
  positionsOf (const std::string& file)
  {
    pcl::PCLPointCloud2 cloud;
    EXPECT_EQ (0, pcl::io::loadPCDFile (file, cloud));
    Positions positions (std::size_t{cloud.width} * cloud.height);
    for (int axis = 0; axis < 3; ++axis) {
      const pcl::PCLPointField& field = cloud.fields.at (axis);
      EXPECT_EQ (std::string (1, "xyz"[axis]), field.name);
      EXPECT_EQ (pcl::PCLPointField::FLOAT64, field.datatype);
      for (std::size_t i = 0; i < positions.size(); ++i)
        std::memcpy (&positions[i][axis],
                     &cloud.data[i * cloud.point_step + field.offset],
                     sizeof (double));
    }
    return positions;
  }
};

/** \brief Whether these are equal, or both not a number. */
bool
areSame (const Eigen::Vector3f& a, const Eigen::Vector3f& b)
{
  for (int axis = 0; axis < 3; ++axis)
    if (a[axis] != b[axis] && !(std::isnan (a[axis]) && std::isnan (b[axis])))
      return false;
  return true;
}

void
expectSame (const Cloud& expected, const Cloud& found, const std::string& what)
{
  ASSERT_EQ (expected.size(), found.size()) << what;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    ASSERT_TRUE (areSame (expected[i].getVector3fMap(), found[i].getVector3fMap()))
        << what << ", point " << i << ": " << expected[i] << found[i];
    ASSERT_TRUE (
        areSame (expected[i].getNormalVector3fMap(), found[i].getNormalVector3fMap()))
        << what << ", normal " << i << ": " << expected[i] << found[i];
  }
}

void
expectSame (const pcl::PointCloud<pcl::Label>& expected,
            const pcl::PointCloud<pcl::Label>& found)
{
  ASSERT_EQ (expected.size(), found.size());
  for (std::size_t i = 0; i < expected.size(); ++i)
    ASSERT_EQ (expected[i].label, found[i].label) << "point " << i;
}

TEST_F (Placed, EveryFormatIsReadAsNearTheOrigin)
{
  using Write = std::function<void (const std::string& file, const Positions&)>;
  const auto text = [this] (const std::string& name, const auto& toText) {
    return std::pair<std::string, Write> (
        name, [this, toText] (const std::string& file, const Positions& positions) {
          directory_.file (file, toText (positions));
        });
  };
  const auto pcd = [this] (const std::string& name, auto write) {
    return std::pair<std::string, Write> (
        name, [this, write] (const std::string& file, const Positions& positions) {
          pcl::PCDWriter writer;
          write (writer, directory_.file (file), asCloudOfDoubles (positions));
        });
  };
  const Eigen::Vector4f origin = Eigen::Vector4f::Zero();
  const Eigen::Quaternionf ahead = Eigen::Quaternionf::Identity();
  using Pcl = pcl::PCLPointCloud2;
  const std::vector<std::pair<std::string, Write>> formats{
      text ("xyz", [] (const Positions& p) { return linesOf (p); }),
      text ("obj",
            [] (const Positions& p) { return linesOf (p, "v ") + facesOf ("f ", 1); }),
      text ("off",
            [] (const Positions& p) {
              return "OFF\n" + std::to_string (p.size()) + " " +
                     std::to_string (trianglesOfRoof().size()) + " 0\n" + linesOf (p) +
                     facesOf ("3 ", 0);
            }),
      text ("stl", asStl),
      text ("ply", asPly),
      text ("ptx", asPtx),
      pcd ("a.pcd",
           [&] (auto& writer, const std::string& file, const Pcl& cloud) {
             writer.writeASCII (file, cloud, origin, ahead, 12);
           }),
      pcd ("b.pcd",
           [&] (auto& writer, const std::string& file, const Pcl& cloud) {
             writer.writeBinary (file, cloud, origin, ahead);
           }),
      pcd ("c.pcd",
           [&] (auto& writer, const std::string& file, const Pcl& cloud) {
             writer.writeBinaryCompressed (file, cloud, origin, ahead);
           }),
      {"a.vtk",
       [this] (const std::string& file, const Positions& positions) {
         writeVtk (directory_.file (file), positions, false);
       }},
      {"b.vtk", [this] (const std::string& file, const Positions& positions) {
         writeVtk (directory_.file (file), positions, true);
       }}};
  const Positions roof = roofAt (MAP);
  for (const auto& [name, write] : formats) {
    const std::string extension = name.substr (name.find ('.') + 1);
    write ("far." + extension, roof);
    const InputCloud far = read (directory_.file ("far." + extension));
    const Eigen::Vector3d& offset = far.placement.offset;
    EXPECT_LE ((offset - MAP).cwiseAbs().maxCoeff(), 2.0) << name;
    EXPECT_EQ (offset, offset.array().round().matrix()) << name;
    EXPECT_TRUE (says (far, "far from the origin: 32351")) << name;

    write ("near." + extension, moved (roof, -offset));
    const InputCloud near = read (directory_.file ("near." + extension));
    EXPECT_TRUE (near.placement.offset.isZero (0.0)) << name;
    EXPECT_FALSE (says (near, "far from the origin")) << name;
    EXPECT_EQ (near.normals, far.normals) << name;
    expectSame (*near.points, *far.points, name);
  }
}

TEST_F (Placed, LinesAndLabelsAreThoseNearTheOriginWhereTheyWere)
{
  const Positions roof = roofAt (MAP);
  const InputCloud far = readText (roof);
  const Eigen::Vector3d& offset = far.placement.offset;
  const InputCloud near = readText (moved (roof, -offset));
  const Lines expected (near);
  const Lines found (far);
  expectSame (expected.labels, found.labels);
  ASSERT_FALSE (expected.estimation.getLines().empty());
  ASSERT_EQ (expected.estimation.getLines().size(), found.estimation.getLines().size());

  // Near the origin the same points are written, in the same order.
  const auto written =
      [this] (const std::string& name, const InputCloud& cloud, const Lines& lines) {
        std::string error;
        EXPECT_TRUE (writeLines (directory_.file (name),
                                 *lines.estimation.getLineCloud(),
                                 lines.estimation.getLines(),
                                 error,
                                 cloud.placement))
            << error;
        return directory_.file (name);
      };
  // Those behind some text, each with as many other numbers behind it.
  const auto numbersOf =
      [] (const std::string& file, const std::string& after, int others = 0) {
        std::string text = oracle::contentOf (file);
        std::istringstream numbers (text.substr (text.find (after) + after.size()));
        Positions positions;
        std::string word;
        for (Eigen::Vector3d p; numbers >> word;) {
          if (word != "v")
            numbers.seekg (-static_cast<int> (word.size()), std::ios::cur);
          if (!(numbers >> p.x() >> p.y() >> p.z()))
            break;
          positions.push_back (p);
          for (int i = 0; i < others; ++i)
            numbers >> word;
        }
        return positions;
      };
  const auto expectMoved = [&] (const Positions& here, const Positions& there) {
    ASSERT_FALSE (here.empty());
    ASSERT_EQ (here.size(), there.size());
    // The digits near the origin are as many as tell floats.
    for (std::size_t i = 0; i < here.size(); ++i)
      ASSERT_LE ((here[i] + offset - there[i]).cwiseAbs().maxCoeff(), 1e-5);
  };
  expectMoved (numbersOf (written ("near.obj", near, expected), "near.mtl\n"),
               numbersOf (written ("far.obj", far, found), "far.mtl\n"));
  const std::string ply = written ("far.ply", far, found);
  EXPECT_NE (std::string::npos, oracle::contentOf (ply).find ("property double x"));
  const std::string near_ply = written ("near.ply", near, expected);
  EXPECT_NE (std::string::npos, oracle::contentOf (near_ply).find ("property float x"));
  Positions of_near_ply = numbersOf (near_ply, "end_header\n", 3);
  Positions of_ply = numbersOf (ply, "end_header\n", 3);
  const std::size_t points =
      numbersOf (directory_.file ("near.obj"), "near.mtl\n").size();
  of_near_ply.resize (points);
  of_ply.resize (points);
  expectMoved (of_near_ply, of_ply);
  const auto pointsOf = [] (const std::string& file, int type) {
    vtkNew<vtkPolyDataReader> reader;
    reader->SetFileName (file.c_str());
    reader->Update();
    vtkPoints* const read = reader->GetOutput()->GetPoints();
    EXPECT_EQ (type, read->GetDataType());
    Positions positions;
    for (vtkIdType i = 0; i < read->GetNumberOfPoints(); ++i)
      positions.emplace_back (read->GetPoint (i));
    return positions;
  };
  expectMoved (pointsOf (written ("near.vtk", near, expected), VTK_FLOAT),
               pointsOf (written ("far.vtk", far, found), VTK_DOUBLE));
}

TEST_F (Placed, EveryPointIsWrittenToThePrecisionOfTheFile)
{
  Positions roof = roofAt (MAP + Eigen::Vector3d (0.0, 0.0, 2.0), 1e-3);
  // Points that are apart are written as they were, to the last bit.
  roof[7] = MAP + Eigen::Vector3d (1.0 / 3.0, 0.1, -9999.0);
  roof[400] = Eigen::Vector3d::Zero();
  roof[401] = Eigen::Vector3d (1e7 + 1.0 / 3.0, -1e9, 0.7);
  roof[1000].setConstant (NOT_A_NUMBER);
  const InputCloud cloud = read (directory_.file ("a.ply", asPly (roof)));
  ASSERT_EQ (3U, cloud.placement.apart.size());
  EXPECT_EQ (1U, cloud.placement.no_data);
  EXPECT_TRUE (says (cloud,
                     "3 of 1681 points are set apart, and have the label 5: 1 with a "
                     "number that stands for no data, 2 more than 1000 times the width "
                     "of the cloud away"));
  EXPECT_TRUE (says (cloud, "1 of 1681 points are not finite"));
  EXPECT_FALSE (cloud.points->is_dense);

  const Lines lines (cloud);
  std::string error;
  for (const bool labels : {true, false}) {
    const std::string file = directory_.file ("o.pcd");
    ASSERT_TRUE (labels ? writeLabels (file,
                                       cloud,
                                       lines.labels,
                                       lines.estimation.getPrincipalCurvatures(),
                                       lines.estimation.getLines(),
                                       error)
                        : writeCurvatures (file,
                                           *cloud.points,
                                           lines.estimation.getPrincipalCurvatures(),
                                           error,
                                           cloud.placement))
        << error;
    const Positions written = positionsOf (file);
    ASSERT_EQ (roof.size(), written.size());
    for (std::size_t i = 0; i < roof.size(); ++i)
      if (i == 7 || i == 400 || i == 401) {
        EXPECT_EQ (roof[i], written[i]);
        EXPECT_EQ (LABEL_INVALID, lines.labels[i].label);
      }
      else if (i == 1000)
        EXPECT_FALSE (written[i].array().isFinite().any());
      else
        ASSERT_LE ((roof[i] - written[i]).cwiseAbs().maxCoeff(), 1e-5) << i;
    // And read again.
    const InputCloud again = read (file);
    EXPECT_EQ (cloud.placement.offset, again.placement.offset);
    EXPECT_EQ (3U, again.placement.apart.size());
  }
}

TEST_F (Placed, FilesNearTheOriginHaveFloats)
{
  Positions roof = roofAt (Eigen::Vector3d (100.0, -20.0, 0.0));
  roof[3] = Eigen::Vector3d (1.5, 2.5, -3.4028235e38);
  roof[5] = Eigen::Vector3d (-0.0, 1e7, 0.0);
  const InputCloud cloud = readText (roof);
  ASSERT_EQ (2U, cloud.placement.apart.size());
  EXPECT_TRUE (cloud.placement.offset.isZero (0.0));
  const Lines lines (cloud);
  std::string error;
  const std::string file = directory_.file ("o.pcd");
  ASSERT_TRUE (writeLabels (file,
                            cloud,
                            lines.labels,
                            lines.estimation.getPrincipalCurvatures(),
                            lines.estimation.getLines(),
                            error))
      << error;
  pcl::PointCloud<pcl::PointXYZL> written;
  ASSERT_EQ (0, pcl::io::loadPCDFile (file, written));
  for (std::size_t i = 0; i < roof.size(); ++i)
    ASSERT_EQ (roof[i].cast<float>(), written[i].getVector3fMap()) << i;
  EXPECT_EQ (LABEL_INVALID, written[3].label);
  EXPECT_EQ (LABEL_INVALID, written[5].label);
}

TEST_F (Placed, WhatIsSetApartChangesNothingElse)
{
  const std::vector<Eigen::Vector3d> numbers{
      {1e5, 0, 0},
      {0, 0, 1e7},
      {1e9, -1e12, 1e30},
      {1, 2, -9999},
      {3, 4, -99999},
      {5, 6, -32768},
      {-32767, 7, 8},
      {1e20, 1e20, 1e20},
      {9, 1, -3.4028234663852886e38},
      {9, 1, 3.4e38},
      {0, std::numeric_limits<double>::lowest(), 0},
  };
  for (const Eigen::Vector3d& place : {Eigen::Vector3d (0, 0, 0), MAP}) {
    const Positions roof = roofAt (place);
    const InputCloud expected = read (directory_.file ("a.ply", asPly (roof)));
    const Lines expected_lines (expected);
    Positions more = roof;
    std::vector<std::size_t> apart;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      apart.push_back (150 * i);
      more.insert (more.begin() + 150 * static_cast<std::ptrdiff_t> (i),
                   numbers[i] + place);
      // Of no data there is the number itself.
      for (int axis = 0; axis < 3; ++axis)
        if (std::abs (numbers[i][axis]) > 1e4 || numbers[i][axis] == -9999)
          more[150 * i][axis] = numbers[i][axis];
    }
    const InputCloud found = read (directory_.file ("a.ply", asPly (more)));
    const Lines found_lines (found);
    EXPECT_EQ (expected.placement.offset, found.placement.offset);
    ASSERT_EQ (apart.size(), found.placement.apart.size());
    Cloud others;
    pcl::PointCloud<pcl::Label> labels;
    std::size_t next = 0;
    for (std::size_t i = 0; i < more.size(); ++i)
      if (next < apart.size() && apart[next] == i) {
        EXPECT_EQ (static_cast<pcl::index_t> (i), found.placement.apart[next].index);
        EXPECT_EQ (more[i], found.placement.apart[next].position);
        EXPECT_FALSE ((*found.points)[i].getArray3fMap().isFinite().any());
        EXPECT_EQ (LABEL_INVALID, found_lines.labels[i].label);
        ++next;
      }
      else {
        others.push_back ((*found.points)[i]);
        labels.push_back (found_lines.labels[i]);
      }
    expectSame (*expected.points, others, "all");
    expectSame (expected_lines.labels, labels);
    EXPECT_EQ (expected_lines.estimation.getStatistics().extent,
               found_lines.estimation.getStatistics().extent);
  }
}

TEST_F (Placed, ViewpointsAreInTheCoordinatesOfTheFile)
{
  const Positions roof = roofAt (MAP);
  const pcl::PCLPointCloud2 cloud = asCloudOfDoubles (roof);
  const auto facesUp = [] (const InputCloud& read) {
    std::size_t up = 0;
    for (const pcl::PointNormal& point : *read.points)
      up += point.normal_z > 0.0F ? 1 : 0;
    return up == read.points->size() ? 1 : up == 0 ? -1 : 0;
  };
  const std::string file = directory_.file ("a.pcd");
  std::string text;
  {
    std::ostringstream stream;
    pcl::PCDWriter writer;
    writer.writeBinary (
        file, cloud, Eigen::Vector4f::Zero(), Eigen::Quaternionf::Identity());
    text = oracle::contentOf (file);
  }
  const std::string unset = "VIEWPOINT 0 0 0 ";
  const std::size_t place = text.find (unset);
  ASSERT_NE (std::string::npos, place);
  const std::string below = "VIEWPOINT 32351992.125 5717991.5 -250.25 ";
  for (const auto& [viewpoint, side] :
       {std::pair<std::string, int> (unset, 1), {below, -1}}) {
    const InputCloud read_cloud = read (directory_.file (
        "b.pcd", std::string (text).replace (place, unset.size(), viewpoint)));
    EXPECT_EQ (side, facesUp (read_cloud)) << viewpoint;
    pcl::PointCloud<pcl::Label> labels;
    labels.resize (roof.size());
    pcl::PointCloud<pcl::PrincipalCurvatures> curvatures;
    curvatures.resize (roof.size());
    std::string error;
    ASSERT_TRUE (writeLabels (file, read_cloud, labels, curvatures, {}, error))
        << error;
    EXPECT_NE (std::string::npos, oracle::contentOf (file).find (viewpoint));
  }
  for (const double height : {250.25, -250.25}) {
    ReadOptions options;
    options.normals.viewpoint = MAP + Eigen::Vector3d (2.125, 1.5, height);
    EXPECT_EQ (height > 0.0 ? 1 : -1,
               facesUp (read (directory_.file ("a.xyz", linesOf (roof)), options)));
  }
}

TEST_F (Placed, FloatsThatAreTooCoarseAreMentioned)
{
  const auto asFloats = [] (const Positions& positions) {
    std::string text = "ply\nformat binary_little_endian 1.0\nelement vertex " +
                       std::to_string (positions.size()) +
                       "\nproperty float x\nproperty float y\nproperty float z\n"
                       "end_header\n";
    for (const Eigen::Vector3d& position : positions) {
      const Eigen::Vector3f floats = position.cast<float>();
      text.append (reinterpret_cast<const char*> (floats.data()), sizeof (floats));
    }
    return text;
  };
  const std::string words = "single precision of the file";
  const Positions roof = roofAt (MAP);
  EXPECT_TRUE (says (read (directory_.file ("a.ply", asFloats (roof))), words));
  EXPECT_FALSE (says (read (directory_.file ("a.ply", asPly (roof))), words));
  EXPECT_FALSE (
      says (read (directory_.file ("a.ply", asFloats (moved (roof, -MAP)))), words));
}

TEST (Placement, CallersWithDoublesPlaceThemAlike)
{
  const Positions roof = roofAt (MAP);
  Cloud cloud (N, N);
  for (std::size_t i = 0; i < cloud.size(); ++i)
    cloud[i].normal_x = static_cast<float> (i);
  const Placement placement = placePoints (roof, cloud);
  EXPECT_EQ (N, static_cast<int> (cloud.height));
  EXPECT_FALSE (placement.offset.isZero (0.0));
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    EXPECT_EQ (roof[i], placement.toFile (cloud[i].getVector3fMap()));
    EXPECT_EQ (placement.toCloud (roof[i]), cloud[i].getVector3fMap());
    EXPECT_EQ (static_cast<float> (i), cloud[i].normal_x);
  }
  Cloud other;
  placePoints (roof, other);
  EXPECT_EQ (roof.size(), other.size());
  Cloud none (3, 1);
  EXPECT_TRUE (placePoints ({}, none).offset.isZero (0.0));
  EXPECT_TRUE (none.empty());
  Positions with_stray = roof;
  with_stray[5].z() = 1e7;
  EXPECT_TRUE (other.is_dense);
  EXPECT_EQ (1U, placePoints (with_stray, other).apart.size());
  EXPECT_FALSE (other.is_dense);
}

TEST (Placement, NothingIsDoneWithoutNeed)
{
  Cloud cloud;
  const auto untouched = [&cloud] (const Positions& positions) {
    const Placement placement = placePoints (positions, cloud);
    return placement.offset.isZero (0.0) && placement.apart.empty();
  };
  EXPECT_TRUE (untouched (roofAt (Eigen::Vector3d::Zero())));
  // So near that floats do.
  EXPECT_TRUE (untouched (roofAt (Eigen::Vector3d (300.0, -40.0, 5.0))));
  EXPECT_TRUE (untouched (Positions (50, MAP)));
  EXPECT_TRUE (untouched (Positions (50, Eigen::Vector3d::Constant (NOT_A_NUMBER))));
  // Numbers that stand for no data elsewhere may be coordinates.
  Positions deep = roofAt (Eigen::Vector3d::Zero());
  for (Eigen::Vector3d& position : deep)
    position.z() = -9999.0;
  EXPECT_TRUE (placePoints (deep, cloud).apart.empty());
  Positions wide = roofAt (Eigen::Vector3d::Zero());
  for (Eigen::Vector3d& position : wide)
    position *= 200.0;
  wide[5] = Eigen::Vector3d (-9999.0, -9999.0, 0.0);
  EXPECT_TRUE (untouched (wide));
  // An image of which most is missing.
  Positions image = roofAt (Eigen::Vector3d (0.0, 0.0, 10.0));
  image.resize (20 * image.size(), Eigen::Vector3d::Zero());
  EXPECT_TRUE (untouched (image));
  // A fine scan of one thing within a coarse one of the hall around it.
  Positions hall = roofAt (Eigen::Vector3d::Zero());
  std::mt19937 random (5);
  std::uniform_real_distribution<double> place (-5000.0, 5000.0);
  for (int i = 0; i < 160; ++i)
    hall.emplace_back (place (random), place (random), place (random));
  EXPECT_TRUE (untouched (hall));
}

TEST (Placement, MostPointsMayBeMissing)
{
  for (const Eigen::Vector3d& missing :
       {Eigen::Vector3d (0, 0, 0), Eigen::Vector3d (MAP.x(), MAP.y(), -9999.0)}) {
    Positions roof = roofAt (MAP);
    const std::size_t size = roof.size();
    Cloud cloud;
    const Placement expected = placePoints (roof, cloud);
    roof.resize (3 * size, missing);
    const Placement found = placePoints (roof, cloud);
    EXPECT_EQ (expected.offset, found.offset);
    EXPECT_EQ (2 * size, found.apart.size());
  }
}

TEST (Placement, DoesNotDependOnTheOrderOfThePoints)
{
  Positions roof = roofAt (MAP);
  for (int i = 0; i < 60; ++i)
    roof[i] += Eigen::Vector3d (0.0, i, 1e5 + i);
  roof[100].setConstant (NOT_A_NUMBER);
  Cloud cloud;
  const Placement expected = placePoints (roof, cloud);
  EXPECT_EQ (60U, expected.apart.size());
  std::shuffle (roof.begin(), roof.end(), std::mt19937 (1));
  const Placement found = placePoints (roof, cloud);
  EXPECT_EQ (expected.offset, found.offset);
  EXPECT_EQ (expected.apart.size(), found.apart.size());
}

} // namespace
