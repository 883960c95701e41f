// SPDX-License-Identifier: BSD-3-Clause
// Estimated normals against exact ones.
#pragma once

#include <pcl_crest/normal_estimation.h>

#include "support/solid_clouds.h"

namespace accuracy {

/** \brief As many as normals are estimated from by default, the point itself included.
 */
constexpr int NORMAL_NEIGHBORS = 24;

/** \brief Where an edge is near, and where it is far, in h. */
constexpr double NEAR_EDGE = 2.0;
constexpr double FAR_FROM_EDGES = 4.0;

/** \brief Normals from both estimators, in single runs one after the other. */
struct NormalRun {
  pcl::crest::NormalEstimate estimate;
  std::vector<Eigen::Vector3f> of_pcl;
  double milliseconds;
  double milliseconds_of_pcl;
};

/** \brief With nothing known but the positions, and of open surfaces where up is.
 * \param[in] threads 0 for all processors
 */
NormalRun
runNormals (const pcl::PointCloud<pcl::PointNormal>& cloud,
            bool closed,
            unsigned threads);

/** \brief Medians of angles to the exact normals in degrees, signs ignored; NaN where
 * there are no points.
 */
struct AngleErrors {
  double far_from_edges, near_edges;
};

struct NormalScore {
  std::string solid;
  double noise;
  std::size_t points;
  /** share of points that are 60 degrees or more off the exact normal's line or have no
   * normal: what their sign should be means nothing */
  double undecided;
  /** of the others, the share of wrong signs */
  double wrong;
  /** of all points, the share whose trust calls their signs unsure */
  double unsure;
  /** of those that are sure and not undecided, the share of wrong signs; NaN where
   * there are none */
  double wrong_of_sure;
  AngleErrors angle, angle_of_pcl;
  double milliseconds, milliseconds_of_pcl;
};

/** \brief Of each point the distance to the nearest edge in h; infinite without edges.
 */
std::vector<double>
edgeDistances (const oracle::SolidCloud& exact);

/** \brief Fills in what can be told without the names.
 * \param[in] edge_distances of the exact samples
 */
NormalScore
scoreNormals (const NormalRun& run,
              const oracle::SolidCloud& exact,
              const std::vector<double>& edge_distances);

} // namespace accuracy
