// SPDX-License-Identifier: BSD-3-Clause
#include "normals/sharp_normals.h"

#include "base/parallel.h"
#include "normals/consensus_plane.h"
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

/** \brief A sample whose window is no plane, and the least scatter of the windows
 * around.
 */
struct RoughSample {
  index_t place;
  float least;
};

/** \brief Those where some of the windows around may be so much better: not where noise
 * makes all of them rough.
 */
std::vector<RoughSample>
findRough (const PlaneFits& fits)
{
  // Of the window's radius: less than at an edge of 20 degrees.
  constexpr float ROUGH = 0.03F;
  constexpr std::size_t GROUP = 128;
  std::vector<RoughSample> rough;
  for (std::size_t first = 0; first < fits.size(); first += GROUP) {
    const std::size_t last = std::min (first + GROUP, fits.size());
    float least = std::numeric_limits<float>::infinity();
    for (std::size_t i = first; i < last; ++i)
      if (!fits.plain[i].isZero (0.0F))
        least = std::min (least, fits.sigmas[i]);
    for (std::size_t i = first; i < last; ++i)
      if (!fits.plain[i].isZero (0.0F) && fits.sigmas[i] > ROUGH * fits.radii[i] &&
          least < BETTER * fits.sigmas[i])
        rough.push_back ({static_cast<index_t> (i), least});
  }
  return rough;
}

/** \brief Chooses normals for rough samples. Belongs to one thread. */
class SharpNormals {
public:
  SharpNormals (const PointTree& tree, const PlaneFits& fits)
  : fits_ (fits), search_ (tree, {WINDOW})
  {}

  Eigen::Vector3f
  choose (const RoughSample& rough)
  {
    const auto sample = static_cast<std::size_t> (rough.place);
    const LeafNeighbors& found = search_.searchPoint (rough.place);
    Eigen::Vector3f chosen = fits_.plain[sample];
    float least = square (BETTER * fits_.sigmas[sample]);
    const std::size_t first = found.offsets[0];
    const std::size_t last = found.offsets[1];
    for (std::size_t j = first; j < std::min (last, first + PlaneFits::NEAREST); ++j) {
      const auto other = static_cast<std::size_t> (found.places[j]);
      const Eigen::Vector3f& normal = fits_.plain[other];
      const float height =
          normal.dot (fits_.positions[sample] - fits_.positions[other]) -
          fits_.heights[other];
      const float misfit = square (fits_.sigmas[other]) + square (height);
      if (misfit < least && !normal.isZero (0.0F)) {
        least = misfit;
        chosen = normal;
      }
    }
    const float spacing = fits_.spacing (sample);
    const float tolerance = std::max (CLEAN * spacing, OUTERMOST * rough.least);
    if (least <= square (tolerance) || tolerance > NOISY * spacing)
      return chosen;
    offsets_.resize (last - first);
    for (std::size_t j = first; j < last; ++j)
      offsets_.set (
          j - first,
          (fits_.positions[found.places[j]] - fits_.positions[sample]).cast<double>());
    return consensusPlane (offsets_, tolerance).value_or (chosen);
  }

private:
  static constexpr int WINDOW = 24;
  /** In spacings: how far off the plane of a face its samples are at least and at most,
   * if noise is to leave enough of them on it, and of others few.
   */
  static constexpr float CLEAN = 0.03F;
  static constexpr float NOISY = 0.25F;
  /** In standard deviations. */
  static constexpr float OUTERMOST = 3.0F;

  static float
  square (float x)
  {
    return x * x;
  }

  const PlaneFits& fits_;
  LeafSearch search_;
  Coordinates offsets_;
};

} // namespace

void
sharpenNormals (const PointTree& tree, PlaneFits& fits, const Workers& workers)
{
  // In spacings: what the signs in the tips of wedges stand. Windows of two sheets tell
  // better than one plane which sheet a sample is on.
  constexpr float HARDLY_NOISY = 0.06F;
  const std::vector<RoughSample> rough = findRough (fits);
  std::vector<Eigen::Vector3f> chosen (rough.size());
  forEachBlock (
      rough.size(), workers, [&] (std::size_t, std::size_t i, std::size_t last) {
        SharpNormals normals (tree, fits);
        for (; i < last; ++i)
          chosen[i] = normals.choose (rough[i]);
      });
  for (std::size_t i = 0; i < rough.size(); ++i) {
    const auto sample = static_cast<std::size_t> (rough[i].place);
    const bool changes = chosen[i] != fits.plain[sample];
    fits.plain[sample] = chosen[i];
    if (changes && fits.middles[sample] == 0.0F &&
        fits.errors[sample] < HARDLY_NOISY * fits.spacing (sample))
      fits.normals[sample] = chosen[i];
  }
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
