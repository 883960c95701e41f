// SPDX-License-Identifier: BSD-3-Clause
#include "surface/neighbor_search.h"

#include "search/ball_search.h"
#include "search/leaf_search.h"

#include <algorithm>
#include <mutex>
#include <stdexcept>
#include <utility>

namespace pcl {
namespace crest {

namespace {

/** \brief The point itself is the first of the k. */
NeighborCount
candidateCount (int k)
{
  return {k - 1, EQUIDISTANT, mostCandidates (k) - 1};
}

/** \brief The i-th point and its neighbours. */
void
copyIndices (const PointTree& tree,
             const LeafNeighbors& neighbors,
             int i,
             std::vector<index_t>& found)
{
  const std::size_t first = neighbors.offsets[i];
  const std::size_t count = neighbors.offsets[i + 1] - first;
  found.resize (1 + count);
  found[0] = tree.index (neighbors.first + i);
  for (std::size_t j = 0; j < count; ++j)
    found[1 + j] = tree.index (neighbors.places[first + j]);
}

/** \brief Searches for single points from several threads. */
class SharedSearch {
public:
  SharedSearch (std::shared_ptr<const PointTree> tree, int k)
  : tree_ (std::move (tree)), k_ (k), places_ (tree_->places())
  {}

  void
  find (index_t point, std::vector<index_t>& found)
  {
    std::unique_ptr<LeafSearch> search = take();
    copyIndices (*tree_, search->searchPoint (places_[point]), 0, found);
    giveBack (std::move (search));
  }

private:
  std::unique_ptr<LeafSearch>
  take ()
  {
    const std::lock_guard<std::mutex> lock (mutex_);
    if (idle_.empty())
      return std::make_unique<LeafSearch> (*tree_, candidateCount (k_));
    std::unique_ptr<LeafSearch> search = std::move (idle_.back());
    idle_.pop_back();
    return search;
  }

  void
  giveBack (std::unique_ptr<LeafSearch> search)
  {
    const std::lock_guard<std::mutex> lock (mutex_);
    idle_.push_back (std::move (search));
  }

  std::shared_ptr<const PointTree> tree_;
  int k_;
  /** of each point its place in the tree */
  std::vector<index_t> places_;
  std::mutex mutex_;
  /** what a thread needs for a search, while none has it */
  std::vector<std::unique_ptr<LeafSearch>> idle_;
};

} // namespace

void
keepNearest (const OrientedPoints& points,
             index_t point,
             int k,
             std::vector<index_t>& found)
{
  const auto most = static_cast<std::size_t> (mostCandidates (k));
  if (found.size() <= most)
    return;
  const auto scaled = [&points, scale = 1.0 / points.unit] (index_t i) {
    return Eigen::Vector3f ((scale * points.positions[i].cast<double>()).cast<float>());
  };
  const Eigen::Vector3f p = scaled (point);
  std::vector<std::pair<float, index_t>> others;
  for (const index_t q : found)
    if (q != point) {
      const Eigen::Vector3f d = scaled (q) - p;
      others.emplace_back ((d.x() * d.x() + d.y() * d.y()) + d.z() * d.z(), q);
    }
  std::sort (others.begin(), others.end());
  others.erase (std::unique (others.begin(), others.end()), others.end());
  others.resize (std::min (others.size(), most - 1));
  found.assign (1, point);
  for (const auto& [squared_distance, q] : others)
    found.push_back (q);
}

NeighborSearch
searchOver (const OrientedPoints& points,
            const SearchMaker& make,
            const Parameters& parameters)
{
  const double scale = 1.0 / points.unit;
  std::vector<Eigen::Vector3f> scaled;
  scaled.reserve (points.size());
  for (const Eigen::Vector3f& p : points.positions)
    scaled.emplace_back ((scale * p.cast<double>()).cast<float>());
  NeighborSearch search = make (scaled, parameters.k, scale * parameters.radius);
  if (!search)
    throw std::invalid_argument ("The search maker of the request made no search");
  if (parameters.radius > 0.0)
    return search;
  return [&points, search = std::move (search), k = parameters.k] (
             index_t point, std::vector<index_t>& found) {
    search (point, found);
    keepNearest (points, point, k, found);
  };
}

void
visitLeaves (
    const PointTree& tree,
    int k,
    std::size_t first,
    std::size_t last,
    const std::function<void (index_t point, const std::vector<index_t>& found)>& use)
{
  LeafSearch search (tree, candidateCount (k));
  std::vector<index_t> found;
  for (std::size_t place = first; place < last; place += LEAF_SIZE) {
    const LeafNeighbors& neighbors = search.searchLeaf (place / LEAF_SIZE);
    for (int i = 0; i < neighbors.count; ++i) {
      copyIndices (tree, neighbors, i, found);
      use (tree.index (neighbors.first + i), found);
    }
  }
}

NeighborSearch
batchedSearch (const std::shared_ptr<const PointTree>& tree, int k)
{
  return
      [search = std::make_shared<SharedSearch> (tree, k)] (
          index_t point, std::vector<index_t>& found) { search->find (point, found); };
}

NeighborSearch
radiusSearch (const OrientedPoints& points,
              const std::shared_ptr<const PointTree>& tree,
              double radius)
{
  return [&points, tree, radius] (index_t point, std::vector<index_t>& found) {
    findWithin (*tree, points.positions[point].data(), radius, found);
  };
}

} // namespace crest
} // namespace pcl
