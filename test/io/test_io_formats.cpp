// SPDX-License-Identifier: BSD-3-Clause
// Every format, written by PCL, by VTK or by hand, is read with all its points in their
// order, and with normals from the right source.
#include <pcl_crest/io/read_cloud.h>

#include <pcl/io/pcd_io.h>
#include <pcl/io/ply_io.h>
#include <pcl/io/vtk_io.h>
#include <pcl/conversions.h>
#include <pcl/PolygonMesh.h>

#include <gtest/gtest.h>

#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataWriter.h>
#include <vtkSTLWriter.h>
#include <vtkUnstructuredGrid.h>
#include <vtkUnstructuredGridWriter.h>

#include "support/sphere_mesh.h"
#include "support/temporary_directory.h"

#include <clocale>
#include <cmath>
#include <functional>
#include <limits>
#include <locale>
#include <random>
#include <sstream>
#include <tuple>

using namespace pcl::crest;

namespace {

class IoFormats : public testing::Test {
protected:
  const oracle::TemporaryDirectory directory_;
  const oracle::TriangleMesh mesh_ = oracle::cubeSphere (4);

  static InputCloud
  read (const std::string& file)
  {
    InputCloud cloud;
    std::string error;
    EXPECT_TRUE (readCloud (file, 12, 1, cloud, error)) << error;
    if (!cloud.points)
      cloud.points.reset (new pcl::PointCloud<pcl::PointNormal>);
    return cloud;
  }

  /** \brief The points are exactly those of the mesh, in its order. */
  void
  expectPoints (const InputCloud& cloud, float precision = 0.0F) const
  {
    ASSERT_EQ (mesh_.points.size(), cloud.points->size());
    for (std::size_t i = 0; i < mesh_.points.size(); ++i)
      ASSERT_LE (((*cloud.points)[i].getVector3fMap() - mesh_.points[i]).norm(),
                 precision)
          << "point " << i;
    EXPECT_TRUE (cloud.points->is_dense);
  }

  /** \brief The normals look outward, like those of a sphere. */
  static void
  expectOutward (const InputCloud& cloud)
  {
    for (const pcl::PointNormal& point : *cloud.points)
      ASSERT_GT (point.getNormalVector3fMap().dot (point.getVector3fMap()), 0.9F);
  }

  /** \brief A normal that is not that of the sphere, so that its source is known. */
  static Eigen::Vector3f
  markedNormal (std::size_t i)
  {
    return Eigen::Vector3f (1.0F, static_cast<float> (i), 2.0F).normalized();
  }

  static void
  expectMarkedNormals (const InputCloud& cloud)
  {
    EXPECT_EQ (NormalSource::FILE, cloud.normals);
    for (std::size_t i = 0; i < cloud.points->size(); ++i)
      ASSERT_LE (((*cloud.points)[i].getNormalVector3fMap() - markedNormal (i)).norm(),
                 1e-6F);
  }

  std::string
  lines (const std::string& prefix, bool normals = false) const
  {
    std::ostringstream text;
    text.precision (9);
    for (std::size_t i = 0; i < mesh_.points.size(); ++i) {
      text << prefix << mesh_.points[i].transpose();
      if (normals)
        text << ' ' << markedNormal (i).transpose();
      text << '\n';
    }
    return text.str();
  }

  pcl::PointCloud<pcl::PointXYZ>
  xyz () const
  {
    pcl::PointCloud<pcl::PointXYZ> cloud;
    for (const Eigen::Vector3f& p : mesh_.points)
      cloud.push_back ({p.x(), p.y(), p.z()});
    return cloud;
  }

  pcl::PolygonMesh
  polygonMesh () const
  {
    pcl::PolygonMesh polygons;
    pcl::toPCLPointCloud2 (xyz(), polygons.cloud);
    for (const auto& t : mesh_.triangles) {
      polygons.polygons.emplace_back();
      polygons.polygons.back().vertices.assign (t.begin(), t.end());
    }
    return polygons;
  }

