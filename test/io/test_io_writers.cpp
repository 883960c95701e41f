// SPDX-License-Identifier: BSD-3-Clause
// What is written is read back by other readers: PCL's, VTK's, a few lines of text.
#include <pcl_crest/io/write_labels.h>
#include <pcl_crest/io/write_lines.h>
#include <pcl_crest/io/write_statistics.h>

#include <pcl/io/pcd_io.h>

#include <gtest/gtest.h>

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkOBJReader.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataReader.h>
#include <vtkSmartPointer.h>
#include <vtkXMLPolyDataReader.h>

#include "io/output_file.h"
#include "support/analytic_surface.h"
#include "support/temporary_directory.h"
#include <gdal_priv.h>
#include <nlohmann/json.hpp>
#include <ogrsf_frmts.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <csignal>
#include <limits>
#include <map>
#include <memory>
#include <set>
#include <sstream>

using namespace pcl::crest;

namespace {

using Position = std::array<float, 3>;

/** \brief A polyline as a file tells it. */
struct FileLine {
  int type;
  std::vector<Position> positions;

  bool
  operator== (const FileLine& other) const
  {
    return type == other.type && positions == other.positions;
  }
};

using Numbers = std::map<std::string, double>;

/** \brief The colors of ridges and of valleys. */
const std::array<int, 3> BLUE{10, 40, 220};
const std::array<int, 3> RED{220, 15, 15};

/** \brief What files tell of a line beside its course. */
Numbers
measuresOf (const CrestLine& line)
{
  return {{"type", static_cast<double> (line.type)},
          {"size", static_cast<double> (line.size)},
          {"closed", line.closed ? 1.0 : 0.0},
          {"length", line.length},
          {"strength", line.strength},
          {"mean_curvature", line.mean_curvature},
          {"turning_angle", line.turning_angle},
          {"scale", line.scale},
          {"sign_trust", line.sign_trust}};
}

class IoWriters : public testing::Test {
protected:
  const oracle::TemporaryDirectory directory_;
  pcl::PointCloud<pcl::PointNormal> cloud_;
  /** a ridge with a junction, a closed valley, a second ridge; not all points used */
  const std::vector<CrestLine> lines_{{CrestType::RIDGE,
                                       5,
                                       4.0,
                                       false,
                                       {{1, 7, 3}, {3, 9}, {3, 20}},
                                       {{LineEnd::FREE, LineEnd::JUNCTION},
                                        {LineEnd::JUNCTION, LineEnd::BOUNDARY},
                                        {LineEnd::JUNCTION, LineEnd::FREE}},
                                       2.5,
                                       0.625,
                                       1.0 / 3.0,
                                       0.1},
                                      {CrestType::VALLEY,
                                       3,
                                       3.0,
                                       true,
                                       {{12, 4, 30, 12}},
                                       {{LineEnd::CLOSED, LineEnd::CLOSED}},
                                       1e-300,
                                       1e300,
                                       180.0,
                                       1e-9},
                                      {CrestType::RIDGE,
                                       2,
                                       1.0,
                                       false,
                                       {{8, 2}},
                                       {{LineEnd::BOUNDARY, LineEnd::FREE}},
                                       7.0,
                                       7.0}};

  IoWriters()
  {
    for (int i = 0; i < 40; ++i) {
      pcl::PointNormal point (0.1F * i, 1.0F / (i + 1), 1e-7F * i * i);
      point.getNormalVector3fMap() = Eigen::Vector3f (i, 1, 2).normalized();
      cloud_.push_back (point);
    }
  }

  Position
  at (pcl::index_t i) const
  {
    return {cloud_[i].x, cloud_[i].y, cloud_[i].z};
  }

  /** \brief The cloud as one that was read. */
  InputCloud
  input () const
  {
    InputCloud input;
    input.points.reset (new pcl::PointCloud<pcl::PointNormal> (cloud_));
    return input;
  }

  std::vector<FileLine>
  expected () const
  {
    std::vector<FileLine> polylines;
    for (const CrestLine& line : lines_)
      for (const auto& polyline : line.polylines) {
        polylines.push_back ({static_cast<int> (line.type), {}});
        for (const pcl::index_t i : polyline)
          polylines.back().positions.push_back (at (i));
      }
    return polylines;
  }

