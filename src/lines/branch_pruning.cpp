// SPDX-License-Identifier: BSD-3-Clause
#include "lines/branch_pruning.h"

#include "base/large_arrays.h"
#include "lines/forest.h"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <queue>
#include <tuple>

namespace pcl {
namespace crest {

namespace {

/** \brief A branch as it was when it was measured; pruning elsewhere may have made it
 * longer since, never shorter.
 */
struct Branch {
  /** of what decides, points or a part of the limit */
  float size;
  float length;
  index_t end;

  bool
  operator> (const Branch& o) const
  {
    return std::tie (size, length, end) > std::tie (o.size, o.length, o.end);
  }
};

/** \brief A graph that loses its branches. Of the neighbours of a point it keeps the
 * number and the exclusive or, which is all that a walk asks for: an end has one
 * neighbour, and on the way the one that is not behind comes next.
 */
class BranchGraph {
public:
  BranchGraph (std::size_t size, const std::vector<CrestEdge>& edges)
  : nodes_ (makeLarge (size, Node()))
  {
    for (const CrestEdge& edge : edges) {
      join (edge.a, edge.b);
      join (edge.b, edge.a);
    }
  }

  index_t
  size () const
  {
    return static_cast<index_t> (nodes_.size());
  }
  bool
  isEnd (index_t point) const
  {
    return nodes_[point].degree == 1;
  }
  bool
  isJunction (index_t point) const
  {
    return nodes_[point].degree > 2;
  }

  /** \brief Removes branches of one edge from junctions that are between two other
   * points as well: all of these go, in whichever order. Most branches are such, and
   * need not be sorted then.
   *
   * \param[in] edges those that the graph was made of
   */
  void
  removeTwigs (const std::vector<CrestEdge>& edges)
  {
    // Of each point the neighbours that are no ends, counted up to two.
    std::vector<std::uint8_t> inner = makeLarge<std::uint8_t> (nodes_.size(), 0);
    const auto count = [&] (index_t point, index_t neighbor) {
      if (!isEnd (neighbor) && inner[point] < 2)
        ++inner[point];
    };
    for (const CrestEdge& edge : edges) {
      count (edge.a, edge.b);
      count (edge.b, edge.a);
    }
    const auto removeTwig = [&] (index_t end, index_t junction) {
      if (!isEnd (end) || inner[junction] < 2)
        return;
      nodes_[end] = Node();
      detach (junction, end);
    };
    for (const CrestEdge& edge : edges) {
      removeTwig (edge.a, edge.b);
      removeTwig (edge.b, edge.a);
    }
  }

  /** \brief Walks from an end to the next point that does not simply go on, or until
   * the path has `limit` points.
   */
  void
  walk (index_t end, std::size_t limit, std::vector<index_t>& path) const
  {
    path.assign ({end, nodes_[end].neighbors});
    while (nodes_[path.back()].degree == 2 && path.size() < limit)
      path.push_back (nodes_[path.back()].neighbors ^ path[path.size() - 2]);
  }

  /** \brief Removes the edges of the path from an end to a junction. */
  void
  remove (const std::vector<index_t>& path)
  {
    for (std::size_t i = 0; i + 1 < path.size(); ++i)
      nodes_[path[i]] = Node();
    detach (path.back(), path[path.size() - 2]);
  }

  /** \brief Erases those of the edges that the graph was made of that are removed. */
  void
  eraseRemoved (std::vector<CrestEdge>& edges) const
  {
    edges.erase (std::remove_if (edges.begin(),
                                 edges.end(),
                                 [this] (const CrestEdge& e) {
                                   return nodes_[e.a].degree == 0 ||
                                          nodes_[e.b].degree == 0;
                                 }),
                 edges.end());
  }

private:
  struct Node {
    index_t neighbors = 0;
    int degree = 0;
  };

  void
  join (index_t point, index_t neighbor)
  {
    nodes_[point].neighbors ^= neighbor;
    ++nodes_[point].degree;
  }

  void
  detach (index_t point, index_t neighbor)
  {
    nodes_[point].neighbors ^= neighbor;
    --nodes_[point].degree;
  }

  std::vector<Node> nodes_;
};

/** \brief Prunes the branches of up to the largest size, smallest first.
 * \param[in] size the size of a branch, from its points with the junction's at the end
 * \param[in] most points that a branch of the largest size can have without it
 */
template <typename Size>
void
prune (const OrientedPoints& points,
       float largest,
       std::size_t most,
       const Size& size,
       BranchGraph& graph)
{
  // The path of a branch ends with its junction, and has one point more if too long.
  std::vector<index_t> path;
  const auto isShortBranch = [&] (index_t end) {
    graph.walk (end, most + 2, path);
    return graph.isJunction (path.back()) && size (path) <= largest;
  };
  const auto measure = [&] (index_t end) {
    return Branch{size (path), static_cast<float> (polylineLength (points, path)), end};
  };

  std::vector<Branch> branches;
  for (index_t p = 0; p < graph.size(); ++p)
    if (graph.isEnd (p) && isShortBranch (p))
      branches.push_back (measure (p));
  std::sort (branches.begin(), branches.end(), std::greater<>());
  // The few that became longer wait beside the many that are sorted at once.
  std::priority_queue<Branch, std::vector<Branch>, std::greater<>> longer;
  while (!branches.empty() || !longer.empty()) {
    Branch shortest{};
    if (longer.empty() || (!branches.empty() && longer.top() > branches.back())) {
      shortest = branches.back();
      branches.pop_back();
    }
    else {
      shortest = longer.top();
      longer.pop();
    }
    if (!isShortBranch (shortest.end))
      continue;
    if (size (path) > shortest.size)
      longer.push (measure (shortest.end));
    else
      graph.remove (path);
  }
}

} // namespace

std::vector<CrestEdge>
pruneBranches (const OrientedPoints& points,
               std::vector<CrestEdge> forest,
               std::size_t largest)
{
  BranchGraph trees (points.size(), forest);
  const auto count = [] (const std::vector<index_t>& path) {
    return static_cast<float> (path.size() - 1);
  };
  const std::size_t most = std::max<std::size_t> (1, largest);
  trees.removeTwigs (forest);
  prune (points, static_cast<float> (most), most, count, trees);
  trees.eraseRemoved (forest);
  return forest;
}

std::vector<CrestEdge>
pruneShortBranches (const OrientedPoints& points,
                    std::vector<CrestEdge> edges,
                    const std::vector<float>& limits)
{
  BranchGraph graph (points.size(), edges);
  const auto part_of_limit = [&] (const std::vector<index_t>& path) {
    return static_cast<float> (polylineLength (points, path)) / limits[path.back()];
  };
  prune (points, 1.0F, points.size(), part_of_limit, graph);
  graph.eraseRemoved (edges);
  return edges;
}

} // namespace crest
} // namespace pcl