  vtkNew<vtkPolyData>
  polyData () const
  {
    vtkNew<vtkPolyData> data;
    vtkNew<vtkPoints> points;
    for (const Eigen::Vector3f& p : mesh_.points)
      points->InsertNextPoint (p.x(), p.y(), p.z());
    vtkNew<vtkCellArray> cells;
    for (const auto& t : mesh_.triangles) {
      const vtkIdType corners[3] = {t[0], t[1], t[2]};
      cells->InsertNextCell (3, corners);
    }
    data->SetPoints (points);
    data->SetPolys (cells);
    return data;
  }

  /** \brief Writes the mesh as VTK does. */
  void
  writeStl (bool binary, const std::string& file) const
  {
    vtkNew<vtkSTLWriter> writer;
    writer->SetFileName (file.c_str());
    writer->SetInputData (polyData());
    binary ? writer->SetFileTypeToBinary() : writer->SetFileTypeToASCII();
    ASSERT_EQ (1, writer->Write());
  }
};

TEST_F (IoFormats, PcdOfEveryCoding)
{
  pcl::PointCloud<pcl::PointNormal> cloud;
  pcl::copyPointCloud (xyz(), cloud);
  for (std::size_t i = 0; i < cloud.size(); ++i)
    cloud[i].getNormalVector3fMap() = markedNormal (i);
  const std::string file = directory_.file ("a.pcd");
  pcl::PCDWriter writer;
  writer.writeASCII (file, cloud, 9);
  expectPoints (read (file));
  expectMarkedNormals (read (file));
  writer.writeBinary (file, cloud);
  expectPoints (read (file));
  expectMarkedNormals (read (file));
  writer.writeBinaryCompressed (file, cloud);
  expectPoints (read (file));
  expectMarkedNormals (read (file));
}

TEST_F (IoFormats, PcdThatPclCompresses)
{
  // From what does not compress to what repeats over and over.
  std::mt19937 random (9);
  for (const unsigned values : {1U, 2U, 30U, 1000U, 1000000U}) {
    pcl::PointCloud<pcl::PointNormal> cloud (3000, 1);
    for (pcl::PointNormal& point : cloud) {
      for (int axis = 0; axis < 3; ++axis)
        point.data[axis] = static_cast<float> (random() % values);
      point.getNormalVector3fMap() = Eigen::Vector3f::UnitZ();
    }
    const std::string file = directory_.file ("a.pcd");
    pcl::PCDWriter().writeBinaryCompressed (file, cloud);
    const InputCloud found = read (file);
    ASSERT_EQ (cloud.size(), found.points->size());
    for (std::size_t i = 0; i < cloud.size(); ++i)
      ASSERT_EQ (cloud[i].getVector3fMap(), (*found.points)[i].getVector3fMap()) << i;
  }
}

TEST_F (IoFormats, PcdOfAnOrientationThatIsNone)
{
  const std::string lines = "VERSION .7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\n"
                            "WIDTH 4\nHEIGHT 1\nVIEWPOINT 1 2 3 ";
  const std::string rows = "\nDATA ascii\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n";
  const InputCloud turned =
      read (directory_.file ("a.pcd", lines + "0.6 0 0 0.8" + rows));
  EXPECT_EQ (0.8F, turned.points->sensor_orientation_.z());
  for (const char* const zero : {"0 0 0 0", "2 0 0 0", "1e38 1e38 1e38 1e38"}) {
    const InputCloud cloud = read (
        directory_.file ("a.pcd", std::string (lines).append (zero).append (rows)));
    EXPECT_EQ (Eigen::Vector4f (1, 2, 3, 0), cloud.points->sensor_origin_);
    EXPECT_EQ (1.0F, cloud.points->sensor_orientation_.w());
    EXPECT_EQ ("The orientation of the viewpoint is left out: it is no quaternion of "
               "length 1.",
               cloud.notes.at (0));
  }
}

TEST_F (IoFormats, PcdWithoutNormals)
{
  const std::string file = directory_.file ("a.PCD");
  pcl::PCDWriter().writeBinary (file, xyz());
  const InputCloud cloud = read (file);
  expectPoints (cloud);
  EXPECT_EQ (NormalSource::ESTIMATED, cloud.normals);
  expectOutward (cloud);
}

TEST_F (IoFormats, PcdStaysOrganized)
{
  pcl::PointCloud<pcl::PointXYZ> cloud (7, 5);
  for (std::uint32_t row = 0; row < cloud.height; ++row)
    for (std::uint32_t column = 0; column < cloud.width; ++column)
      cloud.at (column,
                row) = {static_cast<float> (column), static_cast<float> (row), 1.0F};
  cloud.at (3, 2).z = std::numeric_limits<float>::quiet_NaN();
  cloud.is_dense = true;
  cloud.sensor_origin_ = Eigen::Vector4f (3.0F, 2.0F, -9.0F, 0.0F);
  const std::string file = directory_.file ("a.pcd");
  pcl::PCDWriter().writeBinary (file, cloud);
  const InputCloud read_cloud = read (file);
  EXPECT_EQ (7U, read_cloud.points->width);
  EXPECT_EQ (5U, read_cloud.points->height);
  EXPECT_FALSE (read_cloud.points->is_dense);
  EXPECT_EQ (cloud.sensor_origin_, read_cloud.points->sensor_origin_);
  EXPECT_EQ ("1 of 35 points are not finite.", read_cloud.notes.at (0));
  // A plane is open, and its viewpoint is below.
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const bool is_hole = i == 3 + 2 * 7;
    EXPECT_EQ (!is_hole, (*read_cloud.points)[i].normal_z < -0.99F) << i;
  }
}

