// SPDX-License-Identifier: BSD-3-Clause
#include "normals/normal_estimation.h"

#include <pcl_crest/parameters.h>

#include "normals/consistent_signs.h"
#include "normals/part_sides.h"
#include "normals/sample_spacing.h"
#include "normals/scaled_hints.h"
#include "normals/sharp_normals.h"
#include "normals/single_view.h"
#include "search/position_tree.h"
#include "search/stray_points.h"

#include <algorithm>
#include <stdexcept>

namespace pcl {
namespace crest {

namespace {

/** \brief Normals by samples' places in the tree. */
struct SampleNormals {
  std::vector<Eigen::Vector3f> normals;
  std::vector<float> trust;
  std::vector<index_t> part;
  std::vector<PartSide> sides;
  bool single_view = false;
};

/** \brief What a sensor at the viewpoint tells of samples that it saw alone; none if it
 * looks along most of the surface.
 *
 * \param[in] trust that there was a sensor
 */
std::optional<SampleNormals>
lookToViewpoint (const PointTree& tree,
                 const PlaneFits& fits,
                 const Eigen::Vector3f& viewpoint,
                 float trust,
                 const Workers& workers)
{
  std::optional<SeenNormals> seen = faceViewpoint (tree, fits, viewpoint, workers);
  if (!seen)
    return std::nullopt;
  SampleNormals result;
  result.single_view = true;
  result.normals = std::move (seen->normals);
  result.trust = std::move (seen->trust);
  for (float& t : result.trust)
    t = std::min (t, trust);
  result.part.assign (fits.size(), 0);
  result.sides = {{NormalSide::VIEWPOINT, false, trust}};
  return result;
}

/** \brief The hints with what the spacing of the samples tells of a viewpoint that
 * nobody set: it stays assumed where that tells nothing.
 *
 * \param[in] hints in the unit of the fits
 */
NormalHints
weighViewpoint (const PlaneFits& fits, const NormalHints& hints, const Workers& workers)
{
  NormalHints weighed = hints;
  if (hints.viewpoint && !hints.viewpoint_assumed)
    return weighed;
  weighed.organized = hints.viewpoint && hints.organized
                          ? !areGridOfMap (fits, workers)
                          : areSpacedAsSeenFrom (fits, hints.origin, workers) &&
                                isSeenFrom (fits, hints.origin, workers);
  weighed.viewpoint_assumed = !weighed.organized;
  if (weighed.organized)
    weighed.viewpoint = hints.origin;
  else if (hints.viewpoint && (hints.up || areSpacedAsOnMap (fits, workers)))
    weighed.viewpoint.reset();
  return weighed;
}

SampleNormals
orientSamples (const PointTree& tree,
               PlaneFits& fits,
               const NormalHints& hints,
               const Workers& workers)
{
  // An image of a sensor, which sees no surface from behind.
  if (hints.viewpoint && hints.organized)
    if (auto seen = lookToViewpoint (tree, fits, *hints.viewpoint, 1.0F, workers))
      return std::move (*seen);
  ConsistentSigns signs =
      findConsistentSigns (findVotes (tree, fits, workers), fits, workers);
  turnBy (signs, fits);
  SignedParts parts{signedNormals (tree, fits, workers),
                    std::move (signs.part),
                    std::move (signs.outward)};
  PartSides sides = decideSides (fits, parts, hints);
  if (hints.viewpoint && (!hints.viewpoint_assumed || sides.may_be_view) &&
      isSeenFrom (fits, *hints.viewpoint, workers))
    if (auto seen = lookToViewpoint (tree,
                                     fits,
                                     *hints.viewpoint,
                                     hints.viewpoint_assumed ? A_GUESS : 1.0F,
                                     workers))
      return std::move (*seen);
  SampleNormals result;
  result.normals = std::move (parts.normals);
  result.part = std::move (parts.part);
  result.trust = std::move (signs.trust);
  doubtTips (tree, fits, result.normals, workers, result.trust);
  for (std::size_t i = 0; i < fits.size(); ++i)
    if (fits.between[i] != 0)
      result.trust[i] = std::min (result.trust[i], A_GUESS);
  result.sides = std::move (sides.of_parts);
  for (std::size_t i = 0; i < fits.size(); ++i)
    if (result.part[i] >= 0) {
      const PartSide& side = result.sides[result.part[i]];
      result.trust[i] = std::min (result.trust[i], side.trust);
      if (side.turned)
        result.normals[i] = -result.normals[i];
    }
  return result;
}

/** \brief The numbers of parts by their sizes, the largest first; -1 for those of no
 * points.
 */
std::vector<index_t>
rankParts (const std::vector<NormalPart>& parts)
{
  std::vector<index_t> order;
  for (std::size_t i = 0; i < parts.size(); ++i)
    if (parts[i].points != 0)
      order.push_back (static_cast<index_t> (i));
  std::stable_sort (order.begin(), order.end(), [&parts] (index_t a, index_t b) {
    return parts[a].points > parts[b].points;
  });
  std::vector<index_t> rank (parts.size(), -1);
  for (std::size_t i = 0; i < order.size(); ++i)
    rank[order[i]] = static_cast<index_t> (i);
  return rank;
}

/** \brief Counts the points of each part and takes the mean of their trust; the largest
 * parts come first then, and those of no points are gone.
 */
void
countParts (NormalEstimate& estimate)
{
  std::vector<double> trust (estimate.parts.size(), 0.0);
  for (NormalPart& part : estimate.parts)
    part.points = 0;
  for (std::size_t i = 0; i < estimate.part.size(); ++i)
    if (estimate.part[i] >= 0) {
      ++estimate.parts[estimate.part[i]].points;
      trust[estimate.part[i]] += estimate.trust[i];
    }
  for (std::size_t i = 0; i < trust.size(); ++i)
    estimate.parts[i].trust =
        static_cast<float> (trust[i] / static_cast<double> (estimate.parts[i].points));
  const std::vector<index_t> rank = rankParts (estimate.parts);
  std::vector<NormalPart> ranked (static_cast<std::size_t> (
      std::count_if (rank.begin(), rank.end(), [] (index_t r) { return r >= 0; })));
  for (std::size_t i = 0; i < rank.size(); ++i)
    if (rank[i] >= 0)
      ranked[rank[i]] = estimate.parts[i];
  estimate.parts = std::move (ranked);
  for (index_t& part : estimate.part)
    if (part >= 0)
      part = rank[part];
}

/** \brief Gives the points of the cloud what their samples have. */
NormalEstimate
estimateOf (const PointView& cloud,
            const DistinctPoints& distinct,
            const PointTree& tree,
            const PlaneFits& fits,
            const SampleNormals& samples)
{
  NormalEstimate estimate;
  estimate.single_view = samples.single_view;
  estimate.normals.assign (cloud.size, Eigen::Vector3f::Zero());
  estimate.variation.assign (cloud.size, 0.0F);
  estimate.trust.assign (cloud.size, 0.0F);
  estimate.part.assign (cloud.size, -1);
  for (const PartSide& side : samples.sides)
    estimate.parts.push_back ({0, side.side, 0.0F});
  for (std::size_t place = 0; place < tree.size; ++place) {
    if (samples.normals[place].isZero (0.0F))
      continue;
    const index_t position = tree.index (static_cast<std::int32_t> (place));
    for (std::size_t i = distinct.begins[position]; i < distinct.begins[position + 1];
         ++i) {
      const index_t point = distinct.points[i].cloud_index;
      estimate.normals[point] = samples.normals[place];
      estimate.variation[point] = fits.variation[place];
      estimate.trust[point] = samples.trust[place];
      estimate.part[point] = samples.part[place];
    }
  }
  countParts (estimate);
  return estimate;
}

void
checkRequest (const NormalRequest& request)
{
  const auto refuse = [] (const std::string& why) {
    throw std::invalid_argument (why);
  };
  if (request.k < 3)
    refuse ("k is " + std::to_string (request.k) +
            ", but normals need at least 3 neighbours");
  if (request.k > MOST_NEIGHBORS)
    refuse ("k is " + std::to_string (request.k) + ", but must be at most " +
            std::to_string (MOST_NEIGHBORS));
  if (request.threads > MOST_THREADS)
    refuse ("There are " + std::to_string (request.threads) +
            " threads, but there must be at most " + std::to_string (MOST_THREADS));
  checkPoints (request.cloud);
  checkHints (request.hints);
}

} // namespace

void
checkHints (const NormalHints& hints)
{
  if (hints.viewpoint && !hints.viewpoint->allFinite())
    throw std::invalid_argument (
        "The viewpoint, or the sensor origin of the cloud, is not finite: set one that "
        "is");
  if (!hints.origin.allFinite())
    throw std::invalid_argument ("The origin of the hints for normals is not finite");
  if (hints.up && (!hints.up->allFinite() || hints.up->isZero (0.0F)))
    throw std::invalid_argument (
        "The up direction is zero or not finite: set a direction, as 0 0 1");
}

NormalEstimate
estimateNormals (const NormalRequest& request, const Workers& workers)
{
  checkRequest (request);
  const PointView& cloud = request.cloud;
  const DistinctPoints distinct = takeDistinct (cloud, workers.threads);
  const std::shared_ptr<const PointTree> tree =
      treeOver (distinct.positions, workers.threads);
  const auto beginPart = [&workers] (int part) {
    if (workers.progress != nullptr)
      workers.progress->beginPart (part, 2);
  };
  beginPart (0);
  PlaneFits fits = fitPlanes (*tree, request.k, workers);
  sharpenNormals (*tree, fits, workers);
  beginPart (1);
  const NormalHints hints = hintsFor (request.hints, distinct, tree->unit);
  const SampleNormals samples =
      orientSamples (*tree, fits, weighViewpoint (fits, hints, workers), workers);
  return estimateOf (cloud, distinct, *tree, fits, samples);
}

NormalEstimate
estimateNormals (const NormalRequest& request,
                 const SampleNodes& nodes,
                 const Workers& workers)
{
  if (nodes.isEmpty())
    return estimateNormals (request, workers);
  NormalRequest of_nodes = request;
  of_nodes.cloud = nodes.view();
  const NormalEstimate found = estimateNormals (of_nodes, workers);
  NormalEstimate estimate;
  estimate.single_view = found.single_view;
  estimate.parts = found.parts;
  for (const index_t node : nodes.node_of) {
    const bool is_known = node >= 0 && found.part[node] >= 0;
    estimate.normals.push_back (is_known ? found.normals[node]
                                         : Eigen::Vector3f::Zero().eval());
    estimate.variation.push_back (is_known ? found.variation[node] : 0.0F);
    estimate.trust.push_back (is_known ? found.trust[node] : 0.0F);
    estimate.part.push_back (is_known ? found.part[node] : -1);
  }
  countParts (estimate);
  return estimate;
}

NormalEstimate
estimateNormals (const NormalRequest& given)
{
  checkRequest (given);
  const NearPoints near_points (given.cloud);
  NormalRequest request = given;
  request.cloud = near_points.view();
  Progress progress (request.progress);
  progress.beginStage ("normals", 1.0);
  const Workers workers (request.threads, &progress);
  std::shared_ptr<const SampleNodes> nodes;
  if (request.gathers)
    nodes =
        std::make_shared<const SampleNodes> (resolveSamples (request.cloud, workers));
  NormalEstimate estimate =
      estimateNormals (request, nodes ? *nodes : SampleNodes(), workers);
  estimate.nodes = std::move (nodes);
  progress.finish();
  return estimate;
}

std::string
explainDoubt (const NormalEstimate& estimate)
{
  constexpr std::size_t HARDLY_ANY = 1000;
  const std::size_t unsure = estimate.countUnsure();
  const auto is_unsure = [] (const NormalPart& part) { return part.trust < SURE_SIGN; };
  if (unsure <= estimate.normals.size() / HARDLY_ANY &&
      std::none_of (estimate.parts.begin(), estimate.parts.end(), is_unsure))
    return {};
  const auto parts =
      std::count_if (estimate.parts.begin(), estimate.parts.end(), is_unsure);
  std::string words = "It is not known to which side " + std::to_string (unsure) +
                      (unsure == 1 ? " normal looks" : " normals look");
  if (parts != 0)
    words += ", among them all of " + std::to_string (parts) + " of " +
             std::to_string (estimate.parts.size()) +
             (estimate.parts.size() == 1 ? " part" : " parts");
  return words + ": ridges and valleys may be swapped there";
}

} // namespace crest
} // namespace pcl
