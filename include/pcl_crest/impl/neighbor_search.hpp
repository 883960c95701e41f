// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_crest/neighbor_search.h>

#include <pcl/search/search.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl {
namespace crest {

/** \brief The neighbours of a point through any of PCL's searches: k with the point
 * itself, or all within the radius.
 *
 * Points as far away as the k-th are all found, however many: which of them a search
 * returns depends on its inner order (see keepNearest).
 *
 * \param[in] search a search whose input cloud is set
 * \param[in] query the query point
 * \param[in] k the number of neighbours, where radius is 0
 * \param[in] radius in the unit of the searched cloud
 * \param[out] found indices into the input cloud of the search, in no special order
 */
template <typename PointT>
void
findNeighbors (const pcl::search::Search<PointT>& search,
               const PointT& query,
               int k,
               double radius,
               pcl::Indices& found)
{
  thread_local std::vector<float> distances;
  thread_local std::vector<float> ranked;
  if (radius > 0.0) {
    search.radiusSearch (query, radius, found, distances);
    return;
  }
  search.nearestKSearch (query, k + 1, found, distances);
  if (found.size() <= static_cast<std::size_t> (k))
    return;
  ranked = distances;
  const auto kth = ranked.begin() + (k - 1);
  std::nth_element (ranked.begin(), kth, ranked.end());
  const auto limit = static_cast<float> (*kth * (1.0 + EQUIDISTANT));
  if (*std::max_element (kth, ranked.end()) <= limit) {
    // Searches leave out what is at the radius itself, and round on the way there.
    constexpr double WIDER = 1.0 + 1e-5;
    const float squared = std::max (limit, std::numeric_limits<float>::min());
    search.radiusSearch (query, WIDER * std::sqrt (squared), found, distances);
  }
  std::size_t kept = 0;
  for (std::size_t i = 0; i < found.size(); ++i)
    if (distances[i] <= limit)
      found[kept++] = found[i];
  found.resize (kept);
}

} // namespace crest
} // namespace pcl