TEST_F (IoFormats, PcdOfDoubles)
{
  std::string text = "VERSION .7\nFIELDS z y x\nSIZE 8 8 8\nTYPE F F F\nWIDTH 4\n"
                     "HEIGHT 1\nPOINTS 4\nDATA ascii\n1 2 3\n4 5 6\n7 8 9\n1 1 1\n";
  const InputCloud cloud = read (directory_.file ("a.pcd", text));
  ASSERT_EQ (4U, cloud.points->size());
  EXPECT_EQ (Eigen::Vector3f (6, 5, 4), (*cloud.points)[1].getVector3fMap());
}

TEST_F (IoFormats, PcdOfLidarDrivers)
{
  // Upper case, and bytes between the fields, of which some are none at all.
  const std::string header = "FIELDS _ X Y Z _ ring _ RGB\nSIZE 1 4 4 4 2 1 1 4\n"
                             "TYPE U F F F U U U U\nCOUNT 3 1 1 1 0 1 2 1\nWIDTH 2\n"
                             "HEIGHT 1\nPOINTS 2\nDATA ";
  std::string binary = header + "binary\n";
  for (const std::array<float, 3>& p : {std::array<float, 3>{1, 2, 3}, {4, 5, 6}}) {
    binary += "abc" + std::string (reinterpret_cast<const char*> (p.data()), 12) +
              std::string ("r__\x03\x02\x01\0", 7);
  }
  for (const std::string& text :
       {binary, header + "ascii\n9 9 9 1 2 3 7 8 8 66051\n9 9 9 4 5 6 7 8 8 66051\n"}) {
    const InputCloud cloud = read (directory_.file ("a.pcd", text));
    ASSERT_EQ (2U, cloud.points->size());
    EXPECT_EQ (Eigen::Vector3f (1, 2, 3), (*cloud.points)[0].getVector3fMap());
    EXPECT_EQ (Eigen::Vector3f (4, 5, 6), (*cloud.points)[1].getVector3fMap());
    EXPECT_EQ ((std::array<unsigned char, 3>{1, 2, 3}), cloud.colors.at (1));
  }
}

