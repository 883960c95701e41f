// SPDX-License-Identifier: BSD-3-Clause
#include "normals/sharp_normals.h"

#include "base/parallel.h"
#include "search/leaf_search.h"

#include <algorithm>
#include <limits>

namespace pcl {
namespace crest {

namespace {

/** \brief A plane and how far its window scatters about it. */
struct ScatteredPlane {
  Eigen::Vector3f normal;
  float offset;
  float sigma;
};

/** \brief The samples whose window is no plane, while some of those around may be so
 * much better: not where noise makes all of them rough.
 */
std::vector<index_t>
findRough (const PlaneFits& fits, float better)
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
          least < better * fits.sigmas[i])
        rough.push_back (static_cast<index_t> (i));
  }
  return rough;
}

} // namespace

void
sharpenNormals (const PointTree& tree, PlaneFits& fits, const Workers& workers)
{
  // Each carries planes a neighbourhood further, to what no window is beside.
  constexpr int ROUNDS = 3;
  constexpr float BETTER = 0.5F;
  std::vector<ScatteredPlane> planes;
  planes.reserve (fits.size());
  for (std::size_t i = 0; i < fits.size(); ++i)
    planes.push_back ({fits.plain[i],
                       fits.plain[i].dot (fits.positions[i]) + fits.heights[i],
                       fits.sigmas[i]});
  const std::vector<index_t> rough = findRough (fits, BETTER);
  const auto misfit = [&] (const ScatteredPlane& plane, std::size_t sample) {
    const float height = plane.normal.dot (fits.positions[sample]) - plane.offset;
    return plane.sigma * plane.sigma + height * height;
  };
  std::vector<ScatteredPlane> chosen (rough.size());
  for (int round = 0; round < ROUNDS; ++round) {
    forEachBlock (
        rough.size(), workers, [&] (std::size_t, std::size_t i, std::size_t last) {
          LeafSearch search (tree, {PlaneFits::NEAREST});
          for (; i < last; ++i) {
            const auto sample = static_cast<std::size_t> (rough[i]);
            const LeafNeighbors& found = search.searchPoint (rough[i]);
            chosen[i] = planes[sample];
            float least = BETTER * BETTER * planes[sample].sigma * planes[sample].sigma;
            for (std::size_t j = found.offsets[0]; j < found.offsets[1]; ++j) {
              const ScatteredPlane& plane = planes[found.places[j]];
              const float here = misfit (plane, sample);
              if (here < least && !plane.normal.isZero (0.0F)) {
                least = here;
                chosen[i] = plane;
              }
            }
          }
        });
    for (std::size_t i = 0; i < rough.size(); ++i)
      planes[rough[i]] = chosen[i];
  }
  for (const index_t i : rough)
    fits.plain[i] = planes[i].normal;
}

} // namespace crest
} // namespace pcl
