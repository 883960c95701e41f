// SPDX-License-Identifier: BSD-3-Clause
#include "normal_orientation.h"

#include <pcl/kdtree/kdtree_flann.h>

#include "../parallel.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

namespace pcl {
namespace crest {

namespace {

constexpr int NEIGHBORS = 12;

struct Edge {
  float weight;
  index_t a;
  index_t b;
  bool opposite;

  bool
  operator<(const Edge& other) const
  {
    return std::tie (weight, a, b) < std::tie (other.weight, other.a, other.b);
  }
};

/** \brief Disjoint sets whose members know whether they are turned against the root. */
class SignedSets {
public:
  explicit SignedSets (std::size_t size) : parent_ (size), turned_ (size, 0)
  {
    std::iota (parent_.begin(), parent_.end(), 0);
  }

  struct Place {
    index_t root;
    bool turned;
  };

  Place
  find (index_t i)
  {
    Place place{i, false};
    while (parent_[place.root] != place.root) {
      place.turned ^= turned_[place.root] != 0;
      place.root = parent_[place.root];
    }
    for (bool turned = place.turned; parent_[i] != place.root && i != place.root;) {
      const index_t next = parent_[i];
      const bool step = turned_[i] != 0;
      parent_[i] = place.root;
      turned_[i] = turned ? 1 : 0;
      turned ^= step;
      i = next;
    }
    return place;
  }

  void
  unite (index_t a, index_t b, bool opposite)
  {
    const Place of_a = find (a);
    const Place of_b = find (b);
    if (of_a.root == of_b.root)
      return;
    parent_[of_b.root] = of_a.root;
    turned_[of_b.root] = (of_a.turned ^ of_b.turned ^ opposite) ? 1 : 0;
  }

private:
  std::vector<index_t> parent_;
  std::vector<char> turned_;
};

/** \brief What decides the side of a part; sums weighted by area. */
struct Part {
  double area = 0.0;
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  double volume = 0.0;
  double largest_volume = 0.0;
  double facing = 0.0;
};

/** \brief Finds the edges of the graph, and how much of the surface a point stands for,
 * up to a factor.
 */
void
findEdges (const pcl::PointCloud<pcl::PointXYZ>& points,
           const std::vector<Eigen::Vector3f>& normals,
           unsigned threads,
           std::vector<Edge>& edges,
           std::vector<double>& areas)
{
  pcl::KdTreeFLANN<pcl::PointXYZ> tree;
  tree.setInputCloud (points.makeShared());
  areas.assign (points.size(), 0.0);
  std::vector<std::vector<Edge>> blocks (blockCount (points.size()));
  forEachBlock (
      points.size(), threads, [&] (std::size_t block, std::size_t i, std::size_t end) {
        pcl::Indices found;
        std::vector<float> distances;
        for (; i < end; ++i) {
          const auto a = static_cast<index_t> (i);
          tree.nearestKSearch (points[i], NEIGHBORS + 1, found, distances);
          areas[i] = distances.empty() ? 0.0 : distances.back();
          for (const index_t b : found) {
            const Eigen::Vector3f& n = normals[a];
            const Eigen::Vector3f& m = normals[b];
            if (a == b || n.isZero (0.0F) || m.isZero (0.0F))
              continue;
            const Eigen::Vector3f e =
                (points[b].getVector3fMap() - points[a].getVector3fMap())
                    .stableNormalized();
            const float agreement = n.dot (m) - 2.0F * n.dot (e) * m.dot (e);
            blocks[block].push_back ({1.0F - std::abs (agreement),
                                      std::min (a, b),
                                      std::max (a, b),
                                      agreement < 0.0F});
          }
        }
      });
  for (const std::vector<Edge>& block : blocks)
    edges.insert (edges.end(), block.begin(), block.end());
}

/** \brief Whether a part has to be turned over as a whole. */
bool
decideSide (const Part& part, bool has_viewpoint, Orientation& orientation)
{
  // Net normals of a closed surface vanish; a quarter leaves room for scans with holes
  // and uneven sampling. A hemisphere has one half, a height field nearly one.
  constexpr double MOST_OPEN = 0.25;
  constexpr double LEAST_VOLUME = 0.01;
  constexpr double CLEAR_VOTE = 0.5;
  if (part.normal.norm() < MOST_OPEN * part.area &&
      std::abs (part.volume) > LEAST_VOLUME * part.largest_volume) {
    ++orientation.outward;
    return part.volume < 0.0;
  }
  if (has_viewpoint && std::abs (part.facing) > CLEAR_VOTE * part.area) {
    ++orientation.toward_viewpoint;
    return part.facing < 0.0;
  }
  ++orientation.upward;
  return part.normal.z() < 0.0;
}

} // namespace

Orientation
orientNormals (const pcl::PointCloud<pcl::PointXYZ>& points,
               const std::optional<Eigen::Vector3f>& viewpoint,
               unsigned threads,
               std::vector<Eigen::Vector3f>& normals)
{
  std::vector<Edge> edges;
  std::vector<double> areas;
  findEdges (points, normals, threads, edges, areas);
  std::sort (edges.begin(), edges.end());
  SignedSets sets (points.size());
  for (const Edge& edge : edges)
    sets.unite (edge.a, edge.b, edge.opposite);

  std::vector<index_t> root (points.size());
  std::vector<Part> parts (points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const SignedSets::Place place = sets.find (static_cast<index_t> (i));
    root[i] = place.root;
    if (place.turned)
      normals[i] = -normals[i];
    if (normals[i].isZero (0.0F))
      continue;
    Part& part = parts[place.root];
    part.area += areas[i];
    part.center += areas[i] * points[i].getVector3fMap().cast<double>();
    part.normal += areas[i] * normals[i].cast<double>();
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    Part& part = parts[root[i]];
    if (normals[i].isZero (0.0F) || part.area == 0.0)
      continue;
    const Eigen::Vector3d position = points[i].getVector3fMap().cast<double>();
    const Eigen::Vector3d normal = areas[i] * normals[i].cast<double>();
    const Eigen::Vector3d arm = position - part.center / part.area;
    part.volume += normal.dot (arm);
    part.largest_volume += areas[i] * arm.norm();
    if (viewpoint)
      part.facing +=
          std::copysign (areas[i], normal.dot (viewpoint->cast<double>() - position));
  }
  Orientation orientation;
  std::vector<char> turn (points.size(), 0);
  for (std::size_t i = 0; i < points.size(); ++i)
    if (parts[i].area > 0.0)
      turn[i] = decideSide (parts[i], viewpoint.has_value(), orientation) ? 1 : 0;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (turn[root[i]] != 0)
      normals[i] = -normals[i];
  return orientation;
}

} // namespace crest
} // namespace pcl
