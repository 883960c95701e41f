// SPDX-License-Identifier: BSD-3-Clause
// The profile of a sample from those of the nodes around it.
#pragma once

#include "profile_window.h"

namespace pcl {
namespace crest {

/** \brief The surface and its profile at a sample, k1 with the sign of its node's. */
struct BlendedProfile {
  double k1;
  double k2;
  Eigen::Vector3d t1;
  /** of the surface over the sample, along the normal of its node */
  double height;
  ProfileParabola profile;
};

/** \brief The mean of what the polynomials and paraboloids of a sample's node and of
 * the nodes beside it say at the sample, weighted by their distance.
 *
 * Those of one node alone jump from one node to the next, and crests with them. Nodes
 * whose k1 has another sign, or runs another way, describe something else.
 *
 * \param[in] polynomials for each node; that of the sample's own has to be valid
 */
BlendedProfile
blendProfiles (const Eigen::Vector3d& sample,
               index_t node,
               const PyramidLevel& level,
               const std::vector<ScaleFit>& fits,
               const std::vector<ProfilePolynomial>& polynomials);

} // namespace crest
} // namespace pcl
