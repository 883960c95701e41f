// SPDX-License-Identifier: BSD-3-Clause
#include "normals/signed_contraction.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <queue>
#include <tuple>
#include <utility>

namespace pcl {
namespace crest {

namespace {

/** \brief A pair of clusters that may become one. */
struct Candidate {
  float weight;
  index_t a;
  index_t b;

  /** \brief The heaviest is the largest, of equal ones the first pair. */
  bool
  operator<(const Candidate& other) const
  {
    return std::tie (weight, other.a, other.b) < std::tie (other.weight, a, b);
  }
};

} // namespace

SignedContraction::SignedContraction (std::vector<std::size_t> sizes)
: sets_ (sizes.size()), sizes_ (std::move (sizes)), votes_ (sizes_.size())
{}

void
SignedContraction::vote (index_t a, index_t b, float weight)
{
  const SignedSets::Place of_a = sets_.find (a);
  const SignedSets::Place of_b = sets_.find (b);
  if (of_a.root == of_b.root)
    return;
  const float turned = of_a.turned != of_b.turned ? -weight : weight;
  for (Votes* const votes :
       {&votes_[of_a.root][of_b.root], &votes_[of_b.root][of_a.root]}) {
    votes->sum += turned;
    votes->amount += std::abs (weight);
  }
}

float
SignedContraction::border (index_t root) const
{
  // Sorted, as the order of a hash table is nobody's business.
  std::vector<float> amounts;
  votes_[root].forEach (
      [&amounts] (index_t, const Votes& votes) { amounts.push_back (votes.amount); });
  std::sort (amounts.begin(), amounts.end());
  float sum = 0.0F;
  for (const float amount : amounts)
    sum += amount;
  return sum;
}

void
SignedContraction::merge (index_t keep, index_t drop, bool opposite, float agreement)
{
  sets_.unite (keep, drop, opposite);
  const bool keeps_larger = sizes_[keep] >= sizes_[drop];
  merges_.push_back ({keep, drop, keeps_larger, agreement});
  sizes_[keep] += sizes_[drop];
  votes_[keep].erase (drop);
  votes_[drop].erase (keep);
  const IndexMap<Votes> dropped = std::exchange (votes_[drop], IndexMap<Votes>());
  votes_[keep].reserve (votes_[keep].size() + dropped.size());
  dropped.forEach ([&] (index_t other, const Votes& votes) {
    Votes& sum = votes_[keep][other];
    sum.sum += opposite ? -votes.sum : votes.sum;
    sum.amount += votes.amount;
    votes_[other].erase (drop);
    votes_[other][keep] = sum;
    changed_.push_back (other);
  });
}

void
SignedContraction::contract (float least_agreement,
                             float least_sum,
                             std::size_t largest)
{
  std::priority_queue<Candidate> queue;
  const auto is_wanted = [&] (index_t a, index_t b, const Votes& votes) {
    const float weight = std::abs (votes.sum);
    return weight >= least_agreement * votes.amount && weight >= least_sum &&
           sizes_[a] + sizes_[b] <= largest;
  };
  const auto offer = [&] (index_t a, index_t b, const Votes& votes) {
    if (is_wanted (a, b, votes))
      queue.push ({std::abs (votes.sum), std::min (a, b), std::max (a, b)});
  };
  for (std::size_t a = 0; a < votes_.size(); ++a)
    votes_[a].forEach (
        [&, a = static_cast<index_t> (a)] (index_t b, const Votes& votes) {
          if (a < b)
            offer (a, b, votes);
        });
  while (!queue.empty()) {
    const Candidate candidate = queue.top();
    queue.pop();
    // Candidates stay in the queue when their clusters are gone or their votes change.
    const Votes* const found = votes_[candidate.a].find (candidate.b);
    if (found == nullptr || std::abs (found->sum) != candidate.weight ||
        !is_wanted (candidate.a, candidate.b, *found))
      continue;
    const Votes votes = *found;
    index_t keep = candidate.a;
    index_t drop = candidate.b;
    if (votes_[keep].size() < votes_[drop].size())
      std::swap (keep, drop);
    changed_.clear();
    merge (keep,
           drop,
           votes.sum<0.0F, votes.amount> 0.0F ? std::abs (votes.sum) / votes.amount
                                              : 0.0F);
    for (const index_t other : changed_)
      offer (keep, other, votes_[keep][other]);
  }
}

std::vector<float>
SignedContraction::agreements() const
{
  // Clusters in the order of their making: the nodes, and one for each merge.
  const std::size_t nodes = sizes_.size();
  std::vector<std::size_t> cluster (nodes);
  for (std::size_t i = 0; i < nodes; ++i)
    cluster[i] = i;
  std::vector<std::array<std::size_t, 2>> larger_and_smaller;
  for (const Merge& merge : merges_) {
    std::array<std::size_t, 2> both{cluster[merge.keep], cluster[merge.drop]};
    if (!merge.keeps_larger)
      std::swap (both[0], both[1]);
    larger_and_smaller.push_back (both);
    cluster[merge.keep] = nodes + larger_and_smaller.size() - 1;
  }
  std::vector<float> agreement (nodes + merges_.size(), 1.0F);
  for (std::size_t i = merges_.size(); i-- > 0;) {
    const float around = agreement[nodes + i];
    agreement[larger_and_smaller[i][0]] = around;
    agreement[larger_and_smaller[i][1]] = std::min (around, merges_[i].agreement);
  }
  agreement.resize (nodes);
  return agreement;
}

} // namespace crest
} // namespace pcl