  std::string
  written (const std::string& name) const
  {
    std::string error;
    EXPECT_TRUE (writeLines (directory_.file (name), cloud_, lines_, error)) << error;
    return directory_.file (name);
  }
};

std::vector<FileLine>
linesOf (vtkPolyData* data)
{
  std::vector<FileLine> lines;
  vtkDataArray* const types = data->GetCellData()->GetArray ("type");
  for (vtkIdType i = 0; i < data->GetNumberOfCells(); ++i) {
    vtkNew<vtkIdList> corners;
    data->GetCellPoints (i, corners);
    lines.push_back ({types ? static_cast<int> (types->GetTuple1 (i)) : 0, {}});
    for (vtkIdType j = 0; j < corners->GetNumberOfIds(); ++j) {
      double p[3];
      data->GetPoint (corners->GetId (j), p);
      lines.back().positions.push_back ({static_cast<float> (p[0]),
                                         static_cast<float> (p[1]),
                                         static_cast<float> (p[2])});
    }
  }
  return lines;
}

/** \brief What a reader of VTK makes of a file. */
template <typename Reader>
vtkSmartPointer<vtkPolyData>
readBy (const std::string& file)
{
  vtkNew<Reader> reader;
  reader->SetFileName (file.c_str());
  reader->Update();
  EXPECT_EQ (0UL, reader->GetErrorCode());
  return reader->GetOutput();
}

class VtkLines : public IoWriters, public testing::WithParamInterface<const char*> {};

TEST_P (VtkLines, AreReadByVtk)
{
  const std::string file = written (GetParam());
  const vtkSmartPointer<vtkPolyData> data = GetParam() == std::string ("a.vtk")
                                                ? readBy<vtkPolyDataReader> (file)
                                                : readBy<vtkXMLPolyDataReader> (file);
  EXPECT_EQ (10, data->GetNumberOfPoints());
  // Bytes of three components are shown as colors at once.
  for (vtkDataArray* const colors :
       {data->GetPointData()->GetScalars(), data->GetCellData()->GetScalars()}) {
    ASSERT_NE (nullptr, colors);
    EXPECT_STREQ ("RGB", colors->GetName());
    EXPECT_EQ (VTK_UNSIGNED_CHAR, colors->GetDataType());
    ASSERT_EQ (3, colors->GetNumberOfComponents());
  }
  for (vtkIdType cell = 0; cell < data->GetNumberOfCells(); ++cell) {
    const bool ridge = data->GetCellData()->GetArray ("type")->GetTuple1 (cell) == 1.0;
    vtkNew<vtkIdList> corners;
    data->GetCellPoints (cell, corners);
    for (int c = 0; c < 3; ++c) {
      const int channel = ridge ? BLUE.at (c) : RED.at (c);
      EXPECT_EQ (channel, data->GetCellData()->GetScalars()->GetComponent (cell, c));
      EXPECT_EQ (
          channel,
          data->GetPointData()->GetScalars()->GetComponent (corners->GetId (0), c));
    }
  }
  EXPECT_EQ (expected(), linesOf (data));
  const auto value = [data] (const std::string& name, vtkIdType cell) {
    vtkDataArray* const array = data->GetCellData()->GetArray (name.c_str());
    EXPECT_NE (nullptr, array) << name;
    return array == nullptr ? -1.0 : array->GetTuple1 (cell);
  };
  vtkIdType cell = 0;
  for (std::size_t i = 0; i < lines_.size(); ++i)
    for (const std::array<LineEnd, 2>& ends : lines_[i].ends) {
      EXPECT_EQ (i, value ("line", cell));
      EXPECT_EQ (static_cast<int> (ends[0]), value ("first_end", cell));
      EXPECT_EQ (static_cast<int> (ends[1]), value ("last_end", cell));
      for (const auto& [name, measure] : measuresOf (lines_[i]))
        EXPECT_EQ (measure, value (name, cell)) << name;
      ++cell;
    }
}

INSTANTIATE_TEST_SUITE_P (LegacyAndXml, VtkLines, testing::Values ("a.vtk", "a.vtp"));

TEST_F (IoWriters, LinesAsObj)
{
  const std::string file = written ("a.OBJ");
  vtkNew<vtkOBJReader> reader;
  reader->SetFileName (file.c_str());
  reader->Update();
  // The ridges come first in the file; VTK tells no groups, the text does.
  std::vector<FileLine> ridges_first = expected();
  std::swap (ridges_first[3], ridges_first[4]);
  std::vector<FileLine> read = linesOf (reader->GetOutput());
  std::istringstream text (oracle::contentOf (file));
  std::string line;
  int type = 0;
  std::size_t next = 0;
  while (std::getline (text, line)) {
    if (line == "g ridge" || line == "g valley")
      type = line == "g ridge" ? 1 : 2;
    else if (line[0] == 'l')
      read.at (next++).type = type;
    else if (line.find ("mtllib") == 0)
      EXPECT_EQ ("mtllib a.mtl", line);
    else if (line.find ("usemtl") == 0)
      EXPECT_EQ (type == 1 ? "usemtl ridge" : "usemtl valley", line);
    else
      ASSERT_EQ ("v ", line.substr (0, 2));
  }
  EXPECT_EQ (ridges_first, read);
  EXPECT_EQ (2U, directory_.names().size());
  EXPECT_EQ ((std::vector<std::string>{file, directory_.file ("a.mtl")}),
             lineFiles (file));
  const std::string materials = oracle::contentOf (directory_.file ("a.mtl"));
  std::map<std::string, std::array<int, 3>> colors;
  std::istringstream lines (materials);
  std::string name;
  for (std::string word; lines >> word;)
    if (word == "newmtl")
      lines >> name;
    else if (word == "Kd")
      for (int& channel : colors[name]) {
        float part = 0.0F;
        lines >> part;
        channel = static_cast<int> (std::lround (255.0F * part));
      }
  EXPECT_EQ (BLUE, colors["ridge"]);
  EXPECT_EQ (RED, colors["valley"]);
}

TEST_F (IoWriters, NeitherOfTheFilesOfObjIsThereAlone)
{
  std::string error;
  std::filesystem::create_directory (directory_.file ("a.obj"));
  EXPECT_FALSE (writeLines (directory_.file ("a.obj"), cloud_, lines_, error));
  EXPECT_EQ (directory_.file ("a.obj") + ": it cannot be written: it is a directory",
             error);
  std::filesystem::create_directory (directory_.file ("b.mtl"));
  EXPECT_FALSE (writeLines (directory_.file ("b.obj"), cloud_, lines_, error));
  EXPECT_EQ (directory_.file ("b.mtl") + ": it cannot be written: it is a directory",
             error);
  EXPECT_EQ ((std::vector<std::string>{"a.obj", "b.mtl"}), directory_.names());
}

/** \brief The numbers of a PLY file in ASCII: elements by name, properties by name. */
std::map<std::string, std::vector<Numbers>>
readPly (const std::string& file)
{
  struct Element {
    std::string name;
    std::size_t count;
    std::vector<std::string> properties;
  };
  std::vector<Element> elements;
  std::istringstream text (oracle::contentOf (file));
  std::string line;
  while (std::getline (text, line) && line != "end_header") {
    std::istringstream words (line);
    std::string word;
    words >> word;
    if (word == "element") {
      elements.emplace_back();
      words >> elements.back().name >> elements.back().count;
    }
    else if (word == "property") {
      words >> word >> word;
      elements.back().properties.push_back (word);
    }
  }
  std::map<std::string, std::vector<Numbers>> items;
  for (const Element& element : elements)
    for (std::size_t i = 0; i < element.count; ++i) {
      items[element.name].emplace_back();
      for (const std::string& property : element.properties)
        text >> items[element.name].back()[property];
    }
  EXPECT_TRUE (text);
  EXPECT_FALSE (text >> line);
  return items;
}

TEST_F (IoWriters, LinesAsPly)
{
  auto items = readPly (written ("a.ply"));
  const auto& edges = items["edge"];
  const auto positionOf = [&] (double vertex) -> Position {
    const Numbers& item = items["vertex"].at (static_cast<std::size_t> (vertex));
    return {static_cast<float> (item.at ("x")),
            static_cast<float> (item.at ("y")),
            static_cast<float> (item.at ("z"))};
  };
  // The edges one after the other give the polylines again.
  std::size_t next = 0;
  std::size_t next_polyline = 0;
  for (std::size_t i = 0; i < lines_.size(); ++i) {
    const CrestLine& line = lines_[i];
    EXPECT_EQ (measuresOf (line), items["line"].at (i));
    for (std::size_t p = 0; p < line.polylines.size(); ++p, ++next_polyline) {
      const Numbers ends{{"line", static_cast<double> (i)},
                         {"first_end", static_cast<double> (line.ends[p][0])},
                         {"last_end", static_cast<double> (line.ends[p][1])}};
      EXPECT_EQ (ends, items["polyline"].at (next_polyline));
      for (std::size_t j = 1; j < line.polylines[p].size(); ++j, ++next) {
        const Numbers& edge = edges.at (next);
        EXPECT_EQ (at (line.polylines[p][j - 1]), positionOf (edge.at ("vertex1")));
        EXPECT_EQ (at (line.polylines[p][j]), positionOf (edge.at ("vertex2")));
        const std::array<int, 3>& color = line.type == CrestType::RIDGE ? BLUE : RED;
        for (const auto& [name, channel] : {std::pair ("red", color[0]),
                                            std::pair ("green", color[1]),
                                            std::pair ("blue", color[2])}) {
          EXPECT_EQ (channel, edge.at (name));
          EXPECT_EQ (channel,
                     items["vertex"]
                         .at (static_cast<std::size_t> (edge.at ("vertex1")))
                         .at (name));
        }
        EXPECT_EQ (static_cast<int> (line.type), edge.at ("type"));
        EXPECT_EQ (i, edge.at ("line"));
        EXPECT_EQ (next_polyline, edge.at ("polyline"));
      }
    }
  }
  EXPECT_EQ (next, edges.size());
  EXPECT_EQ (next_polyline, items["polyline"].size());
  EXPECT_EQ (lines_.size(), items["line"].size());
}

TEST_F (IoWriters, NoLinesAtAllMakeValidFiles)
{
  for (const std::string& extension : lineExtensions()) {
    std::string error;
    if (!checkLines ("e" + extension, "", error))
      continue; // built without GDAL
    EXPECT_TRUE (writeLines (directory_.file ("e" + extension), cloud_, {}, error));
  }
  vtkNew<vtkPolyDataReader> reader;
  reader->SetFileName (directory_.file ("e.vtk").c_str());
  reader->Update();
  EXPECT_EQ (0, reader->GetOutput()->GetNumberOfCells());
  EXPECT_EQ (0UL, reader->GetErrorCode());
  EXPECT_EQ (
      0, readBy<vtkXMLPolyDataReader> (directory_.file ("e.vtp"))->GetNumberOfCells());
  EXPECT_TRUE (nlohmann::json::parse (oracle::contentOf (directory_.file ("e.geojson")))
                   .at ("features")
                   .empty());
}

TEST_F (IoWriters, LinesAsGeoJson)
{
  const auto json = nlohmann::json::parse (oracle::contentOf (written ("a.geojson")));
  EXPECT_EQ ("FeatureCollection", json.at ("type"));
  ASSERT_EQ (lines_.size(), json.at ("features").size());
  for (std::size_t i = 0; i < lines_.size(); ++i) {
    const CrestLine& line = lines_[i];
    const auto& feature = json.at ("features")[i];
    EXPECT_EQ ("Feature", feature.at ("type"));
    const auto& properties = feature.at ("properties");
    EXPECT_EQ (i, properties.at ("id"));
    EXPECT_EQ (line.type == CrestType::RIDGE ? "ridge" : "valley",
               properties.at ("type"));
    for (const auto& [name, measure] : measuresOf (line)) {
      EXPECT_TRUE (name == "type" || measure == properties.at (name)) << name;
    }
    const auto& geometry = feature.at ("geometry");
    EXPECT_EQ ("MultiLineString", geometry.at ("type"));
    ASSERT_EQ (line.polylines.size(), geometry.at ("coordinates").size());
    for (std::size_t p = 0; p < line.polylines.size(); ++p) {
      std::vector<Position> positions;
      for (const pcl::index_t point : line.polylines[p])
        positions.push_back (at (point));
      EXPECT_EQ (positions,
                 geometry.at ("coordinates")[p].get<std::vector<Position>>());
    }
  }
}

/** \brief The lines of a file as GDAL reads them, by the names of their layers or
 * types, all polylines by themselves.
 */
std::vector<FileLine>
readByGdal (const std::string& file, const char* type_field)
{
  GDALAllRegister();
  std::vector<FileLine> lines;
  const std::unique_ptr<GDALDataset, decltype (&GDALClose)> data (
      GDALDataset::Open (file.c_str(), GDAL_OF_VECTOR), &GDALClose);
  EXPECT_NE (nullptr, data) << file;
  if (data == nullptr)
    return lines;
  for (OGRLayer* const layer : data->GetLayers())
    for (const auto& feature : *layer) {
      const std::string type = feature->GetFieldAsString (type_field);
      const auto add = [&] (const OGRLineString& polyline) {
        lines.push_back ({type == "ridge" || type == "RIDGE"     ? 1
                          : type == "valley" || type == "VALLEY" ? 2
                                                                 : 0,
                          {}});
        for (const OGRPoint& point : polyline)
          lines.back().positions.push_back ({static_cast<float> (point.getX()),
                                             static_cast<float> (point.getY()),
                                             static_cast<float> (point.getZ())});
      };
      const OGRGeometry* const geometry = feature->GetGeometryRef();
      EXPECT_NE (nullptr, geometry);
      if (geometry == nullptr)
        continue;
      if (wkbFlatten (geometry->getGeometryType()) == wkbLineString)
        add (*geometry->toLineString());
      else
        for (const OGRLineString* const polyline : *geometry->toMultiLineString())
          add (*polyline);
    }
  return lines;
}

TEST_F (IoWriters, LinesAreReadByGdal)
{
  EXPECT_EQ (expected(), readByGdal (written ("a.geojson"), "type"));
  EXPECT_EQ (expected(), readByGdal (written ("a.csv"), "type"));
  EXPECT_EQ (expected(), readByGdal (written ("a.dxf"), "Layer"));
}

TEST_F (IoWriters, LinesAsCsv)
{
  std::istringstream text (oracle::contentOf (written ("a.csv")));
  std::string row;
  std::getline (text, row);
  EXPECT_EQ ("id,type,length,strength,vertices,WKT", row);
  for (const char* const start : {"0,ridge,4,2.5,5,\"MULTILINESTRING Z ((",
                                  "1,valley,3,1e-300,3,\"MULTILINESTRING Z ((",
                                  "2,ridge,1,7,2,\"MULTILINESTRING Z (("}) {
    std::getline (text, row);
    EXPECT_EQ (0U, row.find (start)) << row;
  }
  EXPECT_FALSE (std::getline (text, row));
}

TEST_F (IoWriters, LabelsAsPcd)
{
  pcl::PointCloud<pcl::Label> labels;
  pcl::PointCloud<pcl::PrincipalCurvatures> curvatures;
  for (int i = 0; i < 40; ++i) {
    labels.push_back (pcl::Label());
    labels.back().label = i % 6;
    const float k = static_cast<float> (i - 20);
    curvatures.push_back ({0.6F, 0.8F, k, -k, k / 3});
  }
  cloud_.width = 8;
  cloud_.height = 5;
  cloud_.sensor_origin_ = Eigen::Vector4f (0.1F, -2, 3, 0);
  cloud_.sensor_orientation_ = Eigen::Quaternionf (0.5F, 0.5F, -0.5F, 0.5F);
  std::string error;
  const std::string file = directory_.file ("a.pcd");
  ASSERT_TRUE (writeLabels (file, input(), labels, curvatures, {}, error)) << error;
  pcl::PointCloud<pcl::PointXYZLNormal> read;
  ASSERT_EQ (0, pcl::io::loadPCDFile (file, read));
  EXPECT_EQ (8U, read.width);
  EXPECT_EQ (5U, read.height);
  EXPECT_EQ (cloud_.sensor_origin_, read.sensor_origin_);
  EXPECT_EQ (cloud_.sensor_orientation_.coeffs(), read.sensor_orientation_.coeffs());
  pcl::PCLPointCloud2 fields;
  pcl::io::loadPCDFile (file, fields);
  EXPECT_EQ ("x y z normal_x normal_y normal_z curvature label line strength",
             pcl::getFieldsList (fields));
  for (std::size_t i = 0; i < read.size(); ++i) {
    EXPECT_EQ (cloud_[i].getVector3fMap(), read[i].getVector3fMap());
    EXPECT_EQ (cloud_[i].getNormalVector3fMap(), read[i].getNormalVector3fMap());
    EXPECT_EQ (curvatures[i].pc1, read[i].curvature);
    EXPECT_EQ (i % 6, read[i].label);
  }
  ASSERT_TRUE (writeCurvatures (file, cloud_, curvatures, error)) << error;
  pcl::PointCloud<pcl::PointNormal> points;
  pcl::PointCloud<pcl::PrincipalCurvatures> read_curvatures;
  ASSERT_EQ (0, pcl::io::loadPCDFile (file, points));
  ASSERT_EQ (0, pcl::io::loadPCDFile (file, read_curvatures));
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_EQ (cloud_[i].getVector3fMap(), points[i].getVector3fMap());
    EXPECT_EQ (cloud_[i].getNormalVector3fMap(), points[i].getNormalVector3fMap());
    const pcl::PrincipalCurvatures& c = read_curvatures[i];
    EXPECT_EQ (curvatures[i].principal_curvature_z, c.principal_curvature_z);
    EXPECT_EQ (curvatures[i].principal_curvature_x, c.principal_curvature_x);
    EXPECT_EQ (curvatures[i].pc1, c.pc1);
    EXPECT_EQ (curvatures[i].pc2, c.pc2);
  }
}

