// SPDX-License-Identifier: BSD-3-Clause
#include "surface/surface_nodes.h"

#include "sampling/node_gathering.h"
#include "search/position_tree.h"
#include "surface/flat_places.h"

#include <cmath>

namespace pcl {
namespace crest {

namespace {

/** \brief How far apart nodes have to be at each sample: a node of m samples has 1 /
 * sqrt (m) of their noise, and sqrt (m) times their spacing.
 */
std::vector<float>
nodeSpacings (const FlatPlaces& places, double noise_of_nodes)
{
  // Discs that are as dense as they can be have their centres this much farther apart,
  // in the mean, than they are allowed to be.
  constexpr double MEAN_OVER_LEAST = 1.2;
  const double samples = typicalNoise (places) / noise_of_nodes;
  std::vector<float> spacings = places.spacings;
  for (float& spacing : spacings)
    spacing *= static_cast<float> (std::sqrt (samples) / MEAN_OVER_LEAST);
  return spacings;
}

/** \brief The means of gathered samples. */
OrientedPoints
meansOf (const OrientedPoints& samples,
         const FlatPlaces& places,
         const GatheredSamples& gathered)
{
  std::vector<Eigen::Vector3d> positions (gathered.nodes, Eigen::Vector3d::Zero());
  std::vector<Eigen::Vector3d> normals = positions;
  std::vector<double> counts (gathered.nodes, 0.0);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const index_t node = gathered.node_of[i];
    positions[node] += samples.positions[i].cast<double>();
    normals[node] += places.normals[i].cast<double>();
    counts[node] += 1.0;
  }
  OrientedPoints nodes;
  nodes.extent = samples.extent;
  nodes.unit = samples.unit;
  nodes.packed_index = gathered.node_of;
  nodes.cloud_index.assign (gathered.nodes, OrientedPoints::INVALID);
  for (std::size_t node = 0; node < gathered.nodes; ++node) {
    positions[node] /= counts[node];
    nodes.positions.emplace_back (positions[node].cast<float>());
    // All are within 60 degrees of the centre's: the sum is not zero.
    nodes.normals.emplace_back (normals[node].normalized().cast<float>());
  }
  std::vector<double> least (gathered.nodes, 0.0);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const index_t node = gathered.node_of[i];
    const double squared =
        (samples.positions[i].cast<double>() - positions[node]).squaredNorm();
    index_t& nearest = nodes.cloud_index[node];
    if (nearest == OrientedPoints::INVALID || squared < least[node]) {
      nearest = static_cast<index_t> (i);
      least[node] = squared;
    }
  }
  return nodes;
}

} // namespace

OrientedPoints
gatherOnSurface (const OrientedPoints& samples,
                 double noise_of_nodes,
                 const Workers& workers)
{
  const FlatPlaces places = flattenPlaces (samples, workers);
  const std::shared_ptr<const PointTree> tree =
      treeOver (places.positions, workers.threads);
  return meansOf (samples,
                  places,
                  gatherSamples (*tree,
                                 places.positions,
                                 nodeSpacings (places, noise_of_nodes),
                                 workers,
                                 &places.normals));
}

OrientedPoints
nodesOfCloud (const OrientedPoints& samples, OrientedPoints nodes)
{
  std::vector<index_t> packed_index = samples.packed_index;
  for (index_t& point : packed_index)
    if (point != OrientedPoints::INVALID)
      point = nodes.packed_index[point];
  nodes.packed_index = std::move (packed_index);
  for (index_t& point : nodes.cloud_index)
    point = samples.cloud_index[point];
  return nodes;
}

} // namespace crest
} // namespace pcl
