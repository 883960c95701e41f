// SPDX-License-Identifier: BSD-3-Clause
// The tree of the batched search over points that are known to be right.
#pragma once

#include <pcl_crest/types.h>

#include <Eigen/Core>

#include "search/point_tree.h"

#include <memory>
#include <vector>

namespace pcl {
namespace crest {

/** \brief Builds the tree over positions.
 * \param[in] positions finite, at most MOST_POINTS
 * \param[in] threads 0 for all processors
 */
PCL_CREST_EXPORT std::shared_ptr<const PointTree>
treeOver (const std::vector<Eigen::Vector3f>& positions, unsigned threads);

} // namespace crest
} // namespace pcl