TEST_F (IoWriters, StatisticsAreThoseOfTheRun)
{
  InputCloud input;
  input.points = oracle::sample (oracle::bumpySphere(), 4000);
  const double mean_spacing = oracle::meanSpacing (*input.points);
  input.points->push_back (
      pcl::PointNormal (std::numeric_limits<float>::quiet_NaN(), 0, 0));
  input.points->is_dense = false;
  input.normals = NormalSource::FACES;
  pcl::CrestLineEstimation<pcl::PointNormal> estimation;
  Parameters parameters;
  parameters.preset = Preset::PAPER;
  parameters.min_size = {12, 15};
  parameters.maximality.valley = 0.5;
  parameters.threads = 2;
  estimation.setParameters (parameters);
  estimation.setInputCloud (input.points);
  pcl::PointCloud<pcl::Label> labels;
  estimation.compute (labels);
  ASSERT_FALSE (estimation.getLines().empty());
  std::string error;
  const std::string file = directory_.file ("a.json");
  ASSERT_TRUE (writeStatistics (
      file, input, labels, estimation, {{"a", 1.5}, {"b", 2.0}}, error))
      << error;

  const auto json = nlohmann::json::parse (oracle::contentOf (file));
  EXPECT_EQ (input.points->size(), json.at ("points"));
  EXPECT_EQ (1, json.at ("invalid_points"));
  EXPECT_EQ ("faces", json.at ("normals"));
  EXPECT_NEAR (
      mean_spacing, json.at ("mean_spacing").get<double>(), 1e-3 * mean_spacing);
  EXPECT_EQ (24, json.at ("parameters").at ("k"));
  EXPECT_EQ (0.5, json.at ("parameters").at ("M_valley"));
  EXPECT_EQ (12, json.at ("parameters").at ("S_ridge"));
  EXPECT_EQ (2, json.at ("threads"));
  EXPECT_EQ (1.5, json.at ("milliseconds").at ("a"));
  ASSERT_EQ (estimation.getLines().size(), json.at ("lines").size());
  for (const std::string name : {"ridge", "valley"}) {
    const bool ridge = name == "ridge";
    std::array<std::size_t, 6> count{};
    for (const pcl::Label& label : labels)
      ++count.at (label.label);
    EXPECT_EQ (count[ridge ? 1 : 2], json.at (name).at ("crest_points"));
    EXPECT_EQ (count[ridge ? 3 : 4], json.at (name).at ("grown_points"));
    std::size_t lines = 0;
    double length = 0.0;
    for (std::size_t i = 0; i < json.at ("lines").size(); ++i) {
      const auto& line = json.at ("lines")[i];
      const CrestLine& truth = estimation.getLines()[i];
      EXPECT_EQ (truth.type == CrestType::RIDGE ? "ridge" : "valley", line.at ("type"));
      EXPECT_EQ (truth.size, line.at ("size"));
      EXPECT_EQ (truth.length, line.at ("length"));
      EXPECT_EQ (truth.closed, line.at ("closed"));
      if (line.at ("type") == name) {
        ++lines;
        length += line.at ("length").get<double>();
      }
    }
    EXPECT_EQ (lines, json.at (name).at ("lines"));
    EXPECT_NEAR (length, json.at (name).at ("total_length").get<double>(), 1e-9);
    std::size_t large_enough = 0;
    for (const auto& bar : json.at (name).at ("line_sizes_before_S"))
      if (bar.at ("size") >= (ridge ? 12 : 15))
        large_enough += bar.at ("lines").get<std::size_t>();
    EXPECT_EQ (lines, large_enough);
  }
}

