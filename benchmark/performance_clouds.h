// SPDX-License-Identifier: BSD-3-Clause
// What speed is measured on.
#pragma once

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <string>

namespace performance {

struct Cloud {
  std::string name;
  pcl::PointCloud<pcl::PointNormal>::ConstPtr points;
  /** the same points in random order */
  pcl::PointCloud<pcl::PointNormal>::ConstPtr shuffled;
};

/** \brief A cloud from a file, or waves of so many points.
 * \param[in] source the path, or the number
 * \return what is wrong; empty if all is well
 */
std::string
makeCloud (const std::string& name, const std::string& source, Cloud& cloud);

} // namespace performance