TEST_F (IoFormats, PlyFromPcl)
{
  const std::string file = directory_.file ("a.ply");
  for (const bool binary : {false, true}) {
    if (binary)
      pcl::io::savePLYFileBinary (file, polygonMesh());
    else
      pcl::io::savePLYFile (file, polygonMesh(), 9);
    const InputCloud cloud = read (file);
    expectPoints (cloud);
    EXPECT_EQ (NormalSource::FACES, cloud.normals);
    expectOutward (cloud);
  }
}

TEST_F (IoFormats, PlyOfOtherByteOrderAndTypes)
{
  std::string text = "ply\r\nformat binary_big_endian 1.0\r\ncomment x\r\nelement odd "
                     "1\r\nproperty list uchar short s\r\nelement vertex 2\r\nproperty "
                     "uchar red\r\nproperty double x\r\nproperty short y\r\nproperty "
                     "float z\r\nend_header\r\n";
  const auto bytes = [&text] (std::initializer_list<int> values) {
    for (const int value : values)
      text += static_cast<char> (value);
  };
  bytes ({2, 0, 1, 0, 2});
  bytes ({9, 0x3F, 0xF8, 0, 0, 0, 0, 0, 0, 0xFF, 0xFE, 0x40, 0x40, 0, 0});
  bytes ({9, 0xC0, 0, 0, 0, 0, 0, 0, 0, 0, 7, 0, 0, 0, 0});
  const InputCloud cloud = read (directory_.file ("a.ply", text));
  ASSERT_EQ (2U, cloud.points->size());
  EXPECT_EQ (Eigen::Vector3f (1.5F, -2, 3), (*cloud.points)[0].getVector3fMap());
  EXPECT_EQ (Eigen::Vector3f (-2, 7, 0), (*cloud.points)[1].getVector3fMap());
}

TEST_F (IoFormats, PlyOfOtherNames)
{
  for (const std::string names : {"nx ny nz",
                                  "normal_x normal_y normal_z",
                                  "normalx normaly normalz",
                                  "NX NY NZ",
                                  "scalar_Nx scalar_Ny scalar_Nz"}) {
    std::string header = "ply\nformat ascii 1.0\nelement vertex " +
                         std::to_string (mesh_.points.size()) +
                         "\nproperty float X\nproperty float Y\nproperty float Z\n";
    std::istringstream words (names);
    for (std::string word; words >> word;)
      header += "property float " + word + "\n";
    const InputCloud cloud =
        read (directory_.file ("a.ply", header + "end_header\n" + lines ("", true)));
    expectPoints (cloud);
    expectMarkedNormals (cloud);
  }
}

TEST_F (IoFormats, ColorsOfPcdAndPly)
{
  const std::vector<std::array<unsigned char, 3>> colors{{255, 128, 3}, {0, 7, 250}};
  pcl::PointCloud<pcl::PointXYZRGB> cloud;
  for (const auto& color : colors)
    cloud.push_back ({0.0F, 1.0F, 2.0F, color[0], color[1], color[2]});
  const std::string pcd = directory_.file ("colors.pcd");
  pcl::io::savePCDFileASCII (pcd, cloud);
  EXPECT_EQ (read (pcd).colors, colors);
  pcl::io::savePCDFileBinary (pcd, cloud);
  EXPECT_EQ (read (pcd).colors, colors);
  const std::string ply = directory_.file (
      "colors.ply",
      "ply\nformat ascii 1.0\nelement vertex 2\nproperty uchar blue\nproperty float x\n"
      "property float y\nproperty float z\nproperty uchar red\nproperty uchar green\n"
      "end_header\n3 0 1 2 255 128\n250 0 1 2 0 7\n");
  EXPECT_EQ (read (ply).colors, colors);
  EXPECT_TRUE (read (directory_.file ("none.xyz", "0 1 2\n1 2 3\n")).colors.empty());
}

