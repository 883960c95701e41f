// SPDX-License-Identifier: BSD-3-Clause
// LAS files of all versions and point formats, written number by number.
#include <pcl_crest/io/read_cloud.h>
#include <pcl_crest/io/write_labels.h>

#include <gtest/gtest.h>

#include "support/las_file.h"
#include "support/temporary_directory.h"

#include <cmath>
#include <random>

using namespace pcl::crest;

namespace {

template <typename T>
std::string
bytesOf (std::initializer_list<T> numbers)
{
  return {reinterpret_cast<const char*> (numbers.begin()), numbers.size() * sizeof (T)};
}

class IoLas : public testing::Test {
protected:
  const oracle::TemporaryDirectory directory_;

  static oracle::LasFile
  example (unsigned minor, unsigned format)
  {
    oracle::LasFile file;
    file.minor = minor;
    file.format = format;
    std::mt19937 random (format);
    for (unsigned i = 0; i < 60; ++i) {
      oracle::LasPoint point;
      for (std::int32_t& x : point.position)
        x = static_cast<std::int32_t> (random() % 100000) - 50000;
      point.code = i % 3 + 1;
      const auto c = static_cast<std::uint16_t> (i);
      point.color = {static_cast<std::uint16_t> (256 * c),
                     static_cast<std::uint16_t> (257 * c),
                     0};
      file.points.push_back (point);
    }
    return file;
  }

  InputCloud
  read (const oracle::LasFile& las, const ReadOptions& options = {}) const
  {
    InputCloud cloud;
    std::string error;
    EXPECT_TRUE (readCloud (
        directory_.file ("a.las", las.bytes()), 12, 1, cloud, error, options))
        << error;
    if (!cloud.points)
      cloud.points.reset (new pcl::PointCloud<pcl::PointNormal>);
    return cloud;
  }

  static Eigen::Vector3d
  positionOf (const oracle::LasFile& las, std::size_t i)
  {
    Eigen::Vector3d position;
    for (std::size_t axis = 0; axis < 3; ++axis)
      position[static_cast<int> (axis)] =
          las.points[i].position[axis] * las.scale[axis] + las.offset[axis];
    return position;
  }

