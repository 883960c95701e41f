// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "curvature/pyramid.h"
#include "support/analytic_surface.h"
#include "support/surface_stages.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <set>

using namespace pcl::crest;
using Cloud = pcl::PointCloud<pcl::PointNormal>;

namespace {

constexpr std::size_t SAMPLES = 6000;

PyramidLevel
levelOf (const Cloud& cloud, int number, unsigned threads = 1)
{
  const oracle::SurfaceStages stages = oracle::surfaceStages (cloud);
  PyramidLevel level =
      finestLevel (stages.points, stages.graph, treeOver (stages.points.positions, 1));
  for (int i = 0; i < number; ++i)
    level = coarserLevel (level, threads);
  return level;
}

/** \brief The nodes of a level as sets of points of the cloud. */
std::set<std::vector<int>>
partition (const Cloud& cloud, const PyramidLevel& level)
{
  const OrientedPoints points = oracle::pack (cloud);
  std::map<index_t, std::vector<int>> members;
  for (std::size_t i = 0; i < cloud.size(); ++i)
    members[level.node_of[points.packed_index[i]]].push_back (static_cast<int> (i));
  std::set<std::vector<int>> sets;
  for (auto& [node, samples] : members)
    sets.insert (samples);
  return sets;
}

} // namespace

TEST (Pyramid, NodesAreMeansOfTheirSamples)
{
  const Cloud::Ptr cloud = oracle::sample (oracle::wavyRidge(), SAMPLES);
  const OrientedPoints points = oracle::pack (*cloud);
  for (const int number : {0, 1, 2}) {
    const PyramidLevel level = levelOf (*cloud, number);
    ASSERT_EQ (level.node_of.size(), points.size());
    std::vector<Eigen::Vector3d> sums (level.size(), Eigen::Vector3d::Zero());
    std::vector<float> counts (level.size(), 0.0F);
    for (std::size_t i = 0; i < points.size(); ++i) {
      sums[level.node_of[i]] += points.positions[i].cast<double>();
      counts[level.node_of[i]] += 1.0F;
    }
    EXPECT_EQ (counts, level.weights);
    for (std::size_t n = 0; n < level.size(); ++n) {
      ASSERT_GT (counts[n], 0.0F);
      EXPECT_LT ((sums[n] / counts[n] - level.positions[n].cast<double>()).norm(),
                 1e-5);
      EXPECT_NEAR (level.normals[n].norm(), 1.0F, 1e-5F);
    }
  }
}

TEST (Pyramid, LatticesHaveFewerNodesOnEachLevel)
{
  // A Fibonacci lattice, whose stars become less symmetric smoothly from place to
  // place.
  constexpr int LATTICE = 20000;
  Cloud cloud;
  for (int i = 0; i < LATTICE; ++i) {
    const double z = 1.0 - (2.0 * i + 1.0) / LATTICE;
    const double angle = M_PI * (1.0 + std::sqrt (5.0)) * i;
    const double r = std::sqrt (1.0 - z * z);
    pcl::PointNormal point;
    point.getVector3fMap() = point.getNormalVector3fMap() =
        Eigen::Vector3d (r * std::cos (angle), r * std::sin (angle), z).cast<float>();
    cloud.push_back (point);
  }
  auto before = static_cast<double> (LATTICE);
  for (const int number : {1, 2}) {
    const auto size = static_cast<double> (levelOf (cloud, number).size());
    EXPECT_GT (before / size, 3.5) << "level " << number;
    before = size;
  }
}

TEST (Pyramid, EachLevelHasAboutAFifthOfTheNodes)
{
  for (const oracle::AnalyticSurface& surface :
       {oracle::plane(), oracle::bumpySphere(), oracle::roundedBox()}) {
    const Cloud::Ptr cloud = oracle::sample (surface, SAMPLES);
    double before = static_cast<double> (cloud->size());
    for (const int number : {1, 2}) {
      const PyramidLevel level = levelOf (*cloud, number);
      const auto size = static_cast<double> (level.size());
      EXPECT_NEAR (before / size, 5.0, 1.5) << surface.name << " level " << number;
      const float largest =
          *std::max_element (level.weights.begin(), level.weights.end());
      EXPECT_LT (largest, 4.0 * static_cast<double> (cloud->size()) / size);
      before = size;
    }
  }
}

