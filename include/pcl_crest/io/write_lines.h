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

/** \brief Writes crest lines in the format that the extension of the name tells. The
 * points in the file are those on lines, in the order of the cloud. A closed line ends
 * with its first point.
 *
 * - .obj: the groups "ridge" and "valley" with an element `l` for each polyline.
 * - .ply: elements "edge" with vertex1, vertex2, type (crest::CrestType), line, the
 *   place of the line in `lines`, and polyline; "polyline" with line and its two ends
 *   (crest::LineEnd); "line" with type, size, closed, length, strength, mean_curvature,
 *   turning_angle, scale and sign_trust of each, as CrestLine has them.
 * - .vtk: legacy polydata with a cell for each polyline, and all of these as data of
 * the cells, the same for all cells of a line but the ends.
 *
 * Coordinates are floats, but doubles where the placement has an offset.
 *
 * \param[in] file the path
 * \param[in] cloud what the lines are indices into
 * \param[in] lines as CrestLineEstimation::getLines gives them
 * \param[out] error on failure what is wrong, naming the file
 * \param[in] placement where the cloud lies in the file's coordinates
 */
PCL_CREST_EXPORT bool
writeLines (const std::string& file,
            const pcl::PointCloud<pcl::PointNormal>& cloud,
            const std::vector<CrestLine>& lines,
            std::string& error,
            const Placement& placement = {});

} // namespace crest
} // namespace pcl
