// SPDX-License-Identifier: BSD-3-Clause
// Signs of normals that agree over each connected part of a cloud.
#pragma once

#include "base/progress.h"
#include "normals/sign_votes.h"

namespace pcl {
namespace crest {

/** \brief Signs of normals, by the samples' places. */
struct ConsistentSigns {
  /** whether to turn the normal of each window over */
  std::vector<std::uint8_t> turned;
  /** of each sample the part that it is connected to by votes, counted from 0; -1 where
   * it has no normal */
  std::vector<index_t> part;
  /** how sure its sign is against that of its part, 0 to 1: the least agreement of
   * votes where patches were joined, or that of rays */
  std::vector<float> trust;
  /** of each part how far rays bear out that it looks outward, 1 to -1; 0 where it is
   * not closed, or nothing is known */
  std::vector<float> outward;
};

/** \brief Finds signs that most votes are for.
 *
 * Samples are joined over sure votes to nodes of a few, and these by all votes along
 * their borders, as long as nearly all agree: first to pieces, then to patches of any
 * size (see SignedContraction). What the last borders, across sharp edges and noise,
 * leave open is decided together with rays, which tell where the inside of a closed
 * part is (see RayParity): these vote for what a node called outside thinks.
 *
 * \param[in] votes of all neighbours
 */
ConsistentSigns
findConsistentSigns (const std::vector<SignVote>& votes,
                     const PlaneFits& fits,
                     const Workers& workers);

/** \brief Turns the normals of windows that have to be. */
inline void
turnBy (const ConsistentSigns& signs, PlaneFits& fits)
{
  for (std::size_t i = 0; i < fits.size(); ++i)
    if (signs.turned[i] != 0) {
      fits.normals[i] = -fits.normals[i];
      fits.middles[i] = -fits.middles[i];
    }
}

} // namespace crest
} // namespace pcl