TEST_F (IoFormats, Off)
{
  std::ostringstream faces;
  for (const auto& t : mesh_.triangles)
    faces << "3 " << t[0] << ' ' << t[1] << ' ' << t[2] << " 255 0 0\n";
  const std::string counts = std::to_string (mesh_.points.size()) + " " +
                             std::to_string (mesh_.triangles.size()) + " 0\n";
  const InputCloud cloud = read (directory_.file (
      "a.off", "OFF # a comment\n\n" + counts + "# more\n" + lines ("") + faces.str()));
  expectPoints (cloud);
  EXPECT_EQ (NormalSource::FACES, cloud.normals);
  expectOutward (cloud);
  const InputCloud with_normals = read (
      directory_.file ("n.off", "NOFF " + counts + lines ("", true) + faces.str()));
  expectPoints (with_normals);
  expectMarkedNormals (with_normals);
}

TEST_F (IoFormats, ObjInAllItsForms)
{
  const auto n = static_cast<int> (mesh_.points.size());
  std::ostringstream normals;
  normals.precision (9);
  for (int i = 0; i < n; ++i)
    normals << "vn " << markedNormal (i).transpose() << "\n";
  // How the corner i of a face is written, and whether normals are those of points.
  const std::vector<std::tuple<std::string, std::function<std::string (int)>, bool>>
      forms{
          {"", [] (int i) { return std::to_string (i + 1); }, false},
          {"", [n] (int i) { return std::to_string (i - n); }, false},
          {"vt 0 0\n", [] (int i) { return std::to_string (i + 1) + "/1"; }, false},
          {normals.str(),
           [] (int i) {
             return std::to_string (i + 1) + "//" + std::to_string (i + 1);
           },
           true},
          {normals.str() + "vt 0 0\n",
           [n] (int i) {
             return std::to_string (i + 1) + "/1/" + std::to_string (i - n);
           },
           true},
          {normals.str(),
           [n] (int i) {
             return std::to_string (i + 1) + "//" + std::to_string (n - i);
           },
           false},
          {"", [] (int i) { return std::to_string (i + 1) + "/"; }, false},
          {"", [] (int i) { return std::to_string (i + 1) + "//"; }, false},
          {"vt 0 0\n", [] (int i) { return std::to_string (i + 1) + "/1/"; }, false},
          {"vn 0 0 1\n", [] (int i) { return std::to_string (i + 1) + "//1"; }, false}};
  for (const auto& [extra, corner, has_normals] : forms) {
    std::ostringstream faces;
    for (const auto& t : mesh_.triangles)
      faces << "f " << corner (t[0]) << " \\\r\n"
            << corner (t[1]) << ' ' << corner (t[2]) << "\r\n";
    const InputCloud cloud =
        read (directory_.file ("a.obj",
                               "# x\r\nmtllib m.mtl\r\no name\r\n" + lines ("v ") +
                                   extra + "g group\nusemtl m\ns off\n" + faces.str()));
    expectPoints (cloud);
    if (has_normals)
      expectMarkedNormals (cloud);
    else {
      EXPECT_EQ (NormalSource::FACES, cloud.normals) << extra.substr (0, 20);
      expectOutward (cloud);
    }
  }
}

TEST_F (IoFormats, Xyz)
{
  const InputCloud cloud = read (directory_.file ("a.xyz", "# x y z\n" + lines ("")));
  expectPoints (cloud);
  EXPECT_EQ (NormalSource::ESTIMATED, cloud.normals);
  expectOutward (cloud);
  expectMarkedNormals (read (directory_.file ("n.txt", lines ("  ", true))));
}

