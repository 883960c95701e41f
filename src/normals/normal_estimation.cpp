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

/** \brief The normals of the k nearest with the signs of the windows that noise asked
 * for. Where the two look elsewhere, as at rims of thin plates, the neighbours decide.
 */
std::vector<Eigen::Vector3f>
withSigns (const PointTree& tree, const PlaneFits& fits, const Workers& workers)
{
  constexpr float ALONG = 0.7F;
  // In spacings.
  constexpr float LOW_NOISE = 0.25F;
  std::vector<Eigen::Vector3f> normals = fits.plain;
  std::vector<index_t> unlike;
  for (std::size_t i = 0; i < fits.size(); ++i) {
    const float cosine = normals[i].dot (fits.normals[i]);
    if (cosine < 0.0F)
      normals[i] = -normals[i];
    if (std::abs (cosine) < ALONG && fits.errors[i] < LOW_NOISE * fits.spacing (i))
      unlike.push_back (static_cast<index_t> (i));
  }
  const std::vector<float> votes = sumVotes (tree, fits, normals, unlike, workers);
  for (std::size_t i = 0; i < unlike.size(); ++i)
    if (votes[i] < 0.0F)
      normals[unlike[i]] = -normals[unlike[i]];
  return normals;
}

/** \brief What a sensor at the viewpoint tells of samples that it saw alone; none if it
 * looks along most of the surface.
 */
std::optional<SampleNormals>
lookToViewpoint (const PointTree& tree,
                 const PlaneFits& fits,
                 const Eigen::Vector3f& viewpoint,
                 const Workers& workers)
{
  std::optional<SeenNormals> seen = faceViewpoint (tree, fits, viewpoint, workers);
  if (!seen)
    return std::nullopt;
  SampleNormals result;
  result.single_view = true;
  result.normals = std::move (seen->normals);
  result.trust = std::move (seen->trust);
  result.part.assign (fits.size(), 0);
  result.sides = {{NormalSide::VIEWPOINT, false, 1.0F}};
  return result;
}

/** \brief The hints with what the spacing of the samples tells of a viewpoint that
 * nobody set.
 * \param[in] origin of the cloud, in the unit of the fits
 */
NormalHints
weighViewpoint (const PlaneFits& fits,
                const NormalHints& hints,
                const Eigen::Vector3f& origin,
                const Workers& workers)
{
  NormalHints weighed = hints;
  if (hints.viewpoint && (!hints.viewpoint_assumed || hints.organized))
    return weighed;
  if (areSpacedAsSeenFrom (fits, origin, workers) &&
      isSeenFrom (fits, origin, workers)) {
    weighed.viewpoint = origin;
    weighed.organized = true;
  }
  else if (hints.viewpoint && areSpacedAsOnMap (fits, workers))
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
    if (auto seen = lookToViewpoint (tree, fits, *hints.viewpoint, workers))
      return std::move (*seen);
  ConsistentSigns signs =
      findConsistentSigns (findVotes (tree, fits, workers), fits, workers);
  for (std::size_t i = 0; i < fits.size(); ++i)
    if (signs.turned[i] != 0) {
      fits.normals[i] = -fits.normals[i];
      fits.middles[i] = -fits.middles[i];
    }
  SignedParts parts{withSigns (tree, fits, workers),
                    std::move (signs.part),
                    std::move (signs.outward)};
  PartSides sides = decideSides (fits, parts, hints);
  if (hints.viewpoint && !(sides.is_model_around && hints.viewpoint_assumed) &&
      isSeenFrom (fits, *hints.viewpoint, workers))
    if (auto seen = lookToViewpoint (tree, fits, *hints.viewpoint, workers))
      return std::move (*seen);
  SampleNormals result;
  result.normals = std::move (parts.normals);
  result.part = std::move (parts.part);
  result.trust = std::move (signs.trust);
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
  std::vector<NormalPart> parts;
  for (const PartSide& side : samples.sides)
    parts.push_back ({0, side.side, 0.0F});
  std::vector<double> trust (parts.size(), 0.0);
  for (std::size_t place = 0; place < tree.size; ++place) {
    if (samples.normals[place].isZero (0.0F))
      continue;
    const index_t part = samples.part[place];
    const index_t position = tree.index (static_cast<std::int32_t> (place));
    for (std::size_t i = distinct.begins[position]; i < distinct.begins[position + 1];
         ++i) {
      const index_t point = distinct.points[i].cloud_index;
      estimate.normals[point] = samples.normals[place];
      estimate.variation[point] = fits.variation[place];
      estimate.trust[point] = samples.trust[place];
      estimate.part[point] = part;
      trust[part] += samples.trust[place];
      ++parts[part].points;
    }
  }
  const std::vector<index_t> rank = rankParts (parts);
  estimate.parts.resize (static_cast<std::size_t> (
      std::count_if (rank.begin(), rank.end(), [] (index_t r) { return r >= 0; })));
  for (std::size_t i = 0; i < parts.size(); ++i)
    if (rank[i] >= 0) {
      parts[i].trust =
          static_cast<float> (trust[i] / static_cast<double> (parts[i].points));
      estimate.parts[rank[i]] = parts[i];
    }
  for (index_t& part : estimate.part)
    if (part >= 0)
      part = rank[part];
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
  checkPoints (request.cloud);
  if (request.hints.viewpoint && !request.hints.viewpoint->allFinite())
    refuse ("The viewpoint is not finite: set one that is, or none");
  const std::optional<Eigen::Vector3f>& up = request.hints.up;
  if (up && (!up->allFinite() || up->isZero (0.0F)))
    refuse ("The up direction is zero or not finite: set a direction, as 0 0 1");
}

} // namespace

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
  const Eigen::Vector3f origin = distinct.fromViewpoint (Eigen::Vector3f::Zero()) /
                                 static_cast<float> (tree->unit);
  const SampleNormals samples = orientSamples (
      *tree, fits, weighViewpoint (fits, hints, origin, workers), workers);
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
  for (NormalPart& part : estimate.parts)
    part.points = 0;
  for (const index_t node : nodes.node_of) {
    const bool is_known = node >= 0 && found.part[node] >= 0;
    estimate.normals.push_back (is_known ? found.normals[node]
                                         : Eigen::Vector3f::Zero().eval());
    estimate.variation.push_back (is_known ? found.variation[node] : 0.0F);
    estimate.trust.push_back (is_known ? found.trust[node] : 0.0F);
    estimate.part.push_back (is_known ? found.part[node] : -1);
    if (is_known)
      ++estimate.parts[found.part[node]].points;
  }
  return estimate;
}

NormalEstimate
estimateNormals (const NormalRequest& request)
{
  checkRequest (request);
  Progress progress (request.progress);
  progress.beginStage ("normals", 1.0);
  const Workers workers (request.threads, &progress);
  NormalEstimate estimate = estimateNormals (
      request,
      request.gathers ? resolveSamples (request.cloud, workers) : SampleNodes(),
      workers);
  progress.finish();
  return estimate;
}

std::string
explainDoubt (const NormalEstimate& estimate)
{
  const std::size_t unsure = estimate.countUnsure();
  if (unsure == 0)
    return {};
  const auto is_unsure = [] (const NormalPart& part) { return part.trust < SURE_SIGN; };
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
