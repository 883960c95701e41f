// SPDX-License-Identifier: BSD-3-Clause
// Files of maps through GDAL, by a module that need not be there.
#pragma once

#include "io/line_file.h"
#include "io/map_module.h"

#include <string>
#include <vector>

namespace pcl {
namespace crest {

/** \brief Whether files of this extension, in lower case, are written by the module. */
bool
isMapFile (const std::string& extension);

/** \brief Why there are no files of maps; empty if there can be. */
std::string
explainNoMaps ();

/** \brief What is wrong with a coordinate system, which has to be "EPSG:" and a number,
 * and where the module is there one that exists; empty if nothing.
 */
std::string
explainCrs (const std::string& crs);

/** \brief The files of lines as a layer.
 * \param[in] extension ".gpkg" or ".shp"
 * \param[out] files by their extensions
 * \return what is wrong; empty if nothing
 */
std::string
toMap (const std::string& extension,
       const LinePoints& points,
       const std::vector<CrestLine>& lines,
       MapFiles& files);

} // namespace crest
} // namespace pcl
