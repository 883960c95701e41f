// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_crest/crest_line_estimation.h>
#include <pcl_crest/io/read_cloud.h>
#include <pcl_crest/types.h>

#include <string>
#include <vector>

namespace pcl {
namespace crest {

/** \brief Writes what is to say about a run as JSON: points, invalid points, boundary
 * points where these are labelled, the offset that was taken off the coordinates and
 * how many points were set apart (see Placement), where the normals came from and, if
 * they were estimated, how sure their signs are, mean spacing and extent, the
 * parameters, for each type the number of crest points, of points joined by growth and
 * of lines, their total length, how many lines there were of each size before the small
 * ones were removed, the lines in the order of getLines, and the milliseconds of each
 * stage.
 *
 * \param[in] file the path
 * \param[in] cloud the input
 * \param[in] labels the output
 * \param[in] parameters, lines, statistics as CrestLineEstimation has them
 * \param[in] times of all stages that are to be listed
 * \param[out] error on failure what is wrong, naming the file
 */
PCL_CREST_EXPORT bool
writeStatistics (
    const std::string& file,
    const InputCloud& cloud,
    const pcl::PointCloud<pcl::Label>& labels,
    const Parameters& parameters,
    const std::vector<CrestLine>& lines,
    const pcl::CrestLineEstimation<pcl::PointNormal>::Statistics& statistics,
    const std::vector<StageTime>& times,
    std::string& error);

/** \brief The same for an estimation after compute. */
PCL_CREST_EXPORT bool
writeStatistics (const std::string& file,
                 const InputCloud& cloud,
                 const pcl::PointCloud<pcl::Label>& labels,
                 const pcl::CrestLineEstimation<pcl::PointNormal>& estimation,
                 const std::vector<StageTime>& times,
                 std::string& error);

} // namespace crest
} // namespace pcl