TEST_F (IoFormats, XyzWithColorsHasNoNormals)
{
  std::ostringstream text;
  text.precision (9);
  for (const Eigen::Vector3f& p : mesh_.points)
    text << p.transpose() << " 200 100 0\n";
  const InputCloud cloud = read (directory_.file ("a.xyz", text.str()));
  EXPECT_EQ (NormalSource::ESTIMATED, cloud.normals);
  expectOutward (cloud);
}

TEST_F (IoFormats, VtkOfEveryVersionAndCoding)
{
  const vtkNew<vtkPolyData> data = polyData();
  const std::string file = directory_.file ("a.vtk");
  for (const bool normals : {false, true}) {
    if (normals) {
      vtkNew<vtkFloatArray> array;
      array->SetName ("normals of points");
      array->SetNumberOfComponents (3);
      vtkNew<vtkFloatArray> scalars;
      scalars->SetName ("height");
      for (std::size_t i = 0; i < mesh_.points.size(); ++i) {
        array->InsertNextTuple (markedNormal (i).data());
        scalars->InsertNextValue (mesh_.points[i].z());
      }
      data->GetPointData()->SetScalars (scalars);
      data->GetPointData()->SetNormals (array);
    }
    for (const bool binary : {false, true})
      for (const int version : {vtkPolyDataWriter::VTK_LEGACY_READER_VERSION_4_2,
                                vtkPolyDataWriter::VTK_LEGACY_READER_VERSION_5_1}) {
        vtkNew<vtkPolyDataWriter> writer;
        writer->SetFileName (file.c_str());
        writer->SetInputData (data);
        writer->SetFileVersion (version);
        binary ? writer->SetFileTypeToBinary() : writer->SetFileTypeToASCII();
        ASSERT_EQ (1, writer->Write());
        const InputCloud cloud = read (file);
        expectPoints (cloud, binary ? 0.0F : 1e-5F);
        if (normals)
          for (std::size_t i = 0; i < cloud.points->size(); ++i)
            ASSERT_LE (
                ((*cloud.points)[i].getNormalVector3fMap() - markedNormal (i)).norm(),
                1e-5F);
        else
          expectOutward (cloud);
        EXPECT_EQ (normals ? NormalSource::FILE : NormalSource::FACES, cloud.normals);
      }
  }
}

TEST_F (IoFormats, VtkUnstructuredGrid)
{
  vtkNew<vtkUnstructuredGrid> grid;
  grid->SetPoints (polyData()->GetPoints());
  const std::string file = directory_.file ("a.vtk");
  const auto write = [&] (bool binary, int version) {
    vtkNew<vtkUnstructuredGridWriter> writer;
    writer->SetFileName (file.c_str());
    writer->SetInputData (grid);
    writer->SetFileVersion (version);
    binary ? writer->SetFileTypeToBinary() : writer->SetFileTypeToASCII();
    return writer->Write();
  };
  const vtkIdType vertex = 0;
  grid->InsertNextCell (VTK_VERTEX, 1, &vertex);
  for (const auto& t : mesh_.triangles) {
    const vtkIdType corners[3] = {t[0], t[1], t[2]};
    grid->InsertNextCell (VTK_TRIANGLE, 3, corners);
  }
  for (const bool binary : {false, true})
    for (const int version :
         {vtkUnstructuredGridWriter::VTK_LEGACY_READER_VERSION_4_2,
          vtkUnstructuredGridWriter::VTK_LEGACY_READER_VERSION_5_1}) {
      ASSERT_EQ (1, write (binary, version));
      const InputCloud cloud = read (file);
      expectPoints (cloud, binary ? 0.0F : 1e-5F);
      EXPECT_EQ (NormalSource::FACES, cloud.normals);
      expectOutward (cloud);
    }
}

