// SPDX-License-Identifier: BSD-3-Clause
// The profile of a sample from those of the nodes around it.
#pragma once

#include "crests/profile_window.h"

namespace pcl {
namespace crest {

/** \brief The surface and its profile at a sample. */
struct BlendedProfile {
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

/** \brief Standard errors of a blended profile's slope and bend against the standard
 * error of k1. Neighbouring fits share most of their nodes, and neighbouring
 * polynomials are blended, so that the ratio cannot be had from the profile's own fit;
 * these give both z about unit variance on noisy cylinders: powers of the number of
 * nodes of a fit, through what was measured there (test_profile_blend).
 */
struct ProfileErrors {
  double slope;
  double bend;
};
ProfileErrors
profileErrors (int nodes_of_fit, bool elongated);

} // namespace crest
} // namespace pcl
