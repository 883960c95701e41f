// SPDX-License-Identifier: BSD-3-Clause
// VTK's XML polydata, written by VTK in all its codings, is read; what is wrong is
// told.
#include <pcl_crest/io/read_cloud.h>

#include <gtest/gtest.h>

#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataWriter.h>

#include "support/sphere_mesh.h"
#include "support/temporary_directory.h"

#include <random>

using namespace pcl::crest;

namespace {

class IoVtp : public testing::Test {
protected:
  const oracle::TemporaryDirectory directory_;
  const oracle::TriangleMesh mesh_ = oracle::cubeSphere (4);

  vtkNew<vtkPolyData>
  polyData (bool normals, bool doubles) const
  {
    vtkNew<vtkPolyData> data;
    vtkNew<vtkPoints> points;
    points->SetDataType (doubles ? VTK_DOUBLE : VTK_FLOAT);
    vtkNew<vtkFloatArray> of_points;
    of_points->SetName ("some normals");
    of_points->SetNumberOfComponents (3);
    for (const Eigen::Vector3f& p : mesh_.points) {
      points->InsertNextPoint (p.x(), p.y(), p.z());
      const Eigen::Vector3f inward = -p.normalized();
      of_points->InsertNextTypedTuple (inward.data());
    }
    vtkNew<vtkCellArray> cells;
    for (const auto& t : mesh_.triangles) {
      const vtkIdType corners[3] = {t[0], t[1], t[2]};
      cells->InsertNextCell (3, corners);
    }
    data->SetPoints (points);
    data->SetPolys (cells);
    if (normals)
      data->GetPointData()->SetNormals (of_points);
    return data;
  }

  std::string
  write (vtkPolyData* data,
         const std::function<void (vtkXMLPolyDataWriter&)>& choose) const
  {
    vtkNew<vtkXMLPolyDataWriter> writer;
    writer->SetFileName (directory_.file ("a.vtp").c_str());
    writer->SetInputData (data);
    choose (*writer);
    EXPECT_EQ (1, writer->Write());
    return directory_.file ("a.vtp");
  }

