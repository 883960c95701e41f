// SPDX-License-Identifier: BSD-3-Clause
// Files of maps, read back by GDAL.
#include <pcl_crest/io/write_lines.h>

#include <gtest/gtest.h>

#include "io/output_file.h"
#include "support/temporary_directory.h"
#include <gdal_priv.h>
#include <nlohmann/json.hpp>
#include <ogrsf_frmts.h>

#include <filesystem>
#include <memory>
#include <random>

using namespace pcl::crest;

namespace {

using DataSet = std::unique_ptr<GDALDataset, decltype (&GDALClose)>;
using Polyline = std::vector<std::array<double, 3>>;

DataSet
open (const std::string& file)
{
  GDALAllRegister();
  DataSet data (GDALDataset::Open (file.c_str(), GDAL_OF_VECTOR), &GDALClose);
  EXPECT_NE (nullptr, data) << file;
  return data;
}

std::vector<Polyline>
polylinesOf (const OGRGeometry& geometry)
{
  std::vector<Polyline> polylines;
  const auto add = [&polylines] (const OGRLineString& line) {
    EXPECT_TRUE (line.Is3D());
    Polyline& polyline = polylines.emplace_back();
    for (const OGRPoint& point : line)
      polyline.push_back ({point.getX(), point.getY(), point.getZ()});
  };
  if (wkbFlatten (geometry.getGeometryType()) == wkbLineString)
    add (*geometry.toLineString());
  else
    for (const OGRLineString* const line : *geometry.toMultiLineString())
      add (*line);
  return polylines;
}

/** \brief The number of the EPSG that GDAL finds in a file; empty if there is none. */
std::string
crsOf (const std::string& file)
{
  const DataSet data = open (file);
  const OGRSpatialReference* const reference = data->GetLayer (0)->GetSpatialRef();
  if (reference == nullptr ||
      reference->GetName() == std::string ("Undefined Cartesian SRS"))
    return {};
  const std::unique_ptr<OGRSpatialReference> known (reference->Clone());
  known->AutoIdentifyEPSG();
  const char* const code = known->GetAuthorityCode (nullptr);
  return code == nullptr ? "?" : code;
}

class IoMaps : public testing::TestWithParam<std::string> {
protected:
  const oracle::TemporaryDirectory directory_;
  pcl::PointCloud<pcl::PointNormal> cloud_;
  std::vector<CrestLine> lines_;
  Placement placement_;

  IoMaps()
  {
    std::mt19937 random (1);
    std::uniform_real_distribution<float> place (-100.0F, 100.0F);
    for (int i = 0; i < 200; ++i)
      cloud_.push_back ({place (random), place (random), place (random)});
    for (int i = 0; i < 12; ++i) {
      CrestLine line;
      line.type = i % 3 == 0 ? CrestType::VALLEY : CrestType::RIDGE;
      line.closed = i % 4 == 0;
      for (int p = 0; p <= i % 3; ++p) {
        std::vector<pcl::index_t>& polyline = line.polylines.emplace_back();
        for (int j = 0; j <= 1 + i; ++j)
          polyline.push_back ((17 * i + 31 * p + 7 * j) % 200);
        if (line.closed)
          polyline.push_back (polyline.front());
        line.ends.push_back ({LineEnd::FREE, LineEnd::FREE});
        line.size += polyline.size();
      }
      line.length = place (random);
      line.strength = 1e6 + place (random);
      line.mean_curvature = 1e-3 * place (random);
      line.turning_angle = place (random);
      line.scale = place (random);
      line.sign_trust = 1.0 / (i + 1);
      lines_.push_back (line);
    }
    placement_.offset = {565000.0, 5930000.0, 0.0};
  }

