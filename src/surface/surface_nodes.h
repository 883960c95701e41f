// SPDX-License-Identifier: BSD-3-Clause
// Nodes in the place of samples that noise has moved by as much as they are apart.
#pragma once

#include "surface/oriented_points.h"

namespace pcl {
namespace crest {

/** \brief Gathers samples to their means, of as many as leave the nodes the noise that
 * is asked for.
 *
 * Which samples a node has is decided by their places in the surface (flattenPlaces)
 * and by normals, so that means are of all heights in the noise and of one sheet; noise
 * of nodes is as independent as that of samples. Nodes have the mean normals of the
 * quadrics that gave the samples their places.
 *
 * \param[in] samples to gather
 * \param[in] noise_of_nodes in their spacings
 * \param[in] workers a number of threads, 0 for all processors
 * \return the nodes, of which samples are the cloud: cloud_index is the sample nearest
 * to a node, packed_index the node of a sample
 */
OrientedPoints
gatherOnSurface (const OrientedPoints& samples,
                 double noise_of_nodes,
                 const Workers& workers);

/** \brief Nodes as points of the cloud that their samples are of. */
OrientedPoints
nodesOfCloud (const OrientedPoints& samples, OrientedPoints nodes);

} // namespace crest
} // namespace pcl