TEST_F (IoWriters, StatisticsTellAllOfLines)
{
  InputCloud input;
  // Lines with junctions, closed ones, and some that end where the surface does.
  input.points = oracle::sample (oracle::bumpySphere(), 6000);
  const auto addBeside = [&input] (const oracle::AnalyticSurface& surface, float x) {
    const auto cloud = oracle::sample (surface, 6000);
    for (pcl::PointNormal point : *cloud) {
      point.x += x;
      input.points->push_back (point);
    }
  };
  addBeside (oracle::wavyRidge(), 5.0F);
  addBeside (oracle::ellipticTorus(), -5.0F);
  pcl::CrestLineEstimation<pcl::PointNormal> estimation;
  estimation.setInputCloud (input.points);
  estimation.setLabelBoundaries (true);
  pcl::PointCloud<pcl::Label> labels;
  estimation.compute (labels);
  std::string error;
  const std::string file = directory_.file ("a.json");
  ASSERT_TRUE (writeStatistics (file, input, labels, estimation, {}, error)) << error;

  const auto json = nlohmann::json::parse (oracle::contentOf (file));
  const std::array<std::string, 4> names{"free", "junction", "boundary", "closed"};
  std::set<std::string> found;
  ASSERT_EQ (estimation.getLines().size(), json.at ("lines").size());
  for (std::size_t i = 0; i < json.at ("lines").size(); ++i) {
    const auto& line = json.at ("lines")[i];
    const CrestLine& truth = estimation.getLines()[i];
    EXPECT_EQ (truth.type == CrestType::RIDGE ? "ridge" : "valley", line.at ("type"));
    for (const auto& [name, measure] : measuresOf (truth)) {
      EXPECT_TRUE (name == "type" || name == "closed" || measure == line.at (name))
          << name;
    }
    EXPECT_EQ (truth.closed, line.at ("closed"));
    ASSERT_EQ (truth.ends.size(), line.at ("ends").size());
    for (std::size_t j = 0; j < truth.ends.size(); ++j)
      for (std::size_t end = 0; end < 2; ++end) {
        const std::string name = line.at ("ends")[j][end];
        EXPECT_EQ (names.at (static_cast<std::size_t> (truth.ends[j][end])), name);
        found.insert (name);
      }
  }
  EXPECT_TRUE (found.count ("closed") + found.count ("boundary") == 2);
  const auto boundary =
      std::count_if (labels.begin(), labels.end(), [] (const pcl::Label& label) {
        return label.label == LABEL_BOUNDARY;
      });
  EXPECT_GT (boundary, 0);
  EXPECT_EQ (boundary, json.at ("boundary_points"));
  EXPECT_EQ ("auto", json.at ("parameters").at ("preset"));
  EXPECT_EQ (Parameters().angle, json.at ("parameters").at ("angle"));
  EXPECT_EQ (0, json.at ("parameters").at ("S_ridge"));
  EXPECT_FALSE (json.at ("parameters").contains ("M_ridge"));
}

