// SPDX-License-Identifier: BSD-3-Clause
// Clouds that one sensor saw from one place.
#pragma once

#include "base/progress.h"
#include "normals/plane_fits.h"

namespace pcl {
namespace crest {

/** \brief Whether a cloud can be what a sensor saw from its viewpoint: hardly any point
 * is hidden behind the surface around another one. Of scans up to a twentieth is, by
 * noise and at silhouettes; of models seen from outside a third and more.
 * \param[in] viewpoint in the unit of the fits
 */
bool
isSeenFrom (const PlaneFits& fits,
            const Eigen::Vector3f& viewpoint,
            const Workers& workers);

/** \brief The normals of samples, turned toward a viewpoint that all were seen from.
 * Where that looks along the surface, noise decides which side it sees: there the sign
 * is carried over from those that it sees better.
 * \param[in] tree that the fits were made from
 * \param[in] viewpoint in the unit of the fits
 */
std::vector<Eigen::Vector3f>
faceViewpoint (const PointTree& tree,
               const PlaneFits& fits,
               const Eigen::Vector3f& viewpoint,
               const Workers& workers);

} // namespace crest
} // namespace pcl
