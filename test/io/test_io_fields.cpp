// SPDX-License-Identifier: BSD-3-Clause
// What a file has of its points comes out again with their labels: read by PCL, by VTK,
// and number by number.
#include <pcl_crest/io/write_labels.h>

#include <pcl/io/pcd_io.h>
#include <pcl/io/ply_io.h>

#include <gtest/gtest.h>

#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPLYReader.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataWriter.h>
#include <vtkUnsignedCharArray.h>
#include <vtkXMLPolyDataWriter.h>

#include "support/las_file.h"
#include "support/temporary_directory.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <random>
#include <sstream>

using namespace pcl::crest;

namespace {

template <typename T>
T
numberAt (const std::string& text, std::size_t byte)
{
  T number;
  std::memcpy (&number, text.data() + byte, sizeof (T));
  return number;
}

template <typename T>
std::string
bytesOf (T number)
{
  return {reinterpret_cast<const char*> (&number), sizeof (T)};
}

class IoFields : public testing::Test {
protected:
  static constexpr std::size_t SIZE = 50;

  const oracle::TemporaryDirectory directory_;

  static InputCloud
  read (const std::string& file, const ReadOptions& options = {})
  {
    InputCloud cloud;
    std::string error;
    EXPECT_TRUE (readCloud (file, 12, 1, cloud, error, options)) << error;
    return cloud;
  }

  /** \brief Writes a cloud with labels that count, and two lines. */
  std::string
  write (const InputCloud& cloud, const std::string& name) const
  {
    pcl::PointCloud<pcl::Label> labels;
    pcl::PointCloud<pcl::PrincipalCurvatures> curvatures;
    labels.resize (cloud.points->size());
    curvatures.resize (cloud.points->size());
    for (std::size_t i = 0; i < labels.size(); ++i) {
      labels[i].label = i % 7;
      curvatures[i].pc1 = -0.5F * static_cast<float> (i);
    }
    std::vector<CrestLine> lines (3);
    lines[0].polylines = {{3, 4, 5}};
    lines[0].strength = 0.25;
    lines[1].polylines = {{9, 8}, {8, 4}};
    lines[1].strength = 2.5;
    lines[2].polylines = {{8, 7}};
    lines[2].strength = 1.0;
    std::string error;
    EXPECT_TRUE (
        writeLabels (directory_.file (name), cloud, labels, curvatures, lines, error))
        << error;
    return directory_.file (name);
  }

  static std::int32_t
  lineAt (std::size_t i)
  {
    return i == 3 || i == 5 ? 0 : i == 4 || i == 8 || i == 9 ? 1 : i == 7 ? 2 : -1;
  }

