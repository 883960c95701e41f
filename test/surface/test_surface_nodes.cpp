// SPDX-License-Identifier: BSD-3-Clause
// Places in a noisy surface, and nodes of it: against the surface that is known.
#include <gtest/gtest.h>

#include "search/position_tree.h"
#include "support/extraction.h"
#include "support/noisy_cloud.h"
#include "support/sharp_solids.h"
#include "support/stage_inputs.h"
#include "surface/flat_places.h"
#include "surface/surface_nodes.h"

#include <algorithm>
#include <cmath>

using namespace pcl::crest;
using Cloud = pcl::PointCloud<pcl::PointNormal>;

namespace {

/** \brief A sphere of radius 1 with noise of one spacing, and normals from it. */
OrientedPoints
noisySphere (double& noise)
{
  const Cloud::Ptr exact = oracle::sample (oracle::sphere (1.0), 10000);
  noise = oracle::meanSpacing (*exact);
  return oracle::pack (*oracle::withNoise (*exact, noise));
}

/** \brief The root mean square of distances from the sphere. */
double
spread (const std::vector<Eigen::Vector3f>& positions)
{
  double sum = 0.0;
  for (const Eigen::Vector3f& p : positions)
    sum += std::pow (p.cast<double>().norm() - 1.0, 2);
  return std::sqrt (sum / static_cast<double> (positions.size()));
}

TEST (FlatPlaces, AreNearTheSurface)
{
  double noise = 0.0;
  const OrientedPoints samples = noisySphere (noise);
  ASSERT_NEAR (spread (samples.positions) / noise, 1.0, 0.1);
  const FlatPlaces places = flattenPlaces (samples, 2);
  // Six terms of 48 samples or more leave a third of their noise, in the middle less.
  EXPECT_LT (spread (places.positions), 0.35 * noise);
  double cosine = 0.0;
  for (std::size_t i = 0; i < places.positions.size(); ++i)
    cosine += places.normals[i].dot (places.positions[i].normalized());
  EXPECT_GT (cosine / static_cast<double> (places.positions.size()), 0.98);
}

TEST (FlatPlaces, SheetsStayApart)
{
  const Cloud::Ptr exact = oracle::sample (oracle::box (1.0, 1.0, 0.1), 10000);
  const double h = oracle::meanSpacing (*exact);
  // The sheets are eight spacings apart, and 96 neighbours see both.
  const Cloud::Ptr noisy = oracle::addNoise (*exact, h);
  const OrientedPoints samples = oracle::pack (*noisy);
  const FlatPlaces places = flattenPlaces (samples, 2);
  std::size_t inside = 0;
  std::size_t right = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const Eigen::Vector3f& p = places.positions[i];
    const Eigen::Vector3f& n =
        (*exact)[static_cast<std::size_t> (samples.cloud_index[i])]
            .getNormalVector3fMap();
    if (std::abs (n.z()) < 0.5F || p.x() < 0.1F || p.x() > 0.9F || p.y() < 0.1F ||
        p.y() > 0.9F)
      continue;
    ++inside;
    right += places.normals[i].dot (n) > 0.9F ? 1 : 0;
  }
  ASSERT_GT (inside, samples.size() / 10);
  EXPECT_GT (right, inside * 97 / 100);
}

TEST (FlatPlaces, NoiseIsThatOfTheSamples)
{
  const Cloud::Ptr exact = oracle::sample (oracle::sphere (1.0), 10000);
  const double h = std::sqrt (4.0 * M_PI / static_cast<double> (exact->size()));
  for (const double noise : {0.05, 0.2, 0.5, 1.0}) {
    const OrientedPoints samples = oracle::pack (*oracle::addNoise (*exact, noise * h));
    const NeighborSearch search = batchedSearch (treeOver (samples.positions, 2), 48);
    // The quarter of windows with the least, and the nearest in space at 1 h, have
    // less.
    const double found = typicalNoise (samples, search) / noise;
    EXPECT_GT (found, 0.65) << noise;
    EXPECT_LT (found, 1.05) << noise;
  }
}

TEST (SurfaceNodes, AreMeansOfTheirSamplesWithLessNoise)
{
  double noise = 0.0;
  const OrientedPoints samples = noisySphere (noise);
  const OrientedPoints nodes = gatherOnSurface (samples, 0.4, 2);
  ASSERT_EQ (nodes.packed_index.size(), samples.size());
  ASSERT_EQ (nodes.normals.size(), nodes.size());
  ASSERT_EQ (nodes.cloud_index.size(), nodes.size());
  std::vector<Eigen::Vector3d> sums (nodes.size(), Eigen::Vector3d::Zero());
  std::vector<double> counts (nodes.size(), 0.0);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const index_t node = nodes.packed_index[i];
    ASSERT_GE (node, 0);
    ASSERT_LT (static_cast<std::size_t> (node), nodes.size());
    sums[node] += samples.positions[i].cast<double>();
    counts[node] += 1.0;
  }
  for (std::size_t node = 0; node < nodes.size(); ++node) {
    EXPECT_LT (
        (sums[node] / counts[node] - nodes.positions[node].cast<double>()).norm(),
        1e-5);
    EXPECT_EQ (nodes.packed_index[nodes.cloud_index[node]],
               static_cast<index_t> (node));
  }
  // Noise falls with the root of the samples of a node only if these are side by side.
  const double mean_samples =
      static_cast<double> (samples.size()) / static_cast<double> (nodes.size());
  EXPECT_NEAR (spread (nodes.positions) / (noise / std::sqrt (mean_samples)), 1.0, 0.3);
  const NeighborSearch search = batchedSearch (treeOver (nodes.positions, 2), 48);
  EXPECT_LT (typicalNoise (nodes, search), 0.45);
  EXPECT_GT (typicalNoise (nodes, search), 0.2);
}

TEST (SurfaceNodes, AreTheSameForAnyThreads)
{
  double noise = 0.0;
  const OrientedPoints samples = noisySphere (noise);
  const OrientedPoints one = gatherOnSurface (samples, 0.3, 1);
  const OrientedPoints three = gatherOnSurface (samples, 0.3, 3);
  EXPECT_EQ (one.positions, three.positions);
  EXPECT_EQ (one.normals, three.normals);
  EXPECT_EQ (one.packed_index, three.packed_index);
}

TEST (SurfaceNodes, EdgesOfABoxAreFoundThroughNoise)
{
  const oracle::SharpSolid box = oracle::box (1.0, 0.8, 0.6);
  const Cloud::Ptr exact = oracle::sample (box, 20000);
  const double h = oracle::meanSpacing (*exact);
  for (const double noise : {0.55, 1.0}) {
    const Cloud::Ptr cloud = oracle::withNoise (*exact, noise * h);
    const oracle::CrestRun run = oracle::extract (cloud);
    const oracle::LineScore found = oracle::scoreLines (run.lines,
                                                        *run.line_cloud,
                                                        oracle::trueCrestLines (box),
                                                        CrestType::RIDGE,
                                                        2.0 * h);
    EXPECT_GT (found.precision, 0.95) << noise;
    EXPECT_GT (found.recall, 0.95) << noise;
    ASSERT_EQ (run.labels.size(), cloud->size());
    // What noise has thrown far off has no surface.
    const auto invalid = std::count_if (
        run.labels.begin(), run.labels.end(), [] (const pcl::Label& label) {
          return label.label == LABEL_INVALID;
        });
    EXPECT_LT (static_cast<std::size_t> (invalid), cloud->size() / 50) << noise;
  }
}

} // namespace
