// SPDX-License-Identifier: BSD-3-Clause
// Clouds that one sensor saw from one place.
#pragma once

#include "normals/normal_edges.h"

namespace pcl {
namespace crest {

/** \brief Whether a cloud can be what a sensor saw from its viewpoint: hardly any point
 * is hidden behind the surface around another one. Of scans up to a twentieth is, by
 * noise and at silhouettes; of models seen from outside a third and more.
 * \param[in] areas of each point the squared distance to its last neighbour, as
 * NormalEdges::find tells
 * \param[in] threads 0 for all processors
 */
bool
isSeenFrom (const std::vector<Eigen::Vector3f>& points,
            const std::vector<double>& areas,
            const Eigen::Vector3f& viewpoint,
            unsigned threads);

/** \brief Turns normals toward a viewpoint that all points were seen from. Where that
 * looks along the surface, noise decides which side it sees: there the sign is carried
 * over from those that it sees better.
 * \param[in] threads 0 for all processors
 * \param[in,out] normals of unit length or zero
 */
void
faceViewpoint (const std::vector<Eigen::Vector3f>& points,
               const NormalEdges& graph,
               const Eigen::Vector3f& viewpoint,
               unsigned threads,
               std::vector<Eigen::Vector3f>& normals);

} // namespace crest
} // namespace pcl
