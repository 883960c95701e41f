// SPDX-License-Identifier: BSD-3-Clause
#include "normals/sharp_normals.h"

#include "base/parallel.h"
#include "normals/part_sides.h"
#include "normals/sign_votes.h"
#include "search/leaf_search.h"

#include <algorithm>
#include <limits>

namespace pcl {
namespace crest {

namespace {

/** Of the sample's own scatter: what is so much better is another surface. */
constexpr float BETTER = 0.5F;

/** \brief The samples whose window is no plane, while some of those around may be so
 * much better: not where noise makes all of them rough.
 */
std::vector<index_t>
findRough (const PlaneFits& fits)
{
  // Of the window's radius: less than at an edge of 20 degrees.
  constexpr float ROUGH = 0.03F;
  constexpr std::size_t GROUP = 128;
  std::vector<index_t> rough;
  for (std::size_t first = 0; first < fits.size(); first += GROUP) {
    const std::size_t last = std::min (first + GROUP, fits.size());
    float least = std::numeric_limits<float>::infinity();
    for (std::size_t i = first; i < last; ++i)
      if (!fits.plain[i].isZero (0.0F))
        least = std::min (least, fits.sigmas[i]);
    for (std::size_t i = first; i < last; ++i)
      if (!fits.plain[i].isZero (0.0F) && fits.sigmas[i] > ROUGH * fits.radii[i] &&
          least < BETTER * fits.sigmas[i])
        rough.push_back (static_cast<index_t> (i));
  }
  return rough;
}

} // namespace

void
sharpenNormals (const PointTree& tree, PlaneFits& fits, const Workers& workers)
{
  const std::vector<index_t> rough = findRough (fits);
  std::vector<Eigen::Vector3f> chosen (rough.size());
  forEachBlock (
      rough.size(), workers, [&] (std::size_t, std::size_t i, std::size_t last) {
        LeafSearch search (tree, {PlaneFits::NEAREST});
        for (; i < last; ++i) {
          const auto sample = static_cast<std::size_t> (rough[i]);
          const LeafNeighbors& found = search.searchPoint (rough[i]);
          chosen[i] = fits.plain[sample];
          float least = BETTER * BETTER * fits.sigmas[sample] * fits.sigmas[sample];
          for (std::size_t j = found.offsets[0]; j < found.offsets[1]; ++j) {
            const auto other = static_cast<std::size_t> (found.places[j]);
            const Eigen::Vector3f& normal = fits.plain[other];
            const float height =
                normal.dot (fits.positions[sample] - fits.positions[other]) -
                fits.heights[other];
            const float misfit =
                fits.sigmas[other] * fits.sigmas[other] + height * height;
            if (misfit < least && !normal.isZero (0.0F)) {
              least = misfit;
              chosen[i] = normal;
            }
          }
        }
      });
  for (std::size_t i = 0; i < rough.size(); ++i)
    fits.plain[rough[i]] = chosen[i];
}

void
doubtTips (const PointTree& tree,
           const PlaneFits& fits,
           const std::vector<Eigen::Vector3f>& normals,
           const Workers& workers,
           std::vector<float>& trust)
{
  // Of the radius: what a wedge of 40 degrees leaves.
  constexpr float ROUGH = 0.1F;
  constexpr float OPPOSITE = -0.5F;
  // In spacings.
  constexpr float THROUGH = 0.45F;
  forEachBlock (
      fits.size(), workers, [&] (std::size_t, std::size_t i, std::size_t last) {
        LeafSearch search (tree, {PlaneFits::NEAREST});
        for (; i < last; ++i) {
          if (fits.sigmas[i] <= ROUGH * fits.radii[i])
            continue;
          const LeafNeighbors& found =
              search.searchPoint (static_cast<std::int32_t> (i));
          for (std::size_t j = found.offsets[0]; j < found.offsets[1]; ++j) {
            const auto other = static_cast<std::size_t> (found.places[j]);
            const Eigen::Vector3f& normal = normals[other];
            if (normal.dot (normals[i]) < OPPOSITE &&
                std::abs (normal.dot (fits.positions[i] - fits.positions[other])) <
                    THROUGH * fits.spacing (i))
              trust[i] = std::min (trust[i], A_GUESS);
          }
        }
      });
}

std::vector<Eigen::Vector3f>
signedNormals (const PointTree& tree, const PlaneFits& fits, const Workers& workers)
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

} // namespace crest
} // namespace pcl
