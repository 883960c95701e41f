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

/** \brief The formats of writeLabels by their extensions, in lower case. */
PCL_CREST_EXPORT std::vector<std::string>
labelExtensions ();

/** \brief Writes the points of a cloud with their labels, in their order, in the format
 * that the extension of the name tells: binary PCD, organized as the cloud is, binary
 * PLY, or LAS 1.4.
 *
 * Each point has x y z, its normal, and
 * - curvature: k1 with its sign, in 1 / (the cloud's unit);
 * - label: one of crest::Label;
 * - line: the place in `lines` of the strongest one through it, or -1;
 * - strength: that of this line, or 0;
 * - all fields of the file that was read (InputCloud::fields).
 *
 * x y z are floats, but doubles where the placement has an offset: PCL reads such PCD
 * files into a PCLPointCloud2 alone, as its point types hold floats. PLY has the colors
 * of the file, else those of the labels; pcl_viewer colors labels by itself. LAS has
 * what its point format has a place for there, and all else as extra bytes; points that
 * are not finite or set apart are withheld ones at its origin.
 *
 * \param[in] file the path
 * \param[in] cloud its points, placement, fields and colors
 * \param[in] labels, curvatures one for each point
 * \param[in] lines as CrestLineEstimation::getLines gives them
 * \param[out] error on failure what is wrong, naming the file
 */
PCL_CREST_EXPORT bool
writeLabels (const std::string& file,
             const InputCloud& cloud,
             const pcl::PointCloud<pcl::Label>& labels,
             const pcl::PointCloud<pcl::PrincipalCurvatures>& curvatures,
             const std::vector<CrestLine>& lines,
             std::string& error);

/** \brief Writes principal curvatures as binary PCD: x y z normal_x normal_y normal_z
 * principal_curvature_x principal_curvature_y principal_curvature_z pc1 pc2, a point
 * for each of the cloud, in its order and organized as it is. x y z as writeLabels has
 * them.
 *
 * \param[in] file the path
 * \param[in] cloud, curvatures of one size
 * \param[out] error on failure what is wrong, naming the file
 * \param[in] placement where the cloud lies in the file's coordinates
 */
PCL_CREST_EXPORT bool
writeCurvatures (const std::string& file,
                 const pcl::PointCloud<pcl::PointNormal>& cloud,
                 const pcl::PointCloud<pcl::PrincipalCurvatures>& curvatures,
                 std::string& error,
                 const Placement& placement = {});

} // namespace crest
} // namespace pcl
