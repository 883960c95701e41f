// SPDX-License-Identifier: BSD-3-Clause
// Every simulated sensor before scenes of its size.
#pragma once

#include "scene.h"

#include <optional>

namespace oracle {

/** \brief What a sensor gives of a scene, without normals. */
struct SensorCloud {
  pcl::PointCloud<pcl::PointXYZ>::Ptr cloud;
  /** from where all was seen; none where it was seen from all sides */
  std::optional<View> view;
};

struct SensorCase {
  std::string sensor;
  Scene scene;
  std::function<SensorCloud (unsigned seed)> scan;
};

/** \brief All sensors before the blocks, and but for lidars before a ridge and a
 * valley, too: what lidars that stand on the ground see of these they see at a grazing
 * angle.
 */
std::vector<SensorCase>
sensorCases ();

} // namespace oracle
