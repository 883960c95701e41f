// SPDX-License-Identifier: BSD-3-Clause
// GeoPackage and Shapefile through GDAL.
#include "io/map_module.h"

#include <pcl_crest/types.h>

#include <gdal_priv.h>
#include <ogrsf_frmts.h>

#include <algorithm>
#include <cstdint>
#include <memory>

namespace pcl {
namespace crest {

namespace {

/** \brief Keeps to itself what GDAL says, which is told as an error of ours. */
class QuietErrors {
public:
  QuietErrors()
  {
    CPLErrorReset();
    CPLPushErrorHandler (&CPLQuietErrorHandler);
  }
  QuietErrors (const QuietErrors&) = delete;
  QuietErrors&
  operator= (const QuietErrors&) = delete;
  ~QuietErrors() { CPLPopErrorHandler(); }

  static std::string
  last ()
  {
    const std::string said = CPLGetLastErrorMsg();
    return said.empty() ? "GDAL does not say why" : "GDAL says: " + said;
  }
};

/** \brief A folder of GDAL's in memory, which is gone with this. */
class MemoryFolder {
public:
  MemoryFolder()
  : path_ ("/vsimem/pcl_crest_" +
           std::to_string (reinterpret_cast<std::uintptr_t> (this)))
  {}
  MemoryFolder (const MemoryFolder&) = delete;
  MemoryFolder&
  operator= (const MemoryFolder&) = delete;
  ~MemoryFolder() { VSIRmdirRecursive (path_.c_str()); }

  std::string
  file (const std::string& extension) const
  {
    return path_ + "/crest_lines" + extension;
  }

  MapFiles
  take () const
  {
    MapFiles files;
    const CPLStringList names (VSIReadDir (path_.c_str()));
    for (int i = 0; i < names.size(); ++i) {
      const std::string name = names[i];
      const std::size_t dot = name.rfind ('.');
      ::vsi_l_offset size = 0;
      const GByte* const bytes =
          VSIGetMemFileBuffer ((path_ + "/" + name).c_str(), &size, FALSE);
      if (dot != std::string::npos && bytes != nullptr)
        files.emplace_back (name.substr (dot),
                            std::string (reinterpret_cast<const char*> (bytes), size));
    }
    return files;
  }

private:
  std::string path_;
};

/** \brief x is east and y north, whatever order the definition of a system has. */
bool
setCrs (const std::string& crs, OGRSpatialReference& reference)
{
  reference.SetAxisMappingStrategy (OAMS_TRADITIONAL_GIS_ORDER);
  return reference.SetFromUserInput (crs.c_str()) == OGRERR_NONE;
}

/** \brief What GeoPackages have where no coordinate system is known. Without it GDAL
 * takes that of unknown latitudes and longitudes.
 */
constexpr char UNKNOWN_CRS[] =
    R"(LOCAL_CS["Undefined Cartesian SRS",LOCAL_DATUM["unknown",32767],)"
    R"(UNIT["metre",1],AXIS["X",EAST],AXIS["Y",NORTH]])";

std::string
explainCrs (const std::string& crs)
{
  const QuietErrors quiet;
  OGRSpatialReference reference;
  return setCrs (crs, reference)
             ? std::string()
             : "there is no coordinate system " + crs + ": " + QuietErrors::last();
}

bool
addColumns (const MapLayer& layer, bool short_names, OGRLayer& to)
{
  OGRFieldDefn id ("id", OFTInteger64);
  OGRFieldDefn type ("type", OFTString);
  type.SetWidth (6);
  bool done =
      to.CreateField (&id) == OGRERR_NONE && to.CreateField (&type) == OGRERR_NONE;
  for (const MapColumn& column : layer.columns) {
    OGRFieldDefn field ((short_names ? column.short_name : column.name).c_str(),
                        column.whole ? OFTInteger64 : OFTReal);
    // As many digits before the point as there are behind it by default.
    if (short_names && !column.whole) {
      field.SetWidth (32);
      field.SetPrecision (15);
    }
    done = done && to.CreateField (&field) == OGRERR_NONE;
  }
  return done;
}

bool
addFeatures (const MapLayer& layer, OGRLayer& to)
{
  for (std::size_t i = 0; i < layer.features.size(); ++i) {
    const MapFeature& line = layer.features[i];
    const std::unique_ptr<OGRFeature> feature (
        OGRFeature::CreateFeature (to.GetLayerDefn()));
    int field = 0;
    feature->SetField (field++, static_cast<GIntBig> (i));
    feature->SetField (field++, line.type.c_str());
    for (std::size_t c = 0; c < layer.columns.size(); ++c)
      if (layer.columns[c].whole)
        feature->SetField (field++, static_cast<GIntBig> (line.numbers[c]));
      else
        feature->SetField (field++, line.numbers[c]);
    OGRMultiLineString polylines;
    polylines.set3D (TRUE);
    for (const std::vector<Eigen::Vector3d>& places : line.polylines) {
      auto polyline = std::make_unique<OGRLineString>();
      polyline->setNumPoints (static_cast<int> (places.size()), FALSE);
      for (std::size_t p = 0; p < places.size(); ++p)
        polyline->setPoint (
            static_cast<int> (p), places[p].x(), places[p].y(), places[p].z());
      polylines.addGeometryDirectly (polyline.release());
    }
    feature->SetGeometry (&polylines);
    if (to.CreateFeature (feature.get()) != OGRERR_NONE)
      return false;
  }
  return true;
}

std::string
write (const std::string& extension, const MapLayer& layer, MapFiles& files)
{
  const QuietErrors quiet;
  GDALAllRegister();
  const bool is_shapefile = extension == ".shp";
  const char* const name = is_shapefile ? "ESRI Shapefile" : "GPKG";
  GDALDriver* const driver = GetGDALDriverManager()->GetDriverByName (name);
  if (driver == nullptr)
    return std::string ("GDAL was built without its driver ") + name;
  OGRSpatialReference reference;
  if (!setCrs (layer.crs.empty() ? UNKNOWN_CRS : layer.crs, reference))
    return explainCrs (layer.crs);
  const MemoryFolder folder;
  using DataSet = std::unique_ptr<GDALDataset, decltype (&GDALClose)>;
  DataSet data (
      driver->Create (folder.file (extension).c_str(), 0, 0, 0, GDT_Unknown, nullptr),
      &GDALClose);
  if (data == nullptr)
    return QuietErrors::last();
  const bool has_crs = !is_shapefile || !layer.crs.empty();
  CPLStringList options;
  if (is_shapefile)
    options.SetNameValue ("ENCODING", "UTF-8");
  OGRLayer* const to = data->CreateLayer ("crest_lines",
                                          has_crs ? &reference : nullptr,
                                          wkbMultiLineString25D,
                                          options.List());
  const bool done = to != nullptr && addColumns (layer, is_shapefile, *to) &&
                    data->StartTransaction() != OGRERR_FAILURE &&
                    addFeatures (layer, *to) &&
                    data->CommitTransaction() != OGRERR_FAILURE;
  if (!done)
    return QuietErrors::last();
  data.reset();
  if (CPLGetLastErrorType() == CE_Failure)
    return QuietErrors::last();
  files = folder.take();
  return {};
}

} // namespace

extern "C" PCL_CREST_EXPORT const MapModule pcl_crest_map_module;
const MapModule pcl_crest_map_module{&explainCrs, &write};

} // namespace crest
} // namespace pcl
