// SPDX-License-Identifier: BSD-3-Clause
#include "normals/consistent_signs.h"

#include <pcl_crest/normal_estimation.h>

#include "base/parallel.h"
#include "normals/ray_parity.h"
#include "normals/signed_contraction.h"

#include <algorithm>
#include <array>

namespace pcl {
namespace crest {

namespace {

/** The samples of a piece, which is small enough to be on one side of whatever a patch
 * may have been joined across. */
constexpr std::size_t PIECE = 256;

/** \brief Samples joined over sure votes, a few to a node, in whose sign they agree.
 */
struct VotingNodes {
  /** of each sample its node, and whether its sign is opposite to that one's */
  std::vector<index_t> of_sample;
  std::vector<std::uint8_t> turned;
  /** of each node how many samples it has */
  std::vector<std::size_t> sizes;

  SignedSets::Place
  placeOf (index_t sample) const
  {
    return {of_sample[sample], turned[sample] != 0};
  }
};

VotingNodes
joinSamples (const std::vector<SignVote>& votes, std::size_t samples)
{
  constexpr float SURE = 0.9F;
  constexpr int MOST = 16;
  constexpr std::size_t BINS = 32;
  // The surest first, as near as bins tell.
  std::array<std::vector<std::size_t>, BINS> bins;
  for (std::size_t i = 0; i < votes.size(); ++i) {
    const float doubt = (1.0F - std::abs (votes[i].agreement)) / (1.0F - SURE);
    if (doubt < 1.0F)
      bins[static_cast<std::size_t> (std::max (0.0F, doubt) * BINS)].push_back (i);
  }
  SignedSets sets (samples);
  std::vector<std::uint8_t> members (samples, 1);
  for (const std::vector<std::size_t>& bin : bins)
    for (const std::size_t i : bin) {
      const SignVote& vote = votes[i];
      const index_t a = sets.find (vote.a).root;
      const index_t b = sets.find (vote.b).root;
      if (a == b || members[a] + members[b] > MOST)
        continue;
      members[a] = static_cast<std::uint8_t> (members[a] + members[b]);
      sets.unite (vote.a, vote.b, vote.agreement < 0.0F);
    }

  VotingNodes nodes;
  nodes.of_sample.assign (samples, -1);
  nodes.turned.assign (samples, 0);
  for (std::size_t i = 0; i < samples; ++i) {
    const SignedSets::Place place = sets.find (static_cast<index_t> (i));
    index_t& of_root = nodes.of_sample[place.root];
    if (of_root < 0) {
      of_root = static_cast<index_t> (nodes.sizes.size());
      nodes.sizes.push_back (0);
    }
    nodes.of_sample[i] = of_root;
    nodes.turned[i] = place.turned ? 1 : 0;
    ++nodes.sizes[of_root];
  }
  return nodes;
}

/** \brief Connected parts, counted from 0. */
struct Parts {
  std::vector<index_t> of_node;
  std::size_t count = 0;
};

Parts
connect (const std::vector<SignVote>& votes, const VotingNodes& nodes)
{
  SignedSets sets (nodes.sizes.size());
  for (const SignVote& vote : votes)
    sets.unite (nodes.of_sample[vote.a], nodes.of_sample[vote.b], false);
  Parts parts;
  parts.of_node.assign (nodes.sizes.size(), -1);
  for (std::size_t i = 0; i < parts.of_node.size(); ++i) {
    index_t& of_root = parts.of_node[sets.find (static_cast<index_t> (i)).root];
    if (of_root < 0)
      of_root = static_cast<index_t> (parts.count++);
    parts.of_node[i] = of_root;
  }
  return parts;
}

/** \brief Adds the votes of samples.
 *
 * \param[in] place (sample) its node of the graph, and whether its sign is opposite to
 * that one's
 */
template <typename PlaceOf>
void
addVotes (const std::vector<SignVote>& votes,
          const PlaceOf& place,
          SignedContraction& graph)
{
  for (const SignVote& vote : votes) {
    const SignedSets::Place a = place (vote.a);
    const SignedSets::Place b = place (vote.b);
    const float weight = weightOf (vote.agreement);
    if (a.root != b.root)
      graph.vote (a.root, b.root, a.turned != b.turned ? -weight : weight);
  }
}

/** \brief Of each node its cluster. */
std::vector<SignedSets::Place>
clustersOf (SignedContraction& graph, std::size_t nodes)
{
  std::vector<SignedSets::Place> clusters;
  clusters.reserve (nodes);
  for (std::size_t i = 0; i < nodes; ++i)
    clusters.push_back (graph.find (static_cast<index_t> (i)));
  return clusters;
}

/** \brief What rays say of a cluster, for the sign of its root. */
struct RayTest {
  index_t root;
  std::size_t size;
  double mean = 0.0;
  double deviation = 0.0;
  /** the mean over its standard error */
  double significance = 0.0;
};

/** \brief Asks rays about clusters of nodes. */
class RayTester {
public:
  RayTester (const PlaneFits& fits, const VotingNodes& nodes, const Workers& workers)
  : rays_ (fits), nodes_ (nodes), workers_ (workers)
  {}

