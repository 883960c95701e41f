// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_crest/crest_line.h>
#include <pcl_crest/io/read_cloud.h>
#include <pcl_crest/types.h>

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <string>
#include <vector>

namespace pcl {
namespace crest {

/** \brief The formats of writeLines by their extensions, in lower case. */
PCL_CREST_EXPORT std::vector<std::string>
lineExtensions ();

/** \brief The files that writeLines writes for a name: that one, of OBJ a second one
 * with the materials, and of shapefiles .shx, .dbf, .cpg and .prj.
 */
PCL_CREST_EXPORT std::vector<std::string>
lineFiles (const std::string& file);

/** \brief Whether writeLines can write lines to a file of this name in a coordinate
 * system, found out without writing.
 * \param[in] file the path
 * \param[in] crs "EPSG:" and a number; empty for none
 * \param[out] error if not, what is wrong, naming the file
 */
PCL_CREST_EXPORT bool
checkLines (const std::string& file, const std::string& crs, std::string& error);

/** \brief Writes crest lines in the format that the extension of the name tells. The
 * points in the file are those on lines, in the order of the cloud. A closed line ends
 * with its first point.
 *
 * Where a format has colors, ridges are blue and valleys red.
 *
 * - .obj: the groups "ridge" and "valley" with an element `l` for each polyline; the
 *   materials of these names are in a file .mtl beside it.
 * - .ply: vertices with colors; elements "edge" with vertex1, vertex2, red, green,
 * blue, type (crest::CrestType), line, the place of the line in `lines`, and polyline;
 * "polyline" with line and its two ends (crest::LineEnd); "line" with type, size,
 * closed, length, strength, mean_curvature, turning_angle, scale and sign_trust of
 * each, as CrestLine has them.
 * - .vtk, .vtp: polydata, legacy or XML, with a cell for each polyline, and all of
 * these as data of the cells, the same for all cells of a line but the ends; the array
 * RGB of points and cells is the active one.
 * - .dxf: release 12, 3-D polylines on the layers RIDGE and VALLEY.
 * - .geojson: a feature with a MultiLineString for each line, in the coordinates of the
 *   file, whatever these are; its properties are those of PLY's "line".
 * - .csv: a row for each line with id, its place in `lines`, type, length, strength,
 * the number of its vertices, and WKT, its polylines.
 * - .gpkg, .shp: a layer with the features of .geojson, where the library was built
 * with GDAL. Shapefiles call them mean_curv and turn_angle, and have 15 decimals.
 *
 * Coordinates are floats, but doubles where the placement has an offset.
 *
 * \param[in] file the path
 * \param[in] cloud what the lines are indices into
 * \param[in] lines as CrestLineEstimation::getLines gives them
 * \param[out] error on failure what is wrong, naming the file
 * \param[in] placement where the cloud lies in the file's coordinates
 * \param[in] crs of .geojson, .gpkg and .shp, what coordinate system these are of, as
 * "EPSG:25832", x to the east; GDAL, where it is there, knows whether there is one of
 * that number
 */
PCL_CREST_EXPORT bool
writeLines (const std::string& file,
            const pcl::PointCloud<pcl::PointNormal>& cloud,
            const std::vector<CrestLine>& lines,
            std::string& error,
            const Placement& placement = {},
            const std::string& crs = {});

} // namespace crest
} // namespace pcl
