// SPDX-License-Identifier: BSD-3-Clause
// Signs that most of the votes along all borders are for.
#pragma once

#include "base/index_map.h"
#include "normals/signed_sets.h"

#include <cstddef>
#include <vector>

namespace pcl {
namespace crest {

/** \brief Greedy contraction of a graph whose edges vote for equal or opposite signs:
 * the two clusters whose votes add up to most become one first, and their votes for
 * others are added (as Keuper et al. 2015 contract signed graphs to cut them). So all
 * of a border decides, where a spanning tree follows its best edge.
 */
class SignedContraction {
public:
  /** \param[in] sizes of the nodes, for what contract may make of them */
  explicit SignedContraction (std::vector<std::size_t> sizes);

  /** \brief Adds a vote of two nodes for the same sign, or if negative for opposite
   * ones.
   */
  void
  vote (index_t a, index_t b, float weight);

  /** \brief Contracts all pairs of clusters whose votes agree so far, and add up to so
   * much, if they stay small enough.
   * \param[in] least_agreement of the sum of votes in the sum of their amounts
   * \param[in] least_sum of votes
   * \param[in] largest sum of sizes
   */
  void
  contract (float least_agreement, float least_sum, std::size_t largest);

  /** \brief The cluster of a node, known by one of its nodes, and whether its sign is
   * opposite to that one's.
   */
  SignedSets::Place
  find (index_t node)
  {
    return sets_.find (node);
  }

  /** \brief The sum of the amounts of all votes at the border of a cluster. */
  float
  border (index_t root) const;

  /** \brief Of each node how far votes agreed where it was joined to the largest
   * cluster around it: the least on the way, each time of the smaller one.
   */
  std::vector<float>
  agreements () const;

private:
  struct Votes {
    float sum = 0.0F;
    float amount = 0.0F;
  };

  struct Merge {
    index_t keep;
    index_t drop;
    bool keeps_larger;
    float agreement;
  };

  void
  merge (index_t keep, index_t drop, bool opposite, float agreement);

  SignedSets sets_;
  std::vector<std::size_t> sizes_;
  /** of the roots of clusters, by those of others */
  std::vector<IndexMap<Votes>> votes_;
  std::vector<Merge> merges_;
  /** the clusters whose votes for the last merged one are new */
  std::vector<index_t> changed_;
};

} // namespace crest
} // namespace pcl
