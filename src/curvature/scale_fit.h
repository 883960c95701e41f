// SPDX-License-Identifier: BSD-3-Clause
// Curvature at a scale: section 4.2 for the auto preset.
#pragma once

#include "curvature/pyramid.h"

namespace pcl {
namespace crest {

/** \brief The surface around a node of a pyramid level, with what is uncertain of it.
 * Curvatures have the signs of PrincipalCurvature; units are those of the cloud.
 */
struct ScaleFit {
  float k1 = 0.0F;
  float k2 = 0.0F;
  Eigen::Vector3f t1 = Eigen::Vector3f::Zero();
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();
  /** height of the surface over the node's position, along the normal */
  float offset = 0.0F;
  /** of the neighbourhood that was fitted */
  float radius = 0.0F;
  /** standard deviation of a sample from the surface, pooled with the node's star */
  float noise = 0.0F;
  /** standard error of k1 that follows from it */
  float k1_error = 0.0F;
  bool valid = false;
};

/** \brief Fits a cubic height function to the `nearest` nodes around each node that is
 * needed, weighted by (1 - r^2 / R^2)^2 and the number of samples, and takes the
 * principal curvatures from both fundamental forms where the node is.
 *
 * The frame is tilted to the fitted tangent plane and the fit repeated while they
 * differ: the given normals need not be exact. The cubic terms keep k1 unbiased where
 * curvature changes, at a crest above all.
 *
 * \param[in] level the nodes
 * \param[in] nearest how many nodes to fit, at least 14; fewer than 14 found, or all on
 * a line, is invalid
 * \param[in] needed for each node whether it is to be fitted
 * \param[in] workers a number of threads, 0 for all processors
 */
std::vector<ScaleFit>
fitAtScale (const PyramidLevel& level,
            int nearest,
            const std::vector<std::uint8_t>& needed,
            const Workers& workers);

} // namespace crest
} // namespace pcl