  /** \brief Tests clusters at some of their samples, spread over each.
   * \param[in] clusters of the nodes
   * \param[in] is_tested of each node whether to test the cluster that it is the root
   * of \param[in] most tests for each
   */
  std::vector<RayTest>
  test (const std::vector<SignedSets::Place>& clusters,
        const std::vector<std::uint8_t>& is_tested,
        std::size_t most) const
  {
    constexpr std::size_t EVERY = 8;
    constexpr std::size_t LEAST = 6;
    std::vector<std::vector<index_t>> samples_of (clusters.size());
    for (std::size_t i = 0; i < nodes_.of_sample.size(); ++i) {
      const index_t root = clusters[nodes_.of_sample[i]].root;
      if (is_tested[root] != 0)
        samples_of[root].push_back (static_cast<index_t> (i));
    }
    const auto wanted = [&] (const std::vector<index_t>& samples) {
      return std::clamp (samples.size() / EVERY, LEAST, most);
    };
    std::size_t all = 0;
    for (const std::vector<index_t>& samples : samples_of)
      all += samples.size() < LEAST_PART ? 0 : wanted (samples);
    // Crumbs take no more rays than a whole surface would.
    const std::size_t affordable = nodes_.of_sample.size() / EVERY + 1000;
    std::vector<RayTest> tests;
    std::vector<index_t> tested;
    std::vector<std::size_t> ends;
    for (std::size_t root = 0; root < clusters.size(); ++root) {
      const std::vector<index_t>& samples = samples_of[root];
      const std::size_t size = samples.size();
      if (size < LEAST_PART)
        continue;
      std::size_t count = wanted (samples);
      if (all > affordable)
        count = count * affordable / all;
      if (count < LEAST / 2)
        continue;
      for (std::size_t t = 0; t < count; ++t)
        tested.push_back (samples[(2 * t + 1) * size / (2 * count)]);
      ends.push_back (tested.size());
      tests.push_back ({static_cast<index_t> (root), size});
    }
    std::vector<float> found (tested.size());
    constexpr std::size_t TESTS_OF_BLOCK = 32;
    forEachBlock (
        tested.size(),
        workers_,
        [&] (std::size_t, std::size_t first, std::size_t last) {
          for (; first < last; ++first)
            found[first] = voteForRoot (tested[first], clusters);
        },
        TESTS_OF_BLOCK);
    for (std::size_t i = 0; i < tests.size(); ++i)
      summarize (found, i == 0 ? 0 : ends[i - 1], ends[i], tests[i]);
    return tests;
  }

private:
  float
  voteForRoot (index_t sample, const std::vector<SignedSets::Place>& clusters) const
  {
    const float vote = rays_.vote (static_cast<std::size_t> (sample));
    const bool turned = nodes_.turned[sample] != 0;
    return turned != clusters[nodes_.of_sample[sample]].turned ? -vote : vote;
  }

  static void
  summarize (const std::vector<float>& votes,
             std::size_t first,
             std::size_t last,
             RayTest& test)
  {
    constexpr double LEAST_VARIANCE = 0.01;
    const auto count = static_cast<double> (last - first);
    double sum = 0.0;
    double squares = 0.0;
    for (; first < last; ++first) {
      sum += votes[first];
      squares += votes[first] * votes[first];
    }
    test.mean = sum / count;
    test.deviation =
        std::sqrt (std::max (LEAST_VARIANCE, squares / count - test.mean * test.mean));
    test.significance = test.mean / test.deviation * std::sqrt (count);
  }

  RayParity rays_;
  const VotingNodes& nodes_;
  Workers workers_;
};

/** \brief How closed the parts are: of each the mean of what rays say of its clusters,
 * whatever their signs.
 */
std::vector<double>
closednessOf (const std::vector<RayTest>& tests, const Parts& parts)
{
  std::vector<double> sums (parts.count, 0.0);
  std::vector<double> sizes (parts.count, 0.0);
  for (const RayTest& test : tests) {
    const auto size = static_cast<double> (test.size);
    sums[parts.of_node[test.root]] += size * std::abs (test.mean);
    sizes[parts.of_node[test.root]] += size;
  }
  for (std::size_t i = 0; i < sums.size(); ++i)
    sums[i] = sizes[i] > 0.0 ? sums[i] / sizes[i] : 0.0;
  return sums;
}

/** \brief What rays say of the clusters that they are asked about, and what of it
 * counts.
 */
struct RayVotes {
  std::vector<RayTest> tests;
  /** of each part how closed it is (see closednessOf) */
  std::vector<double> closedness;

