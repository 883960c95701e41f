// SPDX-License-Identifier: BSD-3-Clause
// Room normals: normals for clouds that have none, estimated and turned to one side of
// the surface, or taken from faces.
//
// Positions, perhaps faces or a viewpoint, go in; a normal for each comes out, and how
// its side was decided and how sure that is. It knows nothing of files, and nothing of
// the stages that use normals.
#pragma once

#include <pcl_crest/normal_estimation.h>

#include "base/progress.h"
#include "sampling/sample_nodes.h"

namespace pcl {
namespace crest {

/** \brief Checks what is known of the side of normals.
 *
 * \throw std::invalid_argument in words for the user
 */
void
checkHints (const NormalHints& hints);

/** \brief Estimates normals as the first stage of more work: its threads and its
 * callback take the place of the request's.
 */
NormalEstimate
estimateNormals (const NormalRequest& request, const Workers& workers);

/** \brief Estimates those of nodes, if there are some: each point has its node's. */
NormalEstimate
estimateNormals (const NormalRequest& request,
                 const SampleNodes& nodes,
                 const Workers& workers);

} // namespace crest
} // namespace pcl