TEST_F (IoWriters, FilesAreReplacedAsAWholeOrNotAtAll)
{
  std::string error;
  const std::string file = directory_.file ("a.txt", "old");
  ASSERT_TRUE (replaceFile (file, "new", error));
  EXPECT_EQ ("new", oracle::contentOf (file));

  // As on a full disk: no file may grow beyond 4096 bytes.
  rlimit before{};
  getrlimit (RLIMIT_FSIZE, &before);
  rlimit small = before;
  small.rlim_cur = 4096;
  std::signal (SIGXFSZ, SIG_IGN);
  setrlimit (RLIMIT_FSIZE, &small);
  const bool done = replaceFile (file, std::string (100000, 'x'), error);
  setrlimit (RLIMIT_FSIZE, &before);
  EXPECT_FALSE (done);
  EXPECT_EQ (file + ": it cannot be written: File too large", error);
  EXPECT_EQ ("new", oracle::contentOf (file));
  EXPECT_EQ (std::vector<std::string>{"a.txt"}, directory_.names());
}

TEST_F (IoWriters, LinksAreFollowed)
{
  std::string error;
  const std::string file = directory_.file ("a.txt", "old");
  std::filesystem::create_symlink (file, directory_.file ("link.txt"));
  ASSERT_TRUE (replaceFile (directory_.file ("link.txt"), "new", error)) << error;
  EXPECT_EQ ("new", oracle::contentOf (file));
  EXPECT_TRUE (std::filesystem::is_symlink (directory_.file ("link.txt")));
}

