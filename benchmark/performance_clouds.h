// SPDX-License-Identifier: BSD-3-Clause
// What speed is measured on.
#pragma once

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <string>

namespace performance {

using PointCloud = pcl::PointCloud<pcl::PointNormal>;

struct Cloud {
  std::string name;
  PointCloud::ConstPtr points;
};

/** \brief The same points in random order, always the same. */
PointCloud::ConstPtr
shuffled (const PointCloud& cloud);

/** \brief A cloud from a file, or waves of so many points.
 * \param[in] source the path, or the number
 * \return what is wrong; empty if all is well
 */
std::string
makeCloud (const std::string& name, const std::string& source, Cloud& cloud);

} // namespace performance
