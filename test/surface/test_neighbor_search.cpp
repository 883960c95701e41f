// SPDX-License-Identifier: BSD-3-Clause
// The searches for candidate neighbours against each other.
#include <gtest/gtest.h>

#include "search/point_tree.h"
#include "support/analytic_surface.h"
#include "support/kd_tree.h"
#include "support/stage_inputs.h"
#include "surface/neighbor_search.h"
#include "surface/surface_graph.h"
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <random>

using namespace pcl::crest;

namespace {

using Candidates = std::vector<std::vector<index_t>>;
using Cloud = pcl::PointCloud<pcl::PointNormal>;

Candidates
allOf (const OrientedPoints& points, const NeighborSearch& search, int threads = 1)
{
  Candidates candidates (points.size());
  const auto size = static_cast<index_t> (points.size());
#pragma omp parallel for num_threads(threads) schedule(dynamic, 3)
  for (index_t i = 0; i < size; ++i) {
    std::vector<index_t>& found = candidates[i];
    search (i, found);
    std::sort (found.begin(), found.end());
  }
  return candidates;
}

Candidates
byKdTree (const OrientedPoints& points, int k)
{
  Parameters parameters;
  parameters.k = k;
  return allOf (points, oracle::kdTreeSearch (points, parameters));
}

Candidates
byLeaves (const OrientedPoints& points, int k)
{
  const auto tree = treeOver (points.positions, 1);
  Candidates candidates (points.size());
  visitLeaves (*tree,
               k,
               0,
               points.size(),
               [&] (index_t point, const std::vector<index_t>& found) {
                 candidates[point] = found;
                 std::sort (candidates[point].begin(), candidates[point].end());
               });
  return candidates;
}

Cloud
cloudOf (const std::vector<Eigen::Vector3f>& positions)
{
  Cloud cloud;
  for (const Eigen::Vector3f& p : positions)
    cloud.emplace_back (p.x(), p.y(), p.z(), 0.0F, 0.0F, 1.0F);
  return cloud;
}

/** \brief Clouds that are hard for one reason each. */
std::vector<Cloud>
clouds ()
{
  std::vector<Cloud> result{*oracle::sample (oracle::ridgeAndValley(), 3000)};
  std::vector<Eigen::Vector3f> lattice;
  for (int y = 0; y < 50; ++y)
    for (int x = 0; x < 50; ++x)
      lattice.emplace_back (
          0.1F * static_cast<float> (x), 0.1F * static_cast<float> (y), 0.0F);
  result.push_back (cloudOf (lattice));
  std::mt19937 random (1);
  std::uniform_real_distribution<float> coordinate (-1.0F, 1.0F);
  std::vector<Eigen::Vector3f> clusters;
  for (int i = 0; i < 3000; ++i) {
    const float size = std::pow (10.0F, -static_cast<float> (i % 4));
    clusters.emplace_back (5e5F + size * coordinate (random),
                           size * coordinate (random),
                           size * coordinate (random) + static_cast<float> (i % 7));
  }
  result.push_back (cloudOf (clusters));
  // More than 8 k are equally far from the tip of a cone.
  constexpr int MERIDIANS = 800;
  std::vector<Eigen::Vector3f> cone{Eigen::Vector3f::Zero()};
  for (int ring = 1; ring <= 4; ++ring)
    for (int i = 0; i < MERIDIANS; ++i) {
      const double angle = 2.0 * M_PI * i / MERIDIANS;
      cone.emplace_back (
          (ring * Eigen::Vector3d (std::cos (angle), std::sin (angle), -1.0))
              .cast<float>());
    }
  result.push_back (cloudOf (cone));
  result.push_back (cloudOf ({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
  return result;
}

} // namespace

TEST (NeighborSearch, BatchesFindWhatKdTreesFind)
{
  for (const Cloud& cloud : clouds()) {
    const OrientedPoints points = oracle::pack (cloud);
    for (const int k : {4, 24, 96}) {
      const Candidates expected = byKdTree (points, k);
      EXPECT_EQ (byLeaves (points, k), expected);
      const NeighborSearch single = batchedSearch (treeOver (points.positions, 1), k);
      EXPECT_EQ (allOf (points, single), expected);
      EXPECT_EQ (allOf (points, single, 4), expected);
    }
  }
}

TEST (NeighborSearch, BothGiveTheSameSurfaceGraph)
{
  for (const Cloud& cloud : clouds()) {
    const OrientedPoints points = oracle::pack (cloud);
    Parameters parameters;
    const SurfaceGraph expected = buildSurfaceGraph (
        points, oracle::kdTreeSearch (points, parameters), parameters);
    for (const unsigned threads : {1U, 4U}) {
      parameters.threads = threads;
      const SurfaceGraph graph =
          buildSurfaceGraph (points, treeOver (points.positions, threads), parameters);
      EXPECT_EQ (graph.offsets, expected.offsets);
      EXPECT_EQ (graph.neighbors, expected.neighbors);
      EXPECT_EQ (graph.boundary, expected.boundary);
      EXPECT_EQ (graph.spacing, expected.spacing);
      EXPECT_EQ (graph.mean_spacing, expected.mean_spacing);
    }
  }
}

TEST (NeighborSearch, NoPointsHaveNoCandidates)
{
  const OrientedPoints points;
  EXPECT_EQ (
      buildSurfaceGraph (points, treeOver (points.positions, 1), Parameters()).size(),
      0U);
}