TEST_F (IoWriters, LinksThatLeadNowhereStayWhatTheyAre)
{
  std::string error;
  const std::string link = directory_.file ("link.txt");
  std::filesystem::create_symlink ("lost.txt", link);
  for (const bool done :
       {checkWritable (link, error), replaceFile (link, "new", error)}) {
    EXPECT_FALSE (done);
    EXPECT_EQ (link + ": it cannot be written: it is a symbolic link to lost.txt, "
                      "which does not exist",
               error);
  }
  EXPECT_EQ (std::vector<std::string>{"link.txt"}, directory_.names());
}

TEST_F (IoWriters, UnfinishedFilesAreForTheirOwner)
{
  namespace fs = std::filesystem;
  const ::mode_t mask = ::umask (027);
  std::string error;
  {
    OutputGroup group;
    ASSERT_TRUE (replaceFile (directory_.file ("a.txt"), "new", error)) << error;
    const std::vector<std::string> names = directory_.names();
    ASSERT_EQ (1U, names.size());
    EXPECT_EQ (0U, names[0].find (".pcl_crest_"));
    EXPECT_EQ (fs::perms::owner_read | fs::perms::owner_write,
               fs::status (directory_.file (names[0])).permissions());
    ASSERT_TRUE (group.commit (error)) << error;
  }
  ::umask (mask);
  EXPECT_EQ (std::vector<std::string>{"a.txt"}, directory_.names());
  EXPECT_EQ (fs::perms::owner_read | fs::perms::owner_write | fs::perms::group_read,
             fs::status (directory_.file ("a.txt")).permissions());
}

