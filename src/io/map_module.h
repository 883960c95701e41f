// SPDX-License-Identifier: BSD-3-Clause
// What crosses the border to the module that knows GDAL. It is loaded when a file needs
// it, because programs would else load GDAL's hundred libraries to write none.
#pragma once

#include <Eigen/Core>

#include <string>
#include <utility>
#include <vector>

namespace pcl {
namespace crest {

/** \brief A column of the table of a layer. */
struct MapColumn {
  std::string name;
  /** at most 10 letters, which is what shapefiles have room for */
  std::string short_name;
  bool whole = false;
};

/** \brief A line with what is known of it, a number for each column. */
struct MapFeature {
  std::string type;
  std::vector<double> numbers;
  std::vector<std::vector<Eigen::Vector3d>> polylines;
};

/** \brief Lines as a layer of a map. */
struct MapLayer {
  /** as "EPSG:25832"; empty if not known */
  std::string crs;
  std::vector<MapColumn> columns;
  std::vector<MapFeature> features;
};

/** \brief The files of a layer by their extensions, and their contents. */
using MapFiles = std::vector<std::pair<std::string, std::string>>;

/** \brief The functions of the module. */
struct MapModule {
  /** \brief What is wrong with a coordinate system; empty if it is known. */
  std::string (*explain_crs) (const std::string& crs);
  /** \brief Makes the files of a layer in memory.
   * \param[in] extension ".gpkg" or ".shp"
   * \param[out] files those that the format has, in no order
   * \return what is wrong; empty if nothing
   */
  std::string (*write) (const std::string& extension,
                        const MapLayer& layer,
                        MapFiles& files);
};

/** \brief The name by which the library finds the module's `const MapModule`. */
constexpr char MAP_MODULE_SYMBOL[] = "pcl_crest_map_module";

} // namespace crest
} // namespace pcl
