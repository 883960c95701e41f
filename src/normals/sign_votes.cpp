// SPDX-License-Identifier: BSD-3-Clause
#include "normals/sign_votes.h"

#include "base/parallel.h"
#include "search/leaf_search.h"

namespace pcl {
namespace crest {

namespace {

float
agreementAt (const PlaneFits& fits,
             const Eigen::Vector3f& normal_of_a,
             const Eigen::Vector3f& normal_of_b,
             std::size_t a,
             std::size_t b)
{
  return agreementOf (normal_of_a,
                      normal_of_b,
                      fits.feet[b] - fits.feet[a],
                      std::max (fits.errors[a], fits.errors[b]));
}

/** \brief The vote of two samples for the normals of their windows. Where both saw two
 * sheets it is known whether they are on the same one: if both find the other beyond
 * the middle, or neither does.
 */
float
voteOfWindows (const PlaneFits& fits, std::size_t a, std::size_t b)
{
  constexpr float PARALLEL = 0.8F;
  constexpr float CONTRADICTION = 0.1F;
  const Eigen::Vector3f& n = fits.normals[a];
  const Eigen::Vector3f& m = fits.normals[b];
  const float agreement = agreementAt (fits, n, m, a, b);
  const float cosine = n.dot (m);
  if (fits.middles[a] == 0.0F || fits.middles[b] == 0.0F ||
      std::abs (cosine) <= PARALLEL)
    return agreement;
  const Eigen::Vector3f chord = fits.feet[b] - fits.feet[a];
  const auto isBeyond = [] (float height, float middle) {
    return middle > 0.0F ? height > middle : height < middle;
  };
  const bool beyond = isBeyond (n.dot (chord), fits.middles[a]);
  if (beyond != isBeyond (-m.dot (chord), fits.middles[b]))
    return CONTRADICTION * agreement;
  return beyond ? -cosine : cosine;
}

std::vector<SignVote>
joinBlocks (const std::vector<std::vector<SignVote>>& blocks)
{
  std::size_t count = 0;
  for (const std::vector<SignVote>& block : blocks)
    count += block.size();
  std::vector<SignVote> votes;
  votes.reserve (count);
  for (const std::vector<SignVote>& block : blocks)
    votes.insert (votes.end(), block.begin(), block.end());
  return votes;
}

/** \brief Calls use (block, i, neighbour) for the nearest of sample from[i]. */
template <typename Use>
void
forEachNearest (const PointTree& tree,
                const std::vector<index_t>& from,
                const Workers& workers,
                const Use& use)
{
  forEachBlock (
      from.size(), workers, [&] (std::size_t block, std::size_t i, std::size_t last) {
        LeafSearch search (tree, {PlaneFits::NEAREST});
        for (; i < last; ++i) {
          const LeafNeighbors& found = search.searchPoint (from[i]);
          for (std::size_t j = found.offsets[0]; j < found.offsets[1]; ++j)
            use (block, i, static_cast<std::size_t> (found.places[j]));
        }
      });
}

} // namespace

float
agreementOf (const Eigen::Vector3f& n,
             const Eigen::Vector3f& m,
             const Eigen::Vector3f& chord,
             float error)
{
  const float squared = chord.squaredNorm() + 4.0F * error * error;
  if (!(squared > 0.0F))
    return n.dot (m);
  return n.dot (m) - 2.0F * n.dot (chord) * m.dot (chord) / squared;
}

std::vector<SignVote>
findVotes (const PointTree& tree, const PlaneFits& fits, const Workers& workers)
{
  std::vector<std::vector<SignVote>> blocks (blockCount (fits.size()));
  forEachBlock (fits.size(),
                workers,
                [&] (std::size_t block, std::size_t first, std::size_t last) {
                  LeafSearch search (tree, {PlaneFits::NEAREST});
                  std::vector<SignVote>& votes = blocks[block];
                  for (; first < last; first += LEAF_SIZE) {
                    const LeafNeighbors& found = search.searchLeaf (first / LEAF_SIZE);
                    for (int i = 0; i < found.count; ++i) {
                      const auto a = static_cast<std::size_t> (found.first) +
                                     static_cast<std::size_t> (i);
                      if (fits.normals[a].isZero (0.0F))
                        continue;
                      for (std::size_t j = found.offsets[i]; j < found.offsets[i + 1];
                           ++j) {
                        const auto b = static_cast<std::size_t> (found.places[j]);
                        const bool is_listed_there =
                            b < a && found.squared_distances[j] < fits.reach[b];
                        if (!is_listed_there && !fits.normals[b].isZero (0.0F))
                          votes.push_back ({voteOfWindows (fits, a, b),
                                            static_cast<index_t> (std::min (a, b)),
                                            static_cast<index_t> (std::max (a, b))});
                      }
                    }
                  }
                });
  return joinBlocks (blocks);
}

std::vector<SignVote>
findVotes (const PointTree& tree,
           const PlaneFits& fits,
           const std::vector<Eigen::Vector3f>& normals,
           const std::vector<index_t>& from,
           const Workers& workers)
{
  std::vector<std::vector<SignVote>> blocks (blockCount (from.size()));
  forEachNearest (
      tree, from, workers, [&] (std::size_t block, std::size_t i, std::size_t b) {
        const auto a = static_cast<std::size_t> (from[i]);
        if (!normals[a].isZero (0.0F) && !normals[b].isZero (0.0F))
          blocks[block].push_back ({agreementAt (fits, normals[a], normals[b], a, b),
                                    static_cast<index_t> (std::min (a, b)),
                                    static_cast<index_t> (std::max (a, b))});
      });
  return joinBlocks (blocks);
}

std::vector<float>
sumVotes (const PointTree& tree,
          const PlaneFits& fits,
          const std::vector<Eigen::Vector3f>& normals,
          const std::vector<index_t>& from,
          const Workers& workers)
{
  std::vector<float> sums (from.size(), 0.0F);
  forEachNearest (tree, from, workers, [&] (std::size_t, std::size_t i, std::size_t b) {
    const auto a = static_cast<std::size_t> (from[i]);
    sums[i] += weightOf (agreementAt (fits, normals[a], fits.normals[b], a, b));
  });
  return sums;
}

} // namespace crest
} // namespace pcl
