// SPDX-License-Identifier: BSD-3-Clause
// Samples gathered to nodes that are a given distance apart.
#pragma once

#include <Eigen/Core>

#include "base/progress.h"
#include "search/point_tree.h"

#include <vector>

namespace pcl {
namespace crest {

/** \brief Samples, each of which belongs to the node that it was gathered to. */
struct GatheredSamples {
  /** of each sample its node */
  std::vector<index_t> node_of;
  std::size_t nodes = 0;
};

/** \brief Gathers each sample to the nearest of centres that are a distance apart
 * (Poisson discs, taken in an order that is random but for the places of the samples).
 *
 * \param[in] tree over the positions
 * \param[in] positions along a curve, which the result depends on
 * \param[in] spacings of each sample how far apart nodes are there; 0 where it is a
 * node by itself
 *
 * \param[in] normals if not null, those of the samples: what is gathered to a centre is
 * within 60 degrees of its own
 */
GatheredSamples
gatherSamples (const PointTree& tree,
               const std::vector<Eigen::Vector3f>& positions,
               const std::vector<float>& spacings,
               const Workers& workers,
               const std::vector<Eigen::Vector3f>* normals = nullptr);

} // namespace crest
} // namespace pcl