  bool
  isClosed (index_t part) const
  {
    constexpr double CLOSED = 0.35;
    return closedness[part] >= CLOSED;
  }

  /** \brief Whether rays agree about a cluster, from 1, that its root looks outward, to
   * -1; 0 where they have nothing to say.
   */
  static double
  verdict (const RayTest& test)
  {
    constexpr double LEAST = 0.1;
    constexpr double SIGNIFICANT = 3.0;
    constexpr double FULL = 0.5;
    if (std::abs (test.mean) < LEAST || std::abs (test.significance) < SIGNIFICANT)
      return 0.0;
    return std::clamp (test.mean / FULL, -1.0, 1.0);
  }
};

/** \brief Patches as far as they are whole, and pieces of those that are not: rays find
 * ways out on both sides of these.
 */
class Clusters {
public:
  Clusters (const std::vector<SignVote>& votes, const VotingNodes& nodes)
  {
    // Of votes along a border, how far they have to agree, and how many that takes.
    constexpr float AGREED = 0.9F;
    constexpr float ENOUGH = 1.5F;
    const std::size_t count = nodes.sizes.size();
    SignedContraction graph (nodes.sizes);
    addVotes (
        votes, [&nodes] (index_t i) { return nodes.placeOf (i); }, graph);
    graph.contract (AGREED, ENOUGH, PIECE);
    pieces_ = clustersOf (graph, count);
    graph.contract (AGREED, ENOUGH, nodes.of_sample.size());
    clusters_ = clustersOf (graph, count);
  }

  /** \brief Asks rays about all clusters, and takes torn patches to pieces. */
  std::vector<RayTest>
  test (const RayTester& tester)
  {
    constexpr std::size_t PATCH_TESTS = 100;
    constexpr std::size_t PIECE_TESTS = 12;
    constexpr double TORN_DEVIATION = 0.4;
    constexpr double TORN_MEAN = 0.6;
    const std::size_t count = clusters_.size();
    std::vector<std::uint8_t> is_torn (count, 0);
    std::vector<RayTest> tests;
    for (const RayTest& test :
         tester.test (clusters_, std::vector<std::uint8_t> (count, 1), PATCH_TESTS))
      if (test.deviation > TORN_DEVIATION && std::abs (test.mean) < TORN_MEAN &&
          test.size > PIECE)
        is_torn[test.root] = 1;
      else
        tests.push_back (test);
    std::vector<std::uint8_t> is_piece (count, 0);
    for (std::size_t i = 0; i < count; ++i)
      if (is_torn[clusters_[i].root] != 0) {
        clusters_[i] = pieces_[i];
        is_piece[clusters_[i].root] = 1;
      }
    const std::vector<RayTest> of_pieces =
        tester.test (clusters_, is_piece, PIECE_TESTS);
    tests.insert (tests.end(), of_pieces.begin(), of_pieces.end());
    return tests;
  }