  std::string
  written (const std::string& name, const std::string& crs = {})
  {
    std::string file = directory_.file (name);
    std::string error;
    EXPECT_TRUE (writeLines (file, cloud_, lines_, error, placement_, crs)) << error;
    return file;
  }
};

std::string
nameOfCase (const testing::TestParamInfo<std::string>& parameter)
{
  return parameter.param.substr (1);
}

TEST_P (IoMaps, AreReadByGdal)
{
  const bool is_shapefile = GetParam() == ".shp";
  const std::map<std::string, double (*) (const CrestLine&)> measures{
      {"length", [] (const CrestLine& l) { return l.length; }},
      {"strength", [] (const CrestLine& l) { return l.strength; }},
      {is_shapefile ? "mean_curv" : "mean_curvature",
       [] (const CrestLine& l) { return l.mean_curvature; }},
      {is_shapefile ? "turn_angle" : "turning_angle",
       [] (const CrestLine& l) { return l.turning_angle; }},
      {"scale", [] (const CrestLine& l) { return l.scale; }},
      {"sign_trust", [] (const CrestLine& l) { return l.sign_trust; }}};
  const DataSet data = open (written ("a" + GetParam(), "EPSG:25832"));
  ASSERT_NE (nullptr, data);
  ASSERT_EQ (1, data->GetLayerCount());
  OGRLayer* const layer = data->GetLayer (0);
  ASSERT_EQ (static_cast<GIntBig> (lines_.size()), layer->GetFeatureCount());
  std::size_t i = 0;
  for (const auto& feature : *layer) {
    const CrestLine& line = lines_[i];
    EXPECT_EQ (static_cast<int> (i), feature->GetFieldAsInteger ("id"));
    EXPECT_STREQ (line.type == CrestType::RIDGE ? "ridge" : "valley",
                  feature->GetFieldAsString ("type"));
    EXPECT_EQ (static_cast<int> (line.size), feature->GetFieldAsInteger ("size"));
    EXPECT_EQ (line.closed ? 1 : 0, feature->GetFieldAsInteger ("closed"));
    for (const auto& [name, measure] : measures) {
      ASSERT_GE (feature->GetFieldIndex (name.c_str()), 0) << name;
      EXPECT_NEAR (measure (line),
                   feature->GetFieldAsDouble (name.c_str()),
                   is_shapefile ? 1e-9 : 0.0)
          << name;
    }
    std::vector<Polyline> expected;
    for (const std::vector<pcl::index_t>& polyline : line.polylines) {
      expected.emplace_back();
      for (const pcl::index_t point : polyline) {
        const pcl::PointNormal& p = cloud_[point];
        expected.back().push_back ({565000.0 + p.x, 5930000.0 + p.y, 1.0 * p.z});
      }
    }
    EXPECT_EQ (expected, polylinesOf (*feature->GetGeometryRef())) << i;
    ++i;
  }
}

TEST_P (IoMaps, KnowTheirCoordinateSystem)
{
  EXPECT_EQ ("25832", crsOf (written ("a" + GetParam(), "EPSG:25832")));
  EXPECT_EQ ("4326", crsOf (written ("d" + GetParam(), "EPSG:4326")));
  EXPECT_EQ ("", crsOf (written ("n" + GetParam())));
}

// What lay beside it with another system must not be taken for the new file's.
TEST_P (IoMaps, ForgetTheSystemOfTheFileThatWasThere)
{
  written ("a" + GetParam(), "EPSG:25832");
  EXPECT_EQ ("", crsOf (written ("a" + GetParam())));
}

TEST_P (IoMaps, MayBeEmpty)
{
  lines_.clear();
  const DataSet data = open (written ("e" + GetParam()));
  EXPECT_EQ (0, data->GetLayer (0)->GetFeatureCount());
}

TEST_P (IoMaps, AllFilesAreThereOrNone)
{
  const std::string file = directory_.file ("b" + GetParam());
  const std::vector<std::string> files = lineFiles (file);
  std::filesystem::create_directory (files.back());
  std::string error;
  EXPECT_FALSE (writeLines (file, cloud_, lines_, error, placement_));
  EXPECT_EQ (files.back() + ": it cannot be written: it is a directory", error);
  for (std::size_t i = 0; i + 1 < files.size(); ++i)
    EXPECT_FALSE (std::filesystem::exists (files[i]));
  std::filesystem::remove (files.back());
  written ("b" + GetParam());
  std::size_t there = 0;
  for (const auto& entry : std::filesystem::directory_iterator (
           std::filesystem::path (file).parent_path())) {
    EXPECT_NE (files.end(),
               std::find (files.begin(), files.end(), entry.path().string()));
    ++there;
  }
  EXPECT_EQ (files.size(), there);
}

TEST_P (IoMaps, RefuseCoordinateSystemsThatThereAreNot)
{
  for (const char* const crs :
       {"EPSG:99999", "EPSG:", "25832", "EPSG:25832x", "epsg:25832", "EPSG:-1", "x"}) {
    std::string error;
    const std::string file = directory_.file ("a" + GetParam());
    EXPECT_FALSE (checkLines (file, crs, error)) << crs;
    EXPECT_EQ (0U, error.find (file + ": ")) << error;
    EXPECT_NE (std::string::npos, error.find (crs)) << error;
    EXPECT_FALSE (writeLines (file, cloud_, lines_, error, placement_, crs));
    EXPECT_FALSE (std::filesystem::exists (file));
  }
}

INSTANTIATE_TEST_SUITE_P (Formats,
                          IoMaps,
                          testing::Values (".gpkg", ".shp"),
                          nameOfCase);

TEST_F (IoMaps, GeoJsonNamesItsCoordinateSystem)
{
  EXPECT_EQ ("25832", crsOf (written ("a.geojson", "EPSG:25832")));
  // RFC 7946 has no other than that of longitude and latitude, which needs no name.
  const std::string file = written ("d.geojson", "EPSG:4326");
  EXPECT_FALSE (nlohmann::json::parse (oracle::contentOf (file)).contains ("crs"));
}

TEST_F (IoMaps, OtherFormatsHaveNoCoordinateSystem)
{
  for (const std::string& extension : lineExtensions()) {
    const bool has =
        extension == ".geojson" || extension == ".gpkg" || extension == ".shp";
    std::string error;
    EXPECT_TRUE (checkLines ("a" + extension, "", error)) << error;
    EXPECT_EQ (has, checkLines ("a" + extension, "EPSG:25832", error)) << extension;
  }
}

} // namespace
