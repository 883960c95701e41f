// SPDX-License-Identifier: BSD-3-Clause
// Clouds that one sensor saw from one place.
#pragma once

#include "base/progress.h"
#include "normals/plane_fits.h"

#include <optional>

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

struct SeenNormals {
  std::vector<Eigen::Vector3f> normals;
  /** how sure their signs are: 1 where they are seen well, SURE_SIGN where these
   * decide, 0 where nothing does */
  std::vector<float> trust;
};

/** \brief The normals of samples, turned toward a viewpoint that all were seen from.
 * Where that looks along the surface, noise decides which side it sees: there the sign
 * is carried over from those that it sees better. None if that is most of the surface.
 * \param[in] tree that the fits were made from
 * \param[in] viewpoint in the unit of the fits
 */
std::optional<SeenNormals>
faceViewpoint (const PointTree& tree,
               const PlaneFits& fits,
               const Eigen::Vector3f& viewpoint,
               const Workers& workers);

} // namespace crest
} // namespace pcl