  /** \brief Of a node its cluster. */
  const SignedSets::Place&
  operator[] (std::size_t node) const
  {
    return clusters_[node];
  }

private:
  std::vector<SignedSets::Place> pieces_;
  std::vector<SignedSets::Place> clusters_;
};

/** \brief The signs of nodes. */
struct NodeSigns {
  std::vector<std::uint8_t> turned;
  /** how far votes agree where a node is joined to the rest of its part */
  std::vector<float> agreement;
};

/** \brief Joins all clusters of each part by votes and rays. */
NodeSigns
joinClusters (const std::vector<SignVote>& votes,
              const VotingNodes& nodes,
              const Parts& parts,
              const Clusters& clusters,
              const RayVotes& rays)
{
  const std::size_t count = nodes.sizes.size();
  // Clusters by the nodes that they are known by, and behind them what is outside.
  std::vector<index_t> number (count, -1);
  std::vector<std::size_t> sizes;
  for (std::size_t i = 0; i < count; ++i) {
    index_t& of_root = number[clusters[i].root];
    if (of_root < 0) {
      of_root = static_cast<index_t> (sizes.size());
      sizes.push_back (0);
    }
    sizes[of_root] += nodes.sizes[i];
  }
  const auto outside = static_cast<index_t> (sizes.size());
  sizes.push_back (0);
  SignedContraction graph (std::move (sizes));
  addVotes (
      votes,
      [&] (index_t i) {
        const SignedSets::Place node = nodes.placeOf (i);
        const SignedSets::Place& cluster = clusters[node.root];
        return SignedSets::Place{number[cluster.root], node.turned != cluster.turned};
      },
      graph);
  // Rays count as much as all votes along the border of a cluster, which are those of
  // other clusters until the first ray adds to them.
  std::vector<float> weights;
  for (const RayTest& test : rays.tests)
    weights.push_back (static_cast<float> (RayVotes::verdict (test)) *
                       (1.0F + graph.border (number[test.root])));
  for (std::size_t i = 0; i < weights.size(); ++i)
    if (weights[i] != 0.0F && rays.isClosed (parts.of_node[rays.tests[i].root]))
      graph.vote (outside, number[rays.tests[i].root], weights[i]);
  graph.contract (0.0F, 0.0F, nodes.of_sample.size());

  NodeSigns signs;
  const std::vector<float> agreements = graph.agreements();
  const SignedSets::Place of_outside = graph.find (outside);
  for (std::size_t i = 0; i < count; ++i) {
    const index_t cluster = number[clusters[i].root];
    const SignedSets::Place place = graph.find (cluster);
    const bool turned = place.turned != clusters[i].turned;
    const bool outside_turned = place.root == of_outside.root && of_outside.turned;
    signs.turned.push_back (turned != outside_turned ? 1 : 0);
    signs.agreement.push_back (agreements[cluster]);
  }
  return signs;
}

/** \brief Of each part what rays say of it on the whole, when all have their signs. */
std::vector<float>
outwardOf (const RayVotes& rays, const Parts& parts, const NodeSigns& signs)
{
  std::vector<double> sums (parts.count, 0.0);
  std::vector<double> sizes (parts.count, 0.0);
  for (const RayTest& test : rays.tests) {
    const auto size = static_cast<double> (test.size);
    sums[parts.of_node[test.root]] +=
        signs.turned[test.root] != 0 ? -size * test.mean : size * test.mean;
    sizes[parts.of_node[test.root]] += size;
  }
  std::vector<float> outward (parts.count, 0.0F);
  for (std::size_t p = 0; p < outward.size(); ++p)
    if (sizes[p] > 0.0 && rays.isClosed (static_cast<index_t> (p)))
      outward[p] = static_cast<float> (sums[p] / sizes[p]);
  return outward;
}

/** \brief Of each node how sure its sign is: by rays where they have a verdict about
 * its cluster, unless votes are surer and rays do not contradict them.
 */
std::vector<float>
trustOf (const RayVotes& rays,
         const Parts& parts,
         const Clusters& clusters,
         const NodeSigns& signs)
{
  std::vector<double> verdicts (parts.of_node.size(), 0.0);
  for (const RayTest& test : rays.tests)
    if (rays.isClosed (parts.of_node[test.root])) {
      const double verdict = RayVotes::verdict (test);
      verdicts[test.root] = signs.turned[test.root] != 0 ? -verdict : verdict;
    }
  std::vector<float> trust;
  for (std::size_t i = 0; i < parts.of_node.size(); ++i) {
    const auto verdict = static_cast<float> (verdicts[clusters[i].root]);
    trust.push_back (verdict < 0.0F ? 0.0F : std::max (verdict, signs.agreement[i]));
  }
  return trust;
}

} // namespace

ConsistentSigns
findConsistentSigns (const std::vector<SignVote>& votes,
                     const PlaneFits& fits,
                     const Workers& workers)
{
  const std::size_t samples = fits.size();
  const VotingNodes nodes = joinSamples (votes, samples);
  const Parts parts = connect (votes, nodes);
  Clusters clusters (votes, nodes);
  RayVotes rays;
  rays.tests = clusters.test (RayTester (fits, nodes, workers));
  rays.closedness = closednessOf (rays.tests, parts);
  const NodeSigns of_node = joinClusters (votes, nodes, parts, clusters, rays);
  const std::vector<float> trust = trustOf (rays, parts, clusters, of_node);

  ConsistentSigns signs;
  signs.outward = outwardOf (rays, parts, of_node);
  signs.turned.resize (samples);
  signs.part.resize (samples);
  signs.trust.resize (samples);
  for (std::size_t i = 0; i < samples; ++i) {
    const index_t node = nodes.of_sample[i];
    signs.turned[i] = nodes.turned[i] != of_node.turned[node] ? 1 : 0;
    signs.part[i] = fits.normals[i].isZero (0.0F) ? -1 : parts.of_node[node];
    signs.trust[i] = trust[node];
  }
  return signs;
}

} // namespace crest
} // namespace pcl
