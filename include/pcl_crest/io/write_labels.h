// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_crest/io/read_cloud.h>
#include <pcl_crest/types.h>

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <string>

namespace pcl {
namespace crest {

/** \brief Writes a labelled cloud as binary PCD: x y z normal_x normal_y normal_z
 * curvature label, a point for each of the cloud, in its order and organized as it is.
 * curvature is k1 with its sign, in 1 / (the cloud's unit). pcl_viewer colors the
 * labels by itself.
 *
 * x y z are floats, but doubles where the placement has an offset: PCL reads those into
 * a PCLPointCloud2 alone, as its point types hold floats.
 *
 * \param[in] file the path
 * \param[in] cloud, labels, curvatures of one size
 * \param[out] error on failure what is wrong, naming the file
 * \param[in] placement where the cloud lies in the file's coordinates
 */
PCL_CREST_EXPORT bool
writeLabels (const std::string& file,
             const pcl::PointCloud<pcl::PointNormal>& cloud,
             const pcl::PointCloud<pcl::Label>& labels,
             const pcl::PointCloud<pcl::PrincipalCurvatures>& curvatures,
             std::string& error,
             const Placement& placement = {});

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