TEST (Pyramid, NeighborsAreThoseWhoseSamplesAre)
{
  const Cloud::Ptr cloud = oracle::sample (oracle::bumpySphere(), SAMPLES);
  const oracle::SurfaceStages stages = oracle::surfaceStages (*cloud);
  const PyramidLevel level = coarserLevel (
      finestLevel (stages.points, stages.graph, treeOver (stages.points.positions, 1)),
      1);
  std::set<std::pair<index_t, index_t>> expected;
  for (index_t p = 0; p < static_cast<index_t> (stages.graph.size()); ++p)
    for (const index_t q : stages.graph.star (p))
      if (level.node_of[p] != level.node_of[q])
        expected.emplace (level.node_of[p], level.node_of[q]);
  std::set<std::pair<index_t, index_t>> found;
  for (index_t n = 0; n < static_cast<index_t> (level.size()); ++n)
    for (const index_t m : level.graph.star (n))
      found.emplace (n, m);
  EXPECT_EQ (found, expected);
}

TEST (Pyramid, DependsNeitherOnOrderNorThreadsNorScale)
{
  const Cloud::Ptr cloud = oracle::sample (oracle::bumpySphere(), SAMPLES);
  const auto expected = partition (*cloud, levelOf (*cloud, 2));
  EXPECT_EQ (partition (*cloud, levelOf (*cloud, 2, 2)), expected);

  Cloud scaled = *cloud;
  for (pcl::PointNormal& point : scaled)
    point.getVector3fMap() *= 1024.0F;
  EXPECT_EQ (partition (scaled, levelOf (scaled, 2)), expected);

  std::vector<int> order (cloud->size());
  std::iota (order.begin(), order.end(), 0);
  std::shuffle (order.begin(), order.end(), std::mt19937 (3));
  Cloud shuffled;
  for (const int i : order)
    shuffled.push_back ((*cloud)[i]);
  std::set<std::vector<int>> back;
  for (std::vector<int> samples : partition (shuffled, levelOf (shuffled, 2))) {
    for (int& sample : samples)
      sample = order[sample];
    std::sort (samples.begin(), samples.end());
    back.insert (samples);
  }
  EXPECT_EQ (back, expected);
}

TEST (Pyramid, TurnsWithTheCloud)
{
  const Cloud::Ptr cloud = oracle::sample (oracle::bumpySphere(), SAMPLES);
  Cloud turned = *cloud;
  const Eigen::Quaternionf turn =
      Eigen::Quaternionf (0.2F, 0.4F, -0.7F, 0.5F).normalized();
  for (pcl::PointNormal& point : turned) {
    point.getVector3fMap() = (turn * point.getVector3fMap()).eval();
    point.getNormalVector3fMap() = (turn * point.getNormalVector3fMap()).eval();
  }
  const auto expected = partition (*cloud, levelOf (*cloud, 2));
  const auto found = partition (turned, levelOf (turned, 2));
  std::size_t same = 0;
  for (const std::vector<int>& samples : found)
    same += expected.count (samples);
  EXPECT_GT (same, expected.size() * 9 / 10);
}

TEST (Pyramid, DependsOnSurroundingsOnly)
{
  // Cutting a cloud in two changes no node far from the cut: tiles agree.
  const Cloud::Ptr cloud = oracle::sample (oracle::wavyRidge(), SAMPLES);
  Cloud part;
  std::vector<int> index;
  for (std::size_t i = 0; i < cloud->size(); ++i)
    if ((*cloud)[i].x < 0.3F) {
      part.push_back ((*cloud)[i]);
      index.push_back (static_cast<int> (i));
    }
  const auto whole = partition (*cloud, levelOf (*cloud, 1));
  for (std::vector<int> samples : partition (part, levelOf (part, 1))) {
    bool far = true;
    for (int& sample : samples) {
      sample = index[sample];
      far = far && (*cloud)[sample].x < -0.3F;
    }
    if (far) {
      EXPECT_EQ (whole.count (samples), 1U);
    }
  }
}
