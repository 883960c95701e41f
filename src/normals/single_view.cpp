// SPDX-License-Identifier: BSD-3-Clause
#include "normals/single_view.h"

#include <pcl_crest/normal_estimation.h>

#include "base/parallel.h"
#include "normals/sign_votes.h"
#include "normals/signed_sets.h"
#include "search/ball_search.h"
#include "search/position_tree.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <tuple>

namespace pcl {
namespace crest {

bool
isSeenFrom (const PlaneFits& fits,
            const Eigen::Vector3f& viewpoint,
            const Workers& workers)
{
  constexpr double MOST_HIDDEN = 0.08;
  // So many tell it well enough.
  constexpr std::size_t TRIED = 20000;
  // In spacings: how near to a ray a sample covers it, and how far behind it something
  // has to be to be no noise.
  constexpr double COVERS = 0.5;
  constexpr double BEHIND = 5.0;

  std::vector<double> ranges;
  std::vector<double> spacings;
  std::vector<Eigen::Vector3f> directions;
  for (std::size_t i = 0; i < fits.size(); ++i) {
    const Eigen::Vector3f ray = fits.positions[i] - viewpoint;
    if (ray.isZero (0.0F))
      continue;
    ranges.push_back (ray.cast<double>().norm());
    spacings.push_back (fits.spacing (i));
    directions.emplace_back (ray.stableNormalized());
  }
  if (ranges.empty())
    return false;
  const std::shared_ptr<const PointTree> tree = treeOver (directions, workers.threads);

  const std::size_t step = (ranges.size() + TRIED - 1) / TRIED;
  const std::size_t tried = (ranges.size() + step - 1) / step;
  std::atomic<std::size_t> hidden{0};
  forEachBlock (tried, workers, [&] (std::size_t, std::size_t first, std::size_t last) {
    for (std::size_t k = first; k < last; ++k) {
      const std::size_t i = k * step;
      const double behind = ranges[i] - BEHIND * spacings[i];
      if (spacings[i] == 0.0 || behind <= 0.0)
        continue;
      const auto covers = [&] (index_t q) {
        return ranges[q] < ranges[i] - BEHIND * std::max (spacings[q], spacings[i]);
      };
      // The search ends with the first, as of points on a line to the viewpoint all are
      // found.
      if (anyWithin (
              *tree, directions[i].data(), COVERS * spacings[i] / ranges[i], covers))
        ++hidden;
    }
  });
  return static_cast<double> (hidden) < MOST_HIDDEN * static_cast<double> (tried);
}

std::optional<SeenNormals>
faceViewpoint (const PointTree& tree,
               const PlaneFits& fits,
               const Eigen::Vector3f& viewpoint,
               const Workers& workers)
{
  // Steeper than 11 degrees: normals of scans are less wrong than that.
  constexpr float SURE_COSINE = 0.2F;
  constexpr double MOST = 0.5;
  SeenNormals seen{fits.plain, std::vector<float> (fits.size(), 0.0F)};
  SignedSets sets (fits.size());
  std::vector<index_t> unsure;
  index_t sure = -1;
  std::size_t with_normal = 0;
  for (std::size_t i = 0; i < fits.size(); ++i) {
    Eigen::Vector3f& normal = seen.normals[i];
    if (normal.isZero (0.0F))
      continue;
    ++with_normal;
    const auto sample = static_cast<index_t> (i);
    const Eigen::Vector3f ray = viewpoint - fits.positions[i];
    const float cosine = normal.dot (ray.stableNormalized());
    if (cosine < 0.0F)
      normal = -normal;
    if (std::abs (cosine) < SURE_COSINE) {
      unsure.push_back (sample);
      continue;
    }
    seen.trust[i] = 1.0F;
    if (sure < 0)
      sure = sample;
    sets.unite (sure, sample, false);
  }
  if (static_cast<double> (unsure.size()) > MOST * static_cast<double> (with_normal))
    return std::nullopt;
  if (unsure.empty())
    return seen;
  std::vector<SignVote> votes = findVotes (tree, fits, seen.normals, unsure, workers);
  std::sort (votes.begin(), votes.end(), [] (const SignVote& v, const SignVote& w) {
    return std::make_tuple (-std::abs (v.agreement), v.a, v.b) <
           std::make_tuple (-std::abs (w.agreement), w.a, w.b);
  });
  for (const SignVote& vote : votes)
    sets.unite (vote.a, vote.b, vote.agreement < 0.0F);
  const SignedSets::Place well_seen = sets.find (sure);
  for (const index_t sample : unsure) {
    const SignedSets::Place place = sets.find (sample);
    if (place.root != well_seen.root)
      continue;
    seen.trust[sample] = SURE_SIGN;
    if (place.turned != well_seen.turned)
      seen.normals[sample] = -seen.normals[sample];
  }
  return seen;
}

} // namespace crest
} // namespace pcl