TEST_F (IoWriters, AGroupOfFilesIsReplacedAsAWholeOrNotAtAll)
{
  std::string error;
  const std::string old = directory_.file ("a.txt", "old");
  const std::string added = directory_.file ("b.txt");
  const std::string spoilt = directory_.file ("c.txt");
  const auto write = [&] {
    return replaceFile (old, "new", error) && replaceFile (added, "new", error) &&
           replaceFile (spoilt, "new", error);
  };
  {
    OutputGroup never_committed;
    ASSERT_TRUE (write()) << error;
  }
  EXPECT_EQ (std::vector<std::string>{"a.txt"}, directory_.names());
  {
    OutputGroup group;
    ASSERT_TRUE (write()) << error;
    // What can be found out before, is; this comes after that.
    std::filesystem::create_directory (spoilt);
    EXPECT_FALSE (group.commit (error));
  }
  EXPECT_EQ (spoilt + ": it cannot be written: Is a directory", error);
  EXPECT_EQ ("old", oracle::contentOf (old));
  EXPECT_EQ ((std::vector<std::string>{"a.txt", "c.txt"}), directory_.names());

  std::filesystem::remove (spoilt);
  OutputGroup group;
  ASSERT_TRUE (write()) << error;
  EXPECT_EQ ("old", oracle::contentOf (old));
  ASSERT_TRUE (group.commit (error)) << error;
  EXPECT_EQ ((std::vector<std::string>{"a.txt", "b.txt", "c.txt"}), directory_.names());
  EXPECT_EQ ("new", oracle::contentOf (old));
}