  /** \brief The message on a file that must be refused, without its name. */
  std::string
  refusal (const std::string& name,
           const std::string& content,
           const ReadOptions& options = {}) const
  {
    const std::string file = directory_.file (name, content);
    InputCloud cloud;
    std::string error;
    EXPECT_FALSE (readCloud (file, 12, 1, cloud, error, options)) << name;
    EXPECT_EQ (0U, error.find (file + ": ")) << error;
    return error.substr (std::min (error.size(), file.size() + 2));
  }
};

TEST_F (IoLas, AllVersionsAndPointFormats)
{
  for (unsigned minor = 0; minor <= 4; ++minor)
    for (unsigned format = 0; format <= 10; ++format) {
      SCOPED_TRACE (testing::Message() << "1." << minor << ", format " << format);
      const oracle::LasFile las = example (minor, format);
      const InputCloud cloud = read (las);
      ASSERT_EQ (las.points.size(), cloud.points->size());
      for (std::size_t i = 0; i < las.points.size(); ++i)
        ASSERT_EQ (positionOf (las, i).cast<float>(),
                   (*cloud.points)[i].getVector3fMap());
      const bool has_colors = format == 2 || format == 3 || format == 5 ||
                              format == 7 || format == 8 || format == 10;
      ASSERT_EQ (has_colors ? las.points.size() : 0, cloud.colors.size());
      for (std::size_t i = 0; i < cloud.colors.size(); ++i)
        for (std::size_t c = 0; c < 3; ++c)
          ASSERT_EQ (las.points[i].color[c] >> 8U, cloud.colors[i][c]);
    }
}

TEST_F (IoLas, ColorsOfEightBits)
{
  oracle::LasFile las = example (2, 2);
  for (oracle::LasPoint& point : las.points)
    point.color = {255, 7, 0};
  const std::array<unsigned char, 3> color{255, 7, 0};
  EXPECT_EQ (color, read (las).colors.at (0));
}

TEST_F (IoLas, MapCoordinatesKeepTheirDigits)
{
  oracle::LasFile las = example (4, 6);
  las.offset = {690000.0, 5335000.0, 512.25};
  las.scale = {0.001, 0.002, 0.001};
  const InputCloud cloud = read (las);
  EXPECT_FALSE (cloud.placement.offset.isZero (0.0));
  for (std::size_t i = 0; i < las.points.size(); ++i)
    ASSERT_LE ((positionOf (las, i) -
                cloud.placement.toFile ((*cloud.points)[i].getVector3fMap()))
                   .norm(),
               1e-4);
}

TEST_F (IoLas, ClassesArePicked)
{
  for (const unsigned format : {1U, 7U}) {
    oracle::LasFile las = example (4, format);
    // Bits beside the class, which mean that a point is synthetic or withheld.
    if (format == 1)
      for (oracle::LasPoint& point : las.points)
        point.code |= 0xA0U;
    else
      las.points[0].code = 33;
    ReadOptions options;
    options.classes = {3, 2};
    const InputCloud cloud = read (las, options);
    ASSERT_EQ (40U, cloud.points->size());
    EXPECT_EQ ("40 of 60 points have the classes 2, 3 and are read.",
               cloud.notes.front());
    EXPECT_EQ (positionOf (las, 2).cast<float>(), (*cloud.points)[1].getVector3fMap());
    EXPECT_EQ (format == 7 ? 40U : 0U, cloud.colors.size());
    options.classes = {9};
    EXPECT_EQ ("none of its 60 points has the class 9 of -class: there are 1, 2, 3" +
                   std::string (format == 7 ? ", 33" : ""),
               refusal ("a.las", las.bytes(), options));
    EXPECT_EQ ("it has no classes that -class could pick: LAS files have, but xyz "
               "files do not",
               refusal ("a.xyz", "0 0 0\n", options));
  }
}

TEST_F (IoLas, NormalsAmongExtraBytes)
{
  oracle::LasFile las = example (4, 6);
  las.extra = {
      {"label", 1}, {"NormalX", 9}, {"NormalY", 10}, {"NormalZ", 4, 24, .25, 1}};
  for (oracle::LasPoint& point : las.points)
    point.extra = bytesOf<std::uint8_t> ({9}) + bytesOf<float> ({0.6F}) +
                  bytesOf<double> ({0.8}) + bytesOf<std::int16_t> ({-4});
  const InputCloud cloud = read (las);
  EXPECT_EQ (NormalSource::FILE, cloud.normals);
  for (const pcl::PointNormal& point : *cloud.points)
    ASSERT_EQ (Eigen::Vector3f (0.6F, 0.8F, 0.0F), point.getNormalVector3fMap());
}

const oracle::LasRecord GEO_KEYS{
    "LASF_Projection", 34735, "GeoTIFF keys", bytesOf<std::uint16_t> ({1, 1, 0, 0})};
const oracle::LasRecord GEO_DOUBLES{
    "LASF_Projection", 34736, "", bytesOf<double> ({9.0, 0.9996})};
const oracle::LasRecord GEO_TEXT{"LASF_Projection", 34737, "text", "UTM 32|"};
const oracle::LasRecord WKT{"LASF_Projection", 2112, "OGC WKT", "PROJCRS[\"UTM 32\"]"};
const oracle::LasRecord OTHER{"somebody", 2112, "", "else"};

/** \brief The labelled points of a file as LAS again. */
std::string
writtenAgain (const oracle::TemporaryDirectory& directory, const InputCloud& cloud)
{
  const std::size_t size = cloud.points->size();
  pcl::PointCloud<pcl::Label> labels;
  pcl::PointCloud<pcl::PrincipalCurvatures> curvatures;
  labels.resize (size);
  curvatures.resize (size);
  std::string error;
  EXPECT_TRUE (
      writeLabels (directory.file ("b.las"), cloud, labels, curvatures, {}, error))
      << error;
  return oracle::contentOf (directory.file ("b.las"));
}

TEST_F (IoLas, CoordinateSystemsAreKept)
{
  constexpr unsigned WKT_BIT = 16;
  constexpr std::size_t ENCODING = 6;
  const std::vector<oracle::LasRecord> geo_tiff{GEO_KEYS, GEO_DOUBLES, GEO_TEXT};
  oracle::LasFile las = example (2, 1);
  las.records = {GEO_KEYS, OTHER, GEO_DOUBLES, GEO_TEXT};
  std::string text = writtenAgain (directory_, read (las));
  std::vector<oracle::LasRecord> records = oracle::lasRecordsOf (text);
  ASSERT_EQ (4U, records.size());
  EXPECT_EQ (geo_tiff,
             std::vector<oracle::LasRecord> (records.begin() + 1, records.end()));
  EXPECT_EQ (0, text[ENCODING] & WKT_BIT);

  las = example (4, 6);
  las.records = {WKT};
  text = writtenAgain (directory_, read (las));
  EXPECT_EQ (WKT, oracle::lasRecordsOf (text).back());
  EXPECT_EQ (WKT_BIT, text[ENCODING] & WKT_BIT);
  // And what was written is read again, all points of it.
  const oracle::TemporaryDirectory other;
  InputCloud again;
  std::string error;
  ASSERT_TRUE (readCloud (other.file ("b.las", text), 12, 1, again, error)) << error;
  ASSERT_EQ (las.points.size(), again.points->size());
  for (std::size_t i = 0; i < las.points.size(); ++i)
    EXPECT_EQ (positionOf (las, i).cast<float>(), (*again.points)[i].getVector3fMap());

  las.records.clear();
  las.extended = {OTHER, WKT};
  text = writtenAgain (directory_, read (las));
  EXPECT_EQ (WKT, oracle::lasRecordsOf (text).back());
}

TEST_F (IoLas, PointsDoNotNeedTheRecordsBehindThem)
{
  oracle::LasFile las = example (4, 6);
  las.extended = {WKT, OTHER};
  const std::string text = las.bytes();
  std::string error;
  for (const std::size_t cut : {std::size_t (1), OTHER.data.size() + 1}) {
    InputCloud cloud;
    ASSERT_TRUE (
        readCloud (directory_.file ("a.las", text.substr (0, text.size() - cut)),
                   12,
                   1,
                   cloud,
                   error))
        << error;
    EXPECT_EQ (las.points.size(), cloud.points->size());
    EXPECT_EQ ("The file ends within its extended variable length records: 1 of them "
               "are not read.",
               cloud.notes.front());
    EXPECT_EQ (1U, cloud.placement.crs_records.size());
  }
}

TEST_F (IoLas, WaveformsAreSaidToBeLost)
{
  for (unsigned format = 0; format <= 10; ++format) {
    const InputCloud cloud = read (example (4, format));
    const bool has = format == 4 || format == 5 || format == 9 || format == 10;
    EXPECT_EQ (has,
               cloud.notes.front() == "Its waveforms (point format " +
                                          std::to_string (format) +
                                          ") are not read, and are in none of the "
                                          "outputs.");
  }
}

TEST_F (IoLas, LiesAreNamedWithTheirByte)
{
  oracle::LasFile las = example (4, 6);
  las.extra = {{"a", 4}};
  for (oracle::LasPoint& point : las.points)
    point.extra = "ab";
  const std::string good = las.bytes();
  const auto with = [&good] (std::size_t byte, const std::string& bytes) {
    std::string text = good;
    return text.replace (byte, bytes.size(), bytes);
  };
  const auto expect = [this] (const std::string& text, const std::string& message) {
    EXPECT_EQ (message, refusal ("a.las", text));
  };
  expect ("LASSO" + good.substr (5),
          "byte 0: expected \"LASF\", which LAS files begin with, found \"LASS\"");
  expect (good.substr (0, 100),
          "byte 100: the file ends within its header, which has at least 227 bytes");
  expect (with (25, "\5"), "byte 24: the version is 1.5, but 1.0 to 1.4 are read");
  expect (
      with (94, bytesOf<std::uint16_t> ({227})),
      "byte 94: the header has 227 bytes, but that of version 1.4 has at least 375, "
      "and the file has 2541");
  expect (with (104, "\x0b"),
          "byte 104: the point format is 11, but must be one of 0 to 10");
  expect (with (105, bytesOf<std::uint16_t> ({20})),
          "byte 105: points have 20 bytes, but those of format 6 have at least 30");
  expect (
      with (96, bytesOf<std::uint32_t> ({4000000000})),
      "byte 96: points begin at byte 4000000000, but must do so behind the header of "
      "375 bytes and within the file of 2541");
  expect (with (247, bytesOf<std::uint64_t> ({1ULL << 60U})),
          "byte 247: the header announces 1152921504606846976 points of 32 bytes each, "
          "but there is room for 60 between byte 621 and the end of the file, 2541");
  expect (with (247, bytesOf<std::uint64_t> ({0})), "it has no points");
  expect (with (131, bytesOf<double> ({0.0})),
          "byte 131: a scale of coordinates is 0.000000, but must be finite and not 0");
  expect (with (163, bytesOf<double> ({HUGE_VAL})),
          "byte 163: an offset of coordinates is inf, but must be finite");
  expect (
      with (100, bytesOf<std::uint32_t> ({4000000000})),
      "byte 621: variable length record 2 of 4000000000 ends behind the start of the "
      "points, byte 621");
  expect (
      with (375 + 20, bytesOf<std::uint16_t> ({5000})),
      "byte 375: variable length record 1 of 1 ends behind the start of the points, "
      "byte 621");
  expect (with (375 + 54 + 2, bytesOf<std::uint8_t> ({31})),
          "byte 431: the type of extra bytes is 31, but must be one of 0 to 30");
  expect (with (375 + 54 + 2, bytesOf<std::uint8_t> ({30})),
          "byte 429: the extra bytes \"a\" end behind the 32 bytes of a point");
  expect (with (375 + 54 + 2, bytesOf<std::uint16_t> ({0xFF00})),
          "byte 429: the extra bytes \"a\" end behind the 32 bytes of a point");
}

TEST_F (IoLas, WhateverIsCutOrChangedIsReadOrRefused)
{
  oracle::LasFile las = example (4, 7);
  las.extra = {{"a", 4}};
  for (oracle::LasPoint& point : las.points)
    point.extra = "ab";
  const std::string good = las.bytes();
  for (std::size_t size = 0; size < good.size(); ++size)
    refusal ("a.las", good.substr (0, size));
  std::mt19937 random (1);
  for (int i = 0; i < 300; ++i) {
    std::string text = good;
    for (int j = 0; j < 3; ++j)
      text[random() % 700] = static_cast<char> (random());
    InputCloud cloud;
    std::string error;
    const bool is_read =
        readCloud (directory_.file ("a.las", text), 12, 1, cloud, error);
    ASSERT_EQ (is_read, error.empty());
  }
}

TEST_F (IoLas, WhatIsNotReadTellsHowToConvertIt)
{
  const auto names = [] (const std::string& text, const std::string& part) {
    EXPECT_NE (std::string::npos, text.find (part)) << text;
  };
  oracle::LasFile las = example (4, 6);
  std::string laz = las.bytes();
  laz[104] = static_cast<char> (128 + 6);
  for (const char* const name : {"scan.laz", "scan.las"}) {
    const std::string message = refusal (name, laz);
    names (message, "it is a LAZ file, whose points are compressed");
    names (message, "pdal translate \"" + directory_.file (name) + "\" \"scan.las\"");
    names (message, "laszip -i");
    names (message, "CloudCompare");
  }
  las.extra = {{"a", 4}};
  std::string copc = las.bytes();
  copc[104] = static_cast<char> (128 + 6);
  copc.replace (375 + 2, 16, std::string ("copc") + std::string (12, '\0'));
  names (refusal ("scan.copc.laz", copc), "it is a COPC file");
  names (refusal ("scan.copc.laz", copc), "\"scan.las\"");
  names (refusal ("scan.e57", "ASTM-E57..."), "it is an E57 file, which is not read");
  names (refusal ("scan.e57", "ASTM-E57..."), "pdal translate");
  // By its name, whatever is in it, but LAS is read under any name.
  names (refusal ("scan.laz", "nothing of the kind"), "it is a LAZ file");
  ReadOptions options;
  options.format = "las";
  InputCloud cloud;
  std::string error;
  EXPECT_TRUE (readCloud (directory_.file ("scan.laz", example (2, 0).bytes()),
                          12,
                          1,
                          cloud,
                          error,
                          options))
      << error;
}

} // namespace
