// SPDX-License-Identifier: BSD-3-Clause
// The k closest neighbours of section 4.1, through PCL's searches.
#pragma once

#include <pcl_crest/surface_graph.h>

#include <pcl/search/search.h>

#include <algorithm>

namespace pcl {
namespace crest {

/** \brief The neighbours of a point through any of PCL's searches: k with the point
 * itself, or all within the radius.
 *
 * Points as far away as the k-th are all found, because which of them a search
 * returns depends on its inner order. Where more than 8 k are equally far, the search
 * chooses.
 *
 * \param[in] search a search whose input cloud is set
 * \param[in] query the query point
 * \param[in] parameters k and radius are used
 * \param[out] found indices into the input cloud of the search, in no special order
 */
template <typename PointT>
void
findNeighbors (const pcl::search::Search<PointT>& search,
               const PointT& query,
               const Parameters& parameters,
               pcl::Indices& found)
{
  thread_local std::vector<float> distances;
  thread_local std::vector<float> ranked;
  if (parameters.radius > 0.0) {
    search.radiusSearch (query, parameters.radius, found, distances);
    return;
  }
  const int k = parameters.k;
  for (int wanted = k + 1;; wanted *= 2) {
    search.nearestKSearch (query, wanted, found, distances);
    if (found.size() <= static_cast<std::size_t> (k))
      return;
    ranked = distances;
    const auto kth = ranked.begin() + (k - 1);
    std::nth_element (ranked.begin(), kth, ranked.end());
    const float limit = *kth;
    const bool complete = found.size() < static_cast<std::size_t> (wanted) ||
                          *std::max_element (kth, ranked.end()) > limit ||
                          wanted > 8 * k;
    if (!complete)
      continue;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < found.size(); ++i)
      if (distances[i] <= limit)
        found[kept++] = found[i];
    found.resize (kept);
    return;
  }
}

/** \brief The default: PCL's KdTree over the packed points. */
NeighborSearch
kdTreeSearch (const OrientedPoints& points, const Parameters& parameters);

} // namespace crest
} // namespace pcl
