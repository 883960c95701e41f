// SPDX-License-Identifier: BSD-3-Clause
#include "io/map_file.h"

#include <boost/algorithm/string/predicate.hpp>

#include <dlfcn.h>

#include <algorithm>

namespace pcl {
namespace crest {

namespace {

/** \brief The module, or why it is not there. */
struct Loaded {
  const MapModule* module = nullptr;
  std::string failure;
};

Loaded
load ()
{
#ifdef PCL_CREST_MAP_MODULE
  // It stays as long as the program does, as GDAL keeps what it has registered.
  void* const library = ::dlopen (PCL_CREST_MAP_MODULE, RTLD_NOW | RTLD_LOCAL);
  if (library != nullptr)
    if (void* const symbol = ::dlsym (library, MAP_MODULE_SYMBOL))
      return {static_cast<const MapModule*> (symbol), {}};
  const char* const failure = ::dlerror();
  return {nullptr,
          std::string ("the module for them cannot be loaded: ") +
              (failure == nullptr ? PCL_CREST_MAP_MODULE : failure)};
#else
  return {nullptr,
          "this program was built without GDAL: install libgdal-dev and build it anew"};
#endif
}

const Loaded&
loaded ()
{
  static const Loaded result = load();
  return result;
}

} // namespace

bool
isMapFile (const std::string& extension)
{
  return extension == ".gpkg" || extension == ".shp";
}

std::string
explainNoMaps ()
{
  return loaded().module != nullptr
             ? std::string()
             : "GeoPackages and shapefiles are written through GDAL, but " +
                   loaded().failure +
                   ", or write .geojson, which ogr2ogr makes these of";
}

std::string
explainCrs (const std::string& crs)
{
  constexpr char AUTHORITY[] = "EPSG:";
  constexpr std::size_t MOST_DIGITS = 9;
  const std::string code = crs.substr (std::min (crs.size(), sizeof (AUTHORITY) - 1));
  if (!boost::starts_with (crs, AUTHORITY) || code.empty() ||
      code.size() > MOST_DIGITS ||
      code.find_first_not_of ("0123456789") != std::string::npos)
    return "the coordinate system is \"" + crs +
           "\", but must be EPSG: and its number, as in EPSG:25832";
  return loaded().module != nullptr ? loaded().module->explain_crs (crs)
                                    : std::string();
}

std::string
toMap (const std::string& extension,
       const LinePoints& points,
       const std::vector<CrestLine>& lines,
       MapFiles& files)
{
  std::string failure = explainNoMaps();
  if (!failure.empty())
    return failure;
  MapLayer layer;
  layer.crs = points.crs();
  for (const Measure& measure : MEASURES)
    layer.columns.push_back ({measure.name, measure.short_name, measure.whole});
  for (const CrestLine& line : lines) {
    MapFeature& feature = layer.features.emplace_back();
    feature.type = nameOf (line.type);
    for (const Measure& measure : MEASURES)
      feature.numbers.push_back (measure.of (line));
    for (const std::vector<index_t>& polyline : line.polylines) {
      std::vector<Eigen::Vector3d>& places = feature.polylines.emplace_back();
      for (const index_t point : polyline)
        places.push_back (points.position (point));
    }
  }
  return loaded().module->write (extension, layer, files);
}

} // namespace crest
} // namespace pcl