TEST_F (IoWriters, SignalsLeaveNothingUnfinished)
{
  const std::string file = directory_.file ("a.txt", "old");
  for (const int signal : {SIGHUP, SIGINT, SIGTERM}) {
    const ::pid_t child = ::fork();
    if (child == 0) {
      cleanUpOnSignals();
      OutputGroup group;
      std::string error;
      const bool done = replaceFile (file, "new", error) &&
                        replaceFile (directory_.file ("b.txt"), "new", error);
      if (done)
        std::raise (signal);
      ::_exit (1);
    }
    int status = 0;
    ASSERT_EQ (child, ::waitpid (child, &status, 0));
    ASSERT_TRUE (WIFSIGNALED (status));
    EXPECT_EQ (signal, WTERMSIG (status));
    EXPECT_EQ (std::vector<std::string>{"a.txt"}, directory_.names());
    EXPECT_EQ ("old", oracle::contentOf (file));
  }
}

TEST_F (IoWriters, WhatCannotBeWrittenIsNamed)
{
  const std::string lost = directory_.file ("no/such/a.pcd");
  const std::string directory = directory_.file ("d.pcd");
  std::filesystem::create_directory (directory);
  std::string error;
  EXPECT_FALSE (checkWritable (lost, error));
  EXPECT_EQ (lost + ": it cannot be written: No such file or directory", error);
  pcl::PointCloud<pcl::Label> labels;
  pcl::PointCloud<pcl::PrincipalCurvatures> curvatures;
  labels.resize (cloud_.size());
  curvatures.resize (cloud_.size());
  EXPECT_FALSE (writeLabels (lost, input(), labels, curvatures, {}, error));
  EXPECT_EQ (lost + ": it cannot be written: No such file or directory", error);
  EXPECT_FALSE (checkWritable (directory, error));
  EXPECT_EQ (directory + ": it cannot be written: it is a directory", error);
  EXPECT_FALSE (checkWritable ("/dev/full", error));
  EXPECT_FALSE (checkWritable ("", error));
  EXPECT_EQ ("\"\": it cannot be written: it has no name", error);
  EXPECT_TRUE (checkWritable (directory_.file ("new.pcd"), error)) << error;
  EXPECT_EQ (std::vector<std::string>{"d.pcd"}, directory_.names());

  EXPECT_FALSE (writeLines (directory_.file ("a.stl"), cloud_, lines_, error));
  EXPECT_EQ (0U, error.find (directory_.file ("a.stl")));
  EXPECT_FALSE (hasExtension ("a.kml", lineExtensions(), error));
  EXPECT_EQ ("a.kml: the extension must be .obj, .ply, .vtk, .vtp, .dxf, .geojson, "
             ".csv, .gpkg or .shp",
             error);
}

} // namespace