  std::string
  refusal (const std::string& content) const
  {
    const std::string file = directory_.file ("b.vtp", content);
    InputCloud cloud;
    std::string error;
    EXPECT_FALSE (readCloud (file, 12, 1, cloud, error)) << content.substr (0, 1000);
    EXPECT_EQ (0U, error.find (file + ":")) << error;
    return error.substr (std::min (error.size(), file.size() + 1));
  }
};

TEST_F (IoVtp, AllCodingsOfVtk)
{
  for (const bool normals : {false, true})
    for (const int mode :
         {vtkXMLWriter::Ascii, vtkXMLWriter::Binary, vtkXMLWriter::Appended})
      for (const int choice : {0, 1, 2, 3, 4, 5, 6, 7}) {
        SCOPED_TRACE (testing::Message() << mode << " " << choice);
        const std::string file =
            write (polyData (normals, choice % 4 == 3), [&] (auto& writer) {
              writer.SetDataMode (mode);
              writer.SetEncodeAppendedData (choice % 2);
              if (choice < 4)
                writer.SetCompressorTypeToNone();
              else
                writer.SetCompressorTypeToZLib();
              writer.SetBlockSize (200);
              if (choice % 4 >= 2)
                writer.SetHeaderTypeToUInt64();
              else
                writer.SetHeaderTypeToUInt32();
              if (choice == 1 || choice == 6)
                writer.SetByteOrderToBigEndian();
            });
        InputCloud cloud;
        std::string error;
        ReadOptions options;
        options.samples_faces = false;
        ASSERT_TRUE (readCloud (file, 12, 1, cloud, error, options)) << error;
        EXPECT_EQ (normals ? NormalSource::FILE : NormalSource::FACES, cloud.normals);
        ASSERT_EQ (mesh_.points.size(), cloud.points->size());
        for (std::size_t i = 0; i < mesh_.points.size(); ++i) {
          ASSERT_EQ (mesh_.points[i], (*cloud.points)[i].getVector3fMap());
          const float outward =
              (*cloud.points)[i].getNormalVector3fMap().dot (mesh_.points[i]);
          ASSERT_GT (normals ? -outward : outward, 0.9F);
        }
      }
}

TEST_F (IoVtp, StripsAreTriangles)
{
  const std::string file = directory_.file ("s.vtp",
                                            R"(<VTKFile type="PolyData"><PolyData>
<Piece NumberOfPoints="4" NumberOfStrips="1"><Points>
<DataArray type="Float32" NumberOfComponents="3" format="ascii">0 0 0 1 0 0 0 1 0 1 1 0</DataArray></Points>
<Strips><DataArray type="Int64" Name="connectivity" format="ascii">0 1 2 3</DataArray>
<DataArray type="Int64" Name="offsets" format="ascii">4</DataArray></Strips></Piece>
</PolyData></VTKFile>)");
  ReadOptions options;
  options.samples_faces = false;
  InputCloud cloud;
  std::string error;
  ASSERT_TRUE (readCloud (file, 4, 1, cloud, error, options)) << error;
  EXPECT_EQ (NormalSource::FACES, cloud.normals);
  for (const pcl::PointNormal& point : *cloud.points)
    EXPECT_EQ (Eigen::Vector3f (0, 0, 1), point.getNormalVector3fMap());
}

TEST_F (IoVtp, WhatIsWrongIsTold)
{
  const auto file = [] (const std::string& counts,
                        const std::string& points,
                        const std::string& cells = "") {
    return "<VTKFile type=\"PolyData\"><PolyData><Piece " + counts + "><Points>" +
           points + "</Points>" + cells + "</Piece></PolyData></VTKFile>";
  };
  const std::string array =
      "<DataArray type=\"Float32\" NumberOfComponents=\"3\" format=\"ascii\">";
  const std::string count = "NumberOfPoints=\"2\"";
  const auto contains = [this] (const std::string& text, const std::string& part) {
    const std::string message = refusal (text);
    EXPECT_NE (std::string::npos, message.find (part)) << message;
  };
  contains ("<VTKFile type=\"PolyData\">", "it is no XML");
  contains ("<a/>", "it has no element VTKFile");
  contains ("<VTKFile type=\"ImageData\"/>",
            "type \"ImageData\", but must have PolyData");
  contains ("<VTKFile type=\"PolyData\"/>", "it has no points");
  contains ("<VTKFile type=\"PolyData\" compressor=\"vtkLZ4DataCompressor\"/>",
            "compressed by vtkLZ4DataCompressor, but must be by vtkZLibDataCompressor");
  contains (file ("NumberOfPoints=\"many\"", ""), "NumberOfPoints is \"many\"");
  contains (file ("NumberOfPoints=\"99999999999999\"", ""),
            "must be a whole number up");
  contains (file (count, ""), "it lacks an element DataArray");
  contains (file (count, array + "0 0 0 1 0</DataArray>"),
            "the array of its points should have 6 numbers, but is too short for them");
  contains (file (count, array + "0 0 0 1 0 x</DataArray>"), "found \"x\"");
  contains (file (count, array + "0 0 0 1 0 0 7</DataArray>"),
            "has more than the 6 numbers that are announced");
  contains (file ("NumberOfPoints=\"999999999\"", array + "0 0 0</DataArray>"),
            "should have 2999999997 numbers, but is too short for them");
  contains (file (count, "<DataArray type=\"Real\" format=\"ascii\"/>"),
            "has the type \"Real\"");
  contains (file (count, "<DataArray type=\"Int8\" format=\"raw\"/>"),
            "has the format \"raw\", but must have ascii, binary or appended");
  contains (file (count, "<DataArray type=\"Int8\" format=\"appended\" offset=\"5\"/>"),
            "has the offset \"5\", but that is not within the appended data");
  contains (
      file (count, "<DataArray type=\"Int8\" format=\"binary\">BgAAAA!</DataArray>"),
      "is cut off");
  contains (
      file (count, "<DataArray type=\"Int8\" format=\"binary\">BgA!AA==</DataArray>"),
      "is no base64: it has \"!\"");
  contains (
      file (count, "<DataArray type=\"Int8\" format=\"binary\">BwAAAA==</DataArray>"),
      "has 7 bytes, but those announced take 6");
  contains (file (count + " NumberOfPolys=\"1\"",
                  array + "0 0 0 1 0 0</DataArray>",
                  "<Polys><DataArray type=\"Int8\" Name=\"connectivity\" "
                  "format=\"ascii\">0 1 2</DataArray><DataArray type=\"Int8\" "
                  "Name=\"offsets\" format=\"ascii\">3</DataArray></Polys>"),
            "a face has the corner 2.0");
  contains (file (count + " NumberOfPolys=\"1\"",
                  array + "0 0 0 1 0 0</DataArray>",
                  "<Polys><DataArray type=\"Int8\" Name=\"offsets\" "
                  "format=\"ascii\">3</DataArray></Polys>"),
            "its Polys need the arrays connectivity and offsets");
  std::string deep;
  for (int i = 0; i < 100000; ++i)
    deep += "<a>";
  contains (deep, "nested more than 64 deep");
}

TEST_F (IoVtp, WhateverIsCutOrChangedIsReadOrRefused)
{
  std::mt19937 random (1);
  for (const int choice : {0, 1, 2, 3}) {
    const std::string file = write (polyData (false, false), [&] (auto& writer) {
      writer.SetDataMode (vtkXMLWriter::Appended);
      writer.SetEncodeAppendedData (choice % 2);
      writer.SetBlockSize (200);
      if (choice < 2)
        writer.SetCompressorTypeToNone();
      else
        writer.SetCompressorTypeToZLib();
    });
    const std::string good = oracle::contentOf (file);
    const std::size_t data = good.find ('_');
    for (int i = 0; i < 60; ++i)
      refusal (good.substr (0, random() % (data + 300)));
    for (int i = 0; i < 300; ++i) {
      std::string text = good;
      for (int j = 0; j < 3; ++j)
        text[random() % (i % 2 == 0 ? data + 200 : text.size())] =
            static_cast<char> (random());
      InputCloud cloud;
      std::string error;
      const bool is_read =
          readCloud (directory_.file ("b.vtp", text), 12, 1, cloud, error);
      ASSERT_EQ (is_read, error.empty());
    }
  }
}

} // namespace