TEST_F (IoFormats, PtxOfTwoScans)
{
  // The second is turned by a quarter about z, and moved; one beam is missing.
  const std::string head = "2\n1\n7 8 9\n1 0 0\n0 1 0\n0 0 1\n";
  const std::string plain =
      head + "1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n1 2 3 .5 255 0 9\n0 0 0 .5 0 0 0\n";
  const std::string moved = head + "0 1 0 0\n-1 0 0 0\n0 0 1 0\n10 20 30 1\n"
                                   "1 2 3 .5 1 2 3\n4 5 6 .5 1 2 3\n";
  const InputCloud cloud = read (directory_.file ("a.ptx", plain + moved));
  ASSERT_EQ (4U, cloud.points->size());
  EXPECT_EQ (Eigen::Vector3f (1, 2, 3), (*cloud.points)[0].getVector3fMap());
  EXPECT_TRUE (std::isnan ((*cloud.points)[1].x));
  EXPECT_EQ (Eigen::Vector3f (8, 21, 33), (*cloud.points)[2].getVector3fMap());
  EXPECT_EQ (Eigen::Vector3f (5, 24, 36), (*cloud.points)[3].getVector3fMap());
  EXPECT_EQ ((std::array<unsigned char, 3>{255, 0, 9}), cloud.colors.at (0));
  EXPECT_EQ (0U, cloud.notes.at (0).find ("1 of 4 beams"));
}

TEST_F (IoFormats, PtxIsSeenFromItsScanner)
{
  // A plane has no side but the scanner's.
  for (const int z : {9, -9}) {
    std::string text = "30\n30\n3 3 " + std::to_string (z) +
                       "\n1 0 0\n0 1 0\n0 0 1\n1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n";
    for (int column = 0; column < 30; ++column)
      for (int row = 0; row < 30; ++row)
        text += std::to_string (0.2 * column) + " " + std::to_string (0.2 * row) +
                " 1 0.5\n";
    const InputCloud cloud = read (directory_.file ("a.ptx", text));
    for (const pcl::PointNormal& point : *cloud.points)
      ASSERT_GT (point.normal_z * static_cast<float> (z), 0.0F);
  }
}

TEST_F (IoFormats, VtkFromPcl)
{
  const std::string file = directory_.file ("a.vtk");
  ASSERT_EQ (0, pcl::io::saveVTKFile (file, polygonMesh(), 9));
  const InputCloud cloud = read (file);
  expectPoints (cloud);
  expectOutward (cloud);
}

TEST_F (IoFormats, VtkTriangleStrip)
{
  const InputCloud cloud = read (directory_.file (
      "a.vtk",
      "# vtk DataFile Version 3.0\n\nASCII\nDATASET POLYDATA\nPOINTS 5 double\n0 0 0\n"
      "1 0 0\n0 1 0\n1 1 0\n0 2 0\nTRIANGLE_STRIPS 1 6\n5 0 1 2 3 4\n"));
  EXPECT_EQ (NormalSource::FACES, cloud.normals);
  ASSERT_EQ (5U, cloud.points->size());
  for (const pcl::PointNormal& point : *cloud.points)
    EXPECT_EQ (Eigen::Vector3f::UnitZ(), point.getNormalVector3fMap());
}

TEST_F (IoFormats, StlMergesCornersInTheirOrder)
{
  std::vector<int> order;
  for (const auto& t : mesh_.triangles)
    for (const int corner : t)
      if (std::find (order.begin(), order.end(), corner) == order.end())
        order.push_back (corner);
  for (const bool binary : {false, true}) {
    const std::string file = directory_.file ("a.stl");
    writeStl (binary, file);
    const InputCloud cloud = read (file);
    ASSERT_EQ (order.size(), cloud.points->size());
    for (std::size_t i = 0; i < order.size(); ++i)
      ASSERT_LE (((*cloud.points)[i].getVector3fMap() - mesh_.points[order[i]]).norm(),
                 1e-5F);
    EXPECT_EQ (NormalSource::FACES, cloud.normals);
    expectOutward (cloud);
  }
}