  static float
  strengthAt (std::size_t i)
  {
    const std::map<std::int32_t, float> strengths{
        {-1, 0.0F}, {0, 0.25F}, {1, 2.5F}, {2, 1.0F}};
    return strengths.at (lineAt (i));
  }
};

template <typename T>
T
valueOf (const pcl::PCLPointCloud2& cloud,
         const std::string& name,
         std::size_t i,
         std::size_t number = 0)
{
  const int place = pcl::getFieldIndex (cloud, name);
  EXPECT_GE (place, 0) << name;
  if (place < 0)
    return {};
  T value;
  std::memcpy (&value,
               cloud.data.data() + i * cloud.point_step + cloud.fields[place].offset +
                   number * sizeof (T),
               sizeof (T));
  return value;
}

/** \brief Points with a field of each type, two of which have names of our own, a color
 * and one of three numbers; as a PCD file declares them.
 */
pcl::PCLPointCloud2
cloudOfAllTypes (std::size_t size, bool normals)
{
  using Field = pcl::PCLPointField;
  pcl::PCLPointCloud2 cloud;
  const std::vector<std::pair<std::string, std::uint8_t>> fields{
      {"x", Field::FLOAT32},
      {"ring", Field::UINT16},
      {"y", Field::FLOAT32},
      {"z", Field::FLOAT32},
      {"intensity", Field::FLOAT32},
      {"time", Field::FLOAT64},
      {"label", Field::UINT32},
      {"small", Field::INT8},
      {"byte", Field::UINT8},
      {"short", Field::INT16},
      {"strength", Field::INT32},
      {"rgb", Field::FLOAT32},
      {"three", Field::FLOAT32},
      {"normal_x", Field::FLOAT32},
      {"normal_y", Field::FLOAT32},
      {"normal_z", Field::FLOAT32}};
  for (std::size_t i = 0; i < fields.size() - (normals ? 0 : 3); ++i) {
    Field field;
    field.name = fields[i].first;
    field.datatype = fields[i].second;
    field.count = field.name == "three" ? 3 : 1;
    field.offset = cloud.point_step;
    cloud.point_step += field.count * pcl::getFieldSize (field.datatype);
    cloud.fields.push_back (field);
  }
  cloud.width = static_cast<std::uint32_t> (size);
  cloud.height = 1;
  cloud.row_step = cloud.point_step * cloud.width;
  cloud.data.resize (cloud.row_step);
  std::mt19937 random (7);
  for (std::size_t i = 0; i < size; ++i)
    for (const Field& field : cloud.fields) {
      std::uint8_t* const to = &cloud.data[i * cloud.point_step + field.offset];
      const auto put = [to] (std::size_t place, auto number) {
        std::memcpy (to + place * sizeof (number), &number, sizeof (number));
      };
      const auto n = static_cast<float> (random() % 1000);
      if (field.name == "rgb")
        put (0, static_cast<std::uint32_t> (random() % 0x1000000U));
      else if (field.name.find ("normal") == 0)
        put (0, field.name == "normal_z" ? 1.0F : 0.0F);
      else if (field.datatype == Field::FLOAT32)
        for (std::size_t j = 0; j < field.count; ++j)
          put (j, 0.1F * n + static_cast<float> (j));
      else if (field.datatype == Field::FLOAT64)
        put (0, 1.6e9 + 1e-6 * n);
      else
        for (int j = 0; j < pcl::getFieldSize (field.datatype); ++j)
          to[j] = static_cast<std::uint8_t> (random());
    }
  return cloud;
}

TEST_F (IoFields, OfPcd)
{
  for (const bool normals : {true, false})
    for (const std::string coding : {"ascii", "binary", "compressed"}) {
      SCOPED_TRACE (coding);
      const pcl::PCLPointCloud2 input = cloudOfAllTypes (SIZE, normals);
      const std::string file = directory_.file ("a.pcd");
      pcl::PCDWriter writer;
      const Eigen::Vector4f origin = Eigen::Vector4f::Zero();
      const Eigen::Quaternionf turned = Eigen::Quaternionf::Identity();
      if (coding == "ascii")
        writer.writeASCII (file, input, origin, turned, 17);
      else if (coding == "binary")
        writer.writeBinary (file, input, origin, turned);
      else
        writer.writeBinaryCompressed (file, input, origin, turned);
      const InputCloud cloud = read (file);
      EXPECT_TRUE (std::find (cloud.notes.begin(),
                              cloud.notes.end(),
                              "The fields label, strength of the file are written as "
                              "input_label, input_strength: labelled points have their "
                              "own of these names.") != cloud.notes.end());
      pcl::PCLPointCloud2 output;
      ASSERT_EQ (0, pcl::io::loadPCDFile (write (cloud, "o.pcd"), output));
      EXPECT_EQ ("x y z normal_x normal_y normal_z curvature label line strength ring "
                 "intensity time input_label small byte short input_strength rgb three",
                 pcl::getFieldsList (output));
      for (std::size_t i = 0; i < SIZE; ++i) {
        ASSERT_EQ (i % 7, valueOf<std::uint32_t> (output, "label", i));
        ASSERT_EQ (-0.5F * static_cast<float> (i),
                   valueOf<float> (output, "curvature", i));
        ASSERT_EQ (lineAt (i), valueOf<std::int32_t> (output, "line", i));
        ASSERT_EQ (strengthAt (i), valueOf<float> (output, "strength", i));
        for (const pcl::PCLPointField& field : input.fields) {
          const bool is_ours = field.name == "label" || field.name == "strength";
          const int place =
              pcl::getFieldIndex (output, (is_ours ? "input_" : "") + field.name);
          ASSERT_GE (place, 0) << field.name;
          // PCL's text has the bits of colors as whole numbers.
          ASSERT_TRUE (field.datatype == output.fields[place].datatype ||
                       field.name == "rgb")
              << field.name;
          ASSERT_EQ (field.count, output.fields[place].count);
          ASSERT_EQ (
              0,
              std::memcmp (
                  &input.data[i * input.point_step + field.offset],
                  &output.data[i * output.point_step + output.fields[place].offset],
                  std::size_t (field.count) *
                      static_cast<std::size_t> (pcl::getFieldSize (field.datatype))))
              << field.name << " of point " << i;
        }
      }
    }
}

TEST_F (IoFields, OutputsAreReadAsInputs)
{
  const pcl::PCLPointCloud2 input = cloudOfAllTypes (SIZE, true);
  pcl::PCDWriter().writeBinary (directory_.file ("a.pcd"), input);
  const InputCloud first = read (directory_.file ("a.pcd"));
  for (const std::string extension : {".pcd", ".ply", ".las"}) {
    const InputCloud second = read (write (first, "o" + extension));
    EXPECT_EQ (NormalSource::FILE, second.normals);
    ASSERT_EQ (SIZE, second.points->size());
    for (std::size_t i = 0; i < SIZE; ++i)
      ASSERT_LE (
          ((*first.points)[i].getVector3fMap() - (*second.points)[i].getVector3fMap())
              .norm(),
          1e-6F);
    EXPECT_EQ (first.colors, second.colors);
    std::vector<std::string> names;
    for (const FileFields::Field& field : second.fields.fields)
      names.push_back (field.name);
    // Twice renamed, and not lost.
    for (const char* const name :
         {"input_curvature", "input_line", "input_input_label", "input_label", "ring"})
      EXPECT_EQ (1, std::count (names.begin(), names.end(), name)) << name << extension;
  }
}

/** \brief A PLY file whose vertices have numbers of all types, in any coding. */
std::string
plyOfAllTypes (const std::string& coding, std::size_t size)
{
  std::ostringstream text;
  text << "ply\nformat " << coding << " 1.0\nelement vertex " << size
       << "\nproperty float x\nproperty float y\nproperty float z\n"
          "property uchar red\nproperty uchar green\nproperty uchar blue\n"
          "property uchar alpha\nproperty list uchar int near\n"
          "property short scalar_Return\nproperty double GpsTime\nproperty int line\n"
          "end_header\n";
  text.precision (17);
  const auto add = [&] (auto number) {
    if (coding == "ascii") {
      text << +number << ' ';
      return;
    }
    std::string bytes = bytesOf (number);
    if (coding == "binary_big_endian")
      std::reverse (bytes.begin(), bytes.end());
    text << bytes;
  };
  for (std::size_t i = 0; i < size; ++i) {
    for (const std::size_t x : {i % 7, i / 7, i * i % 11})
      add (static_cast<float> (x));
    for (const std::size_t c : {i, 2 * i, std::size_t (9), 255 - i})
      add (static_cast<std::uint8_t> (c));
    add (std::uint8_t (2));
    add (std::int32_t (1));
    add (std::int32_t (2));
    add (static_cast<std::int16_t> (i - 30));
    add (3e8 + 1e-6 * static_cast<double> (i));
    add (static_cast<std::int32_t> (-1000000 * static_cast<int> (i)));
    if (coding == "ascii")
      text << '\n';
  }
  return text.str();
}

TEST_F (IoFields, OfPly)
{
  for (const std::string coding :
       {"ascii", "binary_little_endian", "binary_big_endian"}) {
    SCOPED_TRACE (coding);
    const InputCloud cloud =
        read (directory_.file ("a.ply", plyOfAllTypes (coding, SIZE)));
    EXPECT_TRUE (std::find (cloud.notes.begin(),
                            cloud.notes.end(),
                            "The list near of the vertices is left out.") !=
                 cloud.notes.end());
    const std::string file = write (cloud, "o.ply");
    pcl::PCLPointCloud2 output;
    ASSERT_EQ (0, pcl::io::loadPLYFile (file, output));
    for (std::size_t i = 0; i < SIZE; ++i) {
      ASSERT_EQ ((*cloud.points)[i].x, valueOf<float> (output, "x", i));
      ASSERT_EQ ((*cloud.points)[i].normal_z, valueOf<float> (output, "normal_z", i));
      ASSERT_EQ (i % 7, valueOf<std::uint32_t> (output, "label", i));
      ASSERT_EQ (lineAt (i), valueOf<std::int32_t> (output, "line", i));
      ASSERT_EQ (strengthAt (i), valueOf<float> (output, "strength", i));
      ASSERT_EQ (static_cast<std::int16_t> (i - 30),
                 valueOf<std::int16_t> (output, "scalar_Return", i));
      ASSERT_EQ (3e8 + 1e-6 * static_cast<double> (i),
                 valueOf<double> (output, "GpsTime", i));
      ASSERT_EQ (-1000000 * static_cast<int> (i),
                 valueOf<std::int32_t> (output, "input_line", i));
      const auto c = static_cast<std::uint32_t> (i);
      ASSERT_EQ ((255 - c) << 24U | c << 16U | 2 * c << 8U | 9U,
                 valueOf<std::uint32_t> (output, "rgba", i));
    }
    // As pcl_viewer shows colors of PCD files.
    ASSERT_EQ (0, pcl::io::loadPCDFile (write (cloud, "o.pcd"), output));
    pcl::PointCloud<pcl::PointXYZRGB> colored;
    ASSERT_EQ (0, pcl::io::loadPCDFile (directory_.file ("o.pcd"), colored));
    EXPECT_EQ (-1, pcl::getFieldIndex (output, "red"));
    for (std::size_t i = 0; i < SIZE; ++i) {
      ASSERT_EQ (i, colored[i].r);
      ASSERT_EQ (2 * i, colored[i].g);
      ASSERT_EQ (255 - i, valueOf<std::uint8_t> (output, "alpha", i));
    }
  }
}

TEST_F (IoFields, PlyShowsLabelsByColors)
{
  std::string text;
  for (std::size_t i = 0; i < SIZE; ++i)
    text += std::to_string (i % 7) + " " + std::to_string (i / 7) + " " +
            std::to_string (i * i % 11) + "\n";
  const std::string file = write (read (directory_.file ("a.xyz", text)), "o.ply");
  vtkNew<vtkPLYReader> reader;
  reader->SetFileName (file.c_str());
  reader->Update();
  auto* const colors = vtkUnsignedCharArray::SafeDownCast (
      reader->GetOutput()->GetPointData()->GetScalars());
  ASSERT_NE (nullptr, colors);
  ASSERT_EQ (static_cast<vtkIdType> (SIZE), colors->GetNumberOfTuples());
  EXPECT_EQ (70, colors->GetComponent (LABEL_RIDGE, 0));
  EXPECT_EQ (240, colors->GetComponent (LABEL_RIDGE, 2));
  EXPECT_EQ (240, colors->GetComponent (LABEL_VALLEY, 0));
  EXPECT_EQ (217, colors->GetComponent (LABEL_NONE, 1));
}

TEST_F (IoFields, OfText)
{
  std::string text = "//X;Y;Z;Intensity;Gps Time;R;G;B;Name\n";
  for (std::size_t i = 0; i < SIZE; ++i)
    text += std::to_string (i % 7) + ";" + std::to_string (i / 7) + ";" +
            std::to_string (i * i % 11) + ";" + std::to_string (i) + ".5;" +
            (i == 4 ? "" : "1600000000." + std::to_string (100 + i)) + ";1;2;" +
            std::to_string (i + 3) + ";p" + std::to_string (i) + "\n";
  pcl::PCLPointCloud2 output;
  const InputCloud cloud = read (directory_.file ("a.txt", text));
  ASSERT_EQ (0, pcl::io::loadPCDFile (write (cloud, "o.pcd"), output));
  EXPECT_EQ ("x y z normal_x normal_y normal_z curvature label line strength rgb "
             "Intensity Gps_Time",
             pcl::getFieldsList (output));
  for (std::size_t i = 0; i < SIZE; ++i) {
    ASSERT_EQ (static_cast<float> (i) + 0.5F, valueOf<float> (output, "Intensity", i));
    const double time = valueOf<double> (output, "Gps_Time", i);
    ASSERT_TRUE (i == 4 ? std::isnan (time)
                        : time == 1600000000.1 + 0.001 * static_cast<double> (i) ||
                              std::abs (time - 1600000000.1 -
                                        0.001 * static_cast<double> (i)) < 1e-6);
    ASSERT_EQ (0x010200U + 3U + i, valueOf<std::uint32_t> (output, "rgb", i));
  }
  ReadOptions options;
  options.columns = {"x", "y", "z", "intensity", "-"};
  const std::string rows = "1 2 3 4 5\n2 3 4 5 6\n2 2 4 8 6\n0 0 0 0 0\n";
  const InputCloud named = read (directory_.file ("a.xyz", rows), options);
  ASSERT_EQ (1U, named.fields.fields.size());
  EXPECT_EQ ("intensity", named.fields.fields[0].name);
  EXPECT_EQ (16U, named.fields.records.size());
}

TEST_F (IoFields, SamplesOfFacesHaveNone)
{
  const std::string text =
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
      "property float z\nproperty int id\nelement face 4\n"
      "property list uchar int vertex_indices\nend_header\n"
      "0 0 0 1\n1 0 0 2\n0 1 0 3\n0 0 1 4\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";
  const InputCloud cloud = read (directory_.file ("a.ply", text));
  ASSERT_GT (cloud.points->size(), 4U);
  EXPECT_TRUE (cloud.fields.fields.empty());
  EXPECT_TRUE (cloud.fields.records.empty());
}

oracle::LasFile
lasExample (unsigned minor, unsigned format)
{
  oracle::LasFile las;
  las.minor = minor;
  las.format = format;
  las.offset = {690000.0, 5335000.0, 500.0};
  las.extra = {{"Amplitude", 9}, {"label", 3}};
  std::mt19937 random (format);
  for (unsigned i = 0; i < 50; ++i) {
    oracle::LasPoint point;
    for (std::int32_t& x : point.position)
      x = static_cast<std::int32_t> (random() % 4000000) - 2000000;
    point.intensity = static_cast<std::uint16_t> (random());
    point.return_number = 1 + i % 3;
    point.returns = 3;
    point.code = i % 20;
    point.user_data = static_cast<std::uint8_t> (random());
    point.source = static_cast<std::uint16_t> (random());
    point.time = 2.5e8 + 1e-6 * i;
    for (std::uint16_t& channel : point.color)
      channel = static_cast<std::uint16_t> (random());
    point.infrared = static_cast<std::uint16_t> (random());
    point.extra = bytesOf (0.1F * static_cast<float> (i)) +
                  bytesOf (static_cast<std::uint16_t> (i));
    las.points.push_back (point);
  }
  return las;
}

TEST_F (IoFields, OfLas)
{
  for (const auto& [minor, format] :
       {std::pair<unsigned, unsigned>{2, 1}, {3, 3}, {4, 6}, {4, 7}, {4, 8}}) {
    SCOPED_TRACE (format);
    const oracle::LasFile las = lasExample (minor, format);
    const InputCloud cloud = read (directory_.file ("a.las", las.bytes()));
    const std::string text = oracle::contentOf (write (cloud, "o.las"));
    // The header, as the tables of the specification have it.
    const bool has_colors = format == 3 || format >= 7;
    const std::size_t base = format == 8 ? 38 : has_colors ? 36 : 30;
    constexpr std::size_t NUMBERS = 3 + 4 + 2;
    const std::size_t size = base + 12 + 16 + 4 + 2;
    EXPECT_EQ ("LASF", text.substr (0, 4));
    EXPECT_EQ (17, numberAt<std::uint16_t> (text, 6));
    EXPECT_EQ (1, text[24]);
    EXPECT_EQ (4, text[25]);
    EXPECT_EQ (375, numberAt<std::uint16_t> (text, 94));
    const auto first = numberAt<std::uint32_t> (text, 96);
    EXPECT_EQ (375 + 54 + 192 * NUMBERS, first);
    EXPECT_EQ (1U, numberAt<std::uint32_t> (text, 100));
    EXPECT_EQ (format == 8 ? 8 : has_colors ? 7 : 6, text[104]);
    EXPECT_EQ (size, numberAt<std::uint16_t> (text, 105));
    EXPECT_EQ (0U, numberAt<std::uint32_t> (text, 107));
    EXPECT_EQ (50U, numberAt<std::uint64_t> (text, 247));
    EXPECT_EQ (17U, numberAt<std::uint64_t> (text, 255));
    EXPECT_EQ (17U, numberAt<std::uint64_t> (text, 263));
    EXPECT_EQ (16U, numberAt<std::uint64_t> (text, 271));
    ASSERT_EQ (first + 50 * size, text.size());
    for (std::size_t axis = 0; axis < 3; ++axis) {
      EXPECT_EQ (0.001, numberAt<double> (text, 131 + 8 * axis));
      EXPECT_EQ (las.offset[axis], numberAt<double> (text, 155 + 8 * axis));
      const auto [least, most] = std::minmax_element (
          las.points.begin(), las.points.end(), [axis] (const auto& a, const auto& b) {
            return a.position[axis] < b.position[axis];
          });
      EXPECT_EQ (0.001 * most->position[axis] + las.offset[axis],
                 numberAt<double> (text, 179 + 16 * axis));
      EXPECT_EQ (0.001 * least->position[axis] + las.offset[axis],
                 numberAt<double> (text, 187 + 16 * axis));
    }
    EXPECT_EQ ("LASF_Spec", std::string (text.c_str() + 375 + 2));
    EXPECT_EQ (4, numberAt<std::uint16_t> (text, 375 + 18));
    EXPECT_EQ (192 * NUMBERS, numberAt<std::uint16_t> (text, 375 + 20));
    std::vector<std::string> names;
    std::vector<int> types;
    for (std::size_t i = 0; i < NUMBERS; ++i) {
      names.emplace_back (text.c_str() + 375 + 54 + 192 * i + 4);
      types.push_back (text[375 + 54 + 192 * i + 2]);
    }
    EXPECT_EQ ((std::vector<std::string>{"normal_x",
                                         "normal_y",
                                         "normal_z",
                                         "curvature",
                                         "label",
                                         "line",
                                         "strength",
                                         "Amplitude",
                                         "input_label"}),
               names);
    EXPECT_EQ ((std::vector<int>{9, 9, 9, 9, 5, 6, 9, 9, 3}), types);

    for (std::size_t i = 0; i < 50; ++i) {
      const oracle::LasPoint& point = las.points[i];
      const std::size_t at = first + i * size;
      for (std::size_t axis = 0; axis < 3; ++axis)
        ASSERT_EQ (point.position[axis], numberAt<std::int32_t> (text, at + 4 * axis));
      ASSERT_EQ (point.intensity, numberAt<std::uint16_t> (text, at + 12));
      ASSERT_EQ (point.return_number | point.returns << 4U,
                 numberAt<std::uint8_t> (text, at + 14));
      ASSERT_EQ (0, text[at + 15]);
      ASSERT_EQ (point.code, numberAt<std::uint8_t> (text, at + 16));
      ASSERT_EQ (point.user_data, numberAt<std::uint8_t> (text, at + 17));
      ASSERT_EQ (point.source, numberAt<std::uint16_t> (text, at + 20));
      ASSERT_EQ (point.time, numberAt<double> (text, at + 22));
      for (std::size_t c = 0; c < 3 && has_colors; ++c)
        ASSERT_EQ (point.color[c], numberAt<std::uint16_t> (text, at + 30 + 2 * c));
      ASSERT_TRUE (format != 8 ||
                   point.infrared == numberAt<std::uint16_t> (text, at + 36));
      const std::size_t extra = at + base + 12;
      ASSERT_EQ (-0.5F * static_cast<float> (i), numberAt<float> (text, extra));
      ASSERT_EQ (i % 7, numberAt<std::uint32_t> (text, extra + 4));
      ASSERT_EQ (lineAt (i), numberAt<std::int32_t> (text, extra + 8));
      ASSERT_EQ (strengthAt (i), numberAt<float> (text, extra + 12));
      ASSERT_EQ (point.extra, text.substr (extra + 16, 6));
    }

    // As PCD, by their names.
    pcl::PCLPointCloud2 output;
    ASSERT_EQ (0, pcl::io::loadPCDFile (write (cloud, "o.pcd"), output));
    for (std::size_t i = 0; i < 50; ++i) {
      const oracle::LasPoint& point = las.points[i];
      ASSERT_EQ (0.001 * point.position[0] + las.offset[0],
                 valueOf<double> (output, "x", i));
      ASSERT_EQ (point.intensity, valueOf<std::uint16_t> (output, "intensity", i));
      ASSERT_EQ (point.return_number,
                 valueOf<std::uint8_t> (output, "return_number", i));
      ASSERT_EQ (point.code, valueOf<std::uint8_t> (output, "classification", i));
      ASSERT_EQ (point.time, valueOf<double> (output, "gps_time", i));
      ASSERT_EQ (i, valueOf<std::uint16_t> (output, "input_label", i));
    }

    // As PLY, with bytes under the names that programs know.
    ASSERT_EQ (0, pcl::io::loadPLYFile (write (cloud, "o.ply"), output));
    for (std::size_t i = 0; i < 50 && has_colors; ++i) {
      const auto& color = las.points[i].color;
      ASSERT_EQ (color[0], valueOf<std::uint16_t> (output, "input_red", i));
      ASSERT_EQ ((color[0] >> 8U) << 16U | (color[1] >> 8U) << 8U | color[2] >> 8U,
                 valueOf<std::uint32_t> (output, "rgb", i) & 0xFFFFFFU);
    }
  }
}

TEST_F (IoFields, LasFromOtherFormats)
{
  std::string text;
  for (std::size_t i = 0; i < SIZE; ++i)
    text += std::to_string (i % 7) + " " + std::to_string (i / 7) + " " +
            (i == 6 ? "nan" : std::to_string (i * i % 11)) + " 1 2 255\n";
  ReadOptions options;
  options.columns = {"x", "y", "z", "r", "g", "b"};
  const InputCloud cloud = read (directory_.file ("a.xyz", text), options);
  const std::string written = oracle::contentOf (write (cloud, "o.las"));
  EXPECT_EQ (16, numberAt<std::uint16_t> (written, 6));
  const auto first = numberAt<std::uint32_t> (written, 96);
  const auto size = numberAt<std::uint16_t> (written, 105);
  EXPECT_EQ (7, written[104]);
  EXPECT_EQ (36 + 12 + 16, size);
  for (std::size_t i = 0; i < SIZE; ++i) {
    const std::size_t at = first + i * size;
    // The only return; what has no position is withheld.
    EXPECT_EQ (0x11, written[at + 14]);
    EXPECT_EQ (i == 6 ? 4 : 0, written[at + 15]);
    for (std::size_t axis = 0; axis < 3 && i != 6; ++axis)
      EXPECT_NEAR ((*cloud.points)[i].data[axis],
                   numberAt<double> (written, 131 + 8 * axis) *
                           numberAt<std::int32_t> (written, at + 4 * axis) +
                       numberAt<double> (written, 155 + 8 * axis),
                   1e-8);
    EXPECT_EQ (257, numberAt<std::uint16_t> (written, at + 30));
    EXPECT_EQ (65535, numberAt<std::uint16_t> (written, at + 34));
  }
}

TEST_F (IoFields, TooManyForLas)
{
  InputCloud cloud;
  cloud.points.reset (new pcl::PointCloud<pcl::PointNormal>);
  cloud.points->resize (1);
  cloud.fields.fields = {{"histogram", 'F', 4, 400, 0}};
  cloud.fields.record_size = 1600;
  cloud.fields.records.resize (1600);
  pcl::PointCloud<pcl::Label> labels;
  labels.resize (1);
  pcl::PointCloud<pcl::PrincipalCurvatures> curvatures;
  curvatures.resize (1);
  std::string error;
  const std::string file = directory_.file ("o.las");
  EXPECT_FALSE (writeLabels (file, cloud, labels, curvatures, {}, error));
  EXPECT_EQ (file + ": each point has 407 numbers beside those of LAS, and 1658 bytes, "
                    "but LAS files have at most 341 and 65535: write .pcd or .ply",
             error);
  EXPECT_TRUE (directory_.names().empty());
  EXPECT_FALSE (
      writeLabels (directory_.file ("o.txt"), cloud, labels, curvatures, {}, error));
  EXPECT_EQ (directory_.file ("o.txt") + ": the extension must be .pcd, .ply or .las",
             error);
}

/** \brief The labelled points of a file, as PCL reads them. */
pcl::PCLPointCloud2
byPcl (const std::string& file)
{
  pcl::PCLPointCloud2 cloud;
  EXPECT_EQ (0, pcl::io::loadPCDFile (file, cloud));
  return cloud;
}

std::array<unsigned, 3>
colorAt (const pcl::PCLPointCloud2& cloud, std::size_t i)
{
  const auto rgb = valueOf<std::uint32_t> (cloud, "rgb", i);
  return {rgb >> 16U & 0xFFU, rgb >> 8U & 0xFFU, rgb & 0xFFU};
}

TEST_F (IoFields, OfObj)
{
  std::string bytes;
  std::string parts;
  std::string some;
  for (unsigned i = 0; i < SIZE; ++i) {
    const std::string place =
        "v " + std::to_string (i % 7) + " " + std::to_string (i / 7) + " 0";
    bytes += place + " " + std::to_string (5 * i) + " 0 255\n";
    parts += place + " " + std::to_string (i / 49.0) + " 0 1\n";
    some += place + (i == 3 ? " 0 0 1\n" : "\n");
  }
  pcl::PCLPointCloud2 cloud =
      byPcl (write (read (directory_.file ("a.obj", bytes)), "a.pcd"));
  for (unsigned i = 0; i < SIZE; ++i)
    EXPECT_EQ ((std::array<unsigned, 3>{5 * i, 0, 255}), colorAt (cloud, i));
  cloud = byPcl (write (read (directory_.file ("b.obj", parts)), "b.pcd"));
  for (unsigned i = 0; i < SIZE; ++i)
    EXPECT_EQ ((std::array<unsigned, 3>{
                   static_cast<unsigned> (std::lround (i / 49.0 * 255.0)), 0, 255}),
               colorAt (cloud, i));
  const InputCloud without = read (directory_.file ("c.obj", some));
  EXPECT_TRUE (without.colors.empty());
  EXPECT_EQ ("Only 1 of 50 vertices have colors: these are not used.",
             without.notes.front());
}

TEST_F (IoFields, OfPtx)
{
  std::string text = "5\n10\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n"
                     "1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n";
  for (unsigned i = 0; i < SIZE; ++i)
    text += std::to_string (i % 5 + 1) + " " + std::to_string (i / 5) + " 0 " +
            std::to_string (i / 64.0) + " " + std::to_string (i) + " 7 9\n";
  const InputCloud input = read (directory_.file ("a.ptx", text));
  const pcl::PCLPointCloud2 cloud = byPcl (write (input, "a.pcd"));
  vtkNew<vtkPLYReader> reader;
  reader->SetFileName (write (input, "a.ply").c_str());
  reader->Update();
  vtkDataArray* const colors = reader->GetOutput()->GetPointData()->GetScalars();
  ASSERT_NE (nullptr, colors);
  for (unsigned i = 0; i < SIZE; ++i) {
    EXPECT_EQ (static_cast<float> (i) / 64.0F, valueOf<float> (cloud, "intensity", i));
    EXPECT_EQ ((std::array<unsigned, 3>{i, 7, 9}), colorAt (cloud, i));
    EXPECT_EQ (i, colors->GetComponent (i, 0));
  }
}

/** \brief Points with arrays of VTK: three bytes or four, a number, three, normals. */
vtkSmartPointer<vtkPolyData>
vtkExample (std::size_t size, int channels)
{
  const auto points = vtkSmartPointer<vtkPoints>::New();
  const auto colors = vtkSmartPointer<vtkUnsignedCharArray>::New();
  const auto numbers = vtkSmartPointer<vtkIntArray>::New();
  const auto flow = vtkSmartPointer<vtkFloatArray>::New();
  const auto normals = vtkSmartPointer<vtkFloatArray>::New();
  colors->SetName ("paint");
  colors->SetNumberOfComponents (channels);
  numbers->SetName ("number");
  flow->SetName ("flow");
  flow->SetNumberOfComponents (3);
  normals->SetName ("Normals");
  normals->SetNumberOfComponents (3);
  for (std::size_t i = 0; i < size; ++i) {
    const auto number = static_cast<int> (i);
    const int row = number / 7;
    points->InsertNextPoint (number % 7, row, 0.0);
    for (int c = 0; c < channels; ++c)
      colors->InsertNextValue (static_cast<unsigned char> (number + c));
    numbers->InsertNextValue (-number);
    flow->InsertNextTuple3 (number, 0.5 * number, -number);
    normals->InsertNextTuple3 (0.0, 0.0, 1.0);
  }
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints (points);
  data->GetPointData()->SetScalars (colors);
  data->GetPointData()->AddArray (numbers);
  data->GetPointData()->SetVectors (flow);
  data->GetPointData()->SetNormals (normals);
  return data;
}

void
expectVtkExample (const InputCloud& input, const std::string& written, int channels)
{
  EXPECT_EQ (NormalSource::FILE, input.normals);
  const pcl::PCLPointCloud2 cloud = byPcl (written);
  for (const char* const unwanted : {"paint", "Normals"})
    EXPECT_EQ (-1, pcl::getFieldIndex (cloud, unwanted));
  EXPECT_EQ (channels == 4, pcl::getFieldIndex (cloud, "alpha") >= 0);
  ASSERT_EQ (input.points->size(), cloud.width * cloud.height);
  for (unsigned i = 0; i < input.points->size(); ++i) {
    ASSERT_EQ ((std::array<unsigned, 3>{i, i + 1, i + 2}), colorAt (cloud, i));
    if (channels == 4) {
      ASSERT_EQ (i + 3, valueOf<std::uint8_t> (cloud, "alpha", i));
    }
    ASSERT_EQ (-static_cast<std::int32_t> (i),
               valueOf<std::int32_t> (cloud, "number", i));
    const auto number = static_cast<float> (i);
    ASSERT_EQ (number, valueOf<float> (cloud, "flow", i, 0));
    ASSERT_EQ (0.5F * number, valueOf<float> (cloud, "flow", i, 1));
    ASSERT_EQ (-number, valueOf<float> (cloud, "flow", i, 2));
  }
}

TEST_F (IoFields, OfVtk)
{
  for (const int channels : {3, 4})
    for (const bool binary : {false, true})
      for (const int version : {vtkPolyDataWriter::VTK_LEGACY_READER_VERSION_4_2,
                                vtkPolyDataWriter::VTK_LEGACY_READER_VERSION_5_1}) {
        SCOPED_TRACE (testing::Message()
                      << channels << " channels, binary " << binary << ", " << version);
        const std::string file = directory_.file ("a.vtk");
        vtkNew<vtkPolyDataWriter> writer;
        writer->SetInputData (vtkExample (SIZE, channels));
        writer->SetFileName (file.c_str());
        writer->SetFileVersion (version);
        if (binary)
          writer->SetFileTypeToBinary();
        writer->Write();
        const InputCloud input = read (file);
        expectVtkExample (input, write (input, "a.pcd"), channels);
      }
}

TEST_F (IoFields, OfVtp)
{
  for (const int channels : {3, 4})
    for (const int mode :
         {vtkXMLWriter::Ascii, vtkXMLWriter::Binary, vtkXMLWriter::Appended}) {
      SCOPED_TRACE (testing::Message() << channels << " channels, mode " << mode);
      const std::string file = directory_.file ("a.vtp");
      vtkNew<vtkXMLPolyDataWriter> writer;
      writer->SetInputData (vtkExample (SIZE, channels));
      writer->SetFileName (file.c_str());
      writer->SetDataMode (mode);
      writer->Write();
      const InputCloud input = read (file);
      expectVtkExample (input, write (input, "a.pcd"), channels);
    }
}

// Of several pieces what all of them have, by name, type and numbers a point.
TEST_F (IoFields, OfPiecesOfVtp)
{
  std::string text = "<VTKFile type=\"PolyData\"><PolyData>";
  for (int piece = 0; piece < 2; ++piece) {
    text += "<Piece NumberOfPoints=\"25\"><Points><DataArray type=\"Float32\" "
            "NumberOfComponents=\"3\" format=\"ascii\">";
    for (int i = 0; i < 25; ++i)
      text += std::to_string (i % 5) + " " + std::to_string (i / 5 + 5 * piece) + " 0 ";
    text += "</DataArray></Points><PointData><DataArray type=\"Int32\" Name=\"kept\" "
            "format=\"ascii\">";
    for (int i = 0; i < 25; ++i)
      text += std::to_string (100 * piece + i) + " ";
    text += std::string ("</DataArray><DataArray type=\"") +
            (piece == 0 ? "Int32" : "Float32") + "\" Name=\"other\" format=\"ascii\">";
    for (int i = 0; i < 25; ++i)
      text += "1 ";
    text += "</DataArray></PointData></Piece>";
  }
  text += "</PolyData></VTKFile>";
  const pcl::PCLPointCloud2 cloud =
      byPcl (write (read (directory_.file ("a.vtp", text)), "a.pcd"));
  EXPECT_EQ (-1, pcl::getFieldIndex (cloud, "other"));
  for (int i = 0; i < 50; ++i)
    EXPECT_EQ (i < 25 ? i : 75 + i,
               valueOf<std::int32_t> (cloud, "kept", static_cast<std::size_t> (i)));
}

} // namespace
