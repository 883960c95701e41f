// SPDX-License-Identifier: BSD-3-Clause
// Which neighbours' normals look to the same side.
#pragma once

#include "base/progress.h"
#include "normals/plane_fits.h"

namespace pcl {
namespace crest {

/** \brief How much a vote counts in sums: doubtful ones hardly. */
inline float
weightOf (float agreement)
{
  return agreement * std::abs (agreement);
}

/** \brief What the normals of two neighbours say of their signs. */
struct SignVote {
  /** 1 where they look to the same side for sure, -1 where one has to be turned */
  float agreement;
  index_t a;
  index_t b;
};

/** \brief How far two normals agree on the side of one surface.
 *
 * Hoppe et al. 1992 take n.m, which joins the two sides of a thin wall and is undecided
 * at a sharp edge. Xie et al. 2003 reflect n in the plane halfway between the two
 * places, which is exact where these lie on a common circle: n.m - 2 (n.e)(m.e), with e
 * the direction from one to the other.
 * \param[in] n, m the normals
 * \param[in] chord from the place of n to that of m
 * \param[in] error of their places: what noise adds to a chord may stand across the
 * surface, and counts less the more of it there is
 */
float
agreementOf (const Eigen::Vector3f& n,
             const Eigen::Vector3f& m,
             const Eigen::Vector3f& chord,
             float error);

/** \brief The votes of all samples with their PlaneFits::NEAREST for the normals of
 * their windows: each pair once, or twice where both list the other at the reach of one
 * or, as of stray points, beyond it.
 * \param[in] tree that the fits were made from
 */
std::vector<SignVote>
findVotes (const PointTree& tree, const PlaneFits& fits, const Workers& workers);

/** \brief The votes of some samples with their nearest for other normals.
 * \param[in] normals of all samples
 * \param[in] from which samples
 */
std::vector<SignVote>
findVotes (const PointTree& tree,
           const PlaneFits& fits,
           const std::vector<Eigen::Vector3f>& normals,
           const std::vector<index_t>& from,
           const Workers& workers);

/** \brief What the windows of the nearest say of other normals of some samples: the sum
 * of the weights of their votes for the sign of each.
 * \param[in] normals, from as above
 */
std::vector<float>
sumVotes (const PointTree& tree,
          const PlaneFits& fits,
          const std::vector<Eigen::Vector3f>& normals,
          const std::vector<index_t>& from,
          const Workers& workers);

} // namespace crest
} // namespace pcl