TEST_F (IoFormats, StlMergesCornersThatAreNoNumbers)
{
  std::string text = "solid a\n";
  for (int i = 0; i < 50; ++i)
    text += "facet normal 0 0 1\nouter loop\nvertex nan 0 0\nvertex 0 1 -0\n"
            "vertex -0 1 0\nendloop\nendfacet\n";
  const InputCloud cloud = read (directory_.file ("a.stl", text + "endsolid a\n"));
  EXPECT_EQ (2U, cloud.points->size());
}

TEST_F (IoFormats, StlThatBeginsWithABlankOrSolid)
{
  for (const bool binary : {false, true}) {
    const std::string file = directory_.file ("a.stl");
    writeStl (binary, file);
    std::string text = oracle::contentOf (file);
    text.replace (0, binary ? 5 : 0, binary ? "solid" : " \n");
    const InputCloud plain = read (file);
    const InputCloud other = read (directory_.file ("b.stl", text));
    ASSERT_EQ (plain.points->size(), other.points->size());
    for (std::size_t i = 0; i < plain.points->size(); ++i)
      ASSERT_EQ ((*plain.points)[i].getVector3fMap(),
                 (*other.points)[i].getVector3fMap());
  }
}

/** \brief Writes decimal commas, on machines without any such locale too. */
class CommaPoint : public std::numpunct<char> {
  char
  do_decimal_point () const override
  {
    return ',';
  }
};

TEST_F (IoFormats, NumbersDoNotDependOnTheLocale)
{
  const std::string xyz = directory_.file ("a.xyz", lines (""));
  const std::string pcd = directory_.file ("a.pcd");
  pcl::PCDWriter().writeASCII (pcd, this->xyz(), 9);
  const std::string c_before = std::setlocale (LC_ALL, nullptr);
  std::setlocale (LC_ALL, "de_DE.UTF-8");
  const std::locale before =
      std::locale::global (std::locale (std::locale::classic(), new CommaPoint));
  const InputCloud from_xyz = read (xyz);
  const InputCloud from_pcd = read (pcd);
  std::locale::global (before);
  std::setlocale (LC_ALL, c_before.c_str());
  expectPoints (from_xyz);
  expectPoints (from_pcd);
}

TEST_F (IoFormats, NumbersOfAnySize)
{
  const InputCloud cloud = read (directory_.file (
      "a.xyz", "1e-400 +2.5 -1E3\n1e400 0 0\n-1e400 nan inf\n1 1 1\n.5 5. -0\n"));
  ASSERT_EQ (5U, cloud.points->size());
  EXPECT_EQ (Eigen::Vector3f (0, 2.5F, -1000), (*cloud.points)[0].getVector3fMap());
  EXPECT_EQ (std::numeric_limits<float>::infinity(), (*cloud.points)[1].x);
  EXPECT_EQ (-std::numeric_limits<float>::infinity(), (*cloud.points)[2].x);
  EXPECT_TRUE (std::isnan ((*cloud.points)[2].y));
  EXPECT_EQ (Eigen::Vector3f (0.5F, 5, 0), (*cloud.points)[4].getVector3fMap());
  EXPECT_FALSE (cloud.points->is_dense);
  EXPECT_EQ ("2 of 5 points are not finite.", cloud.notes.at (0));
  // Too small or too large, but not by their powers of ten alone.
  const std::string zeros (400, '0');
  const InputCloud odd = read (directory_.file (
      "b.xyz",
      "-0." + zeros + "1 1" + zeros + "e-800 1e-99999999999999999999\n1" + zeros +
          " 1" + zeros + "e-1 1e99999999999999999999\n1 2 3\n"));
  EXPECT_TRUE ((*odd.points)[0].getVector3fMap().isZero (0.0F));
  for (int axis = 0; axis < 3; ++axis)
    EXPECT_EQ (std::numeric_limits<float>::infinity(), (*odd.points)[1].data[axis]);
}

} // namespace
