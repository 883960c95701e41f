// SPDX-License-Identifier: BSD-3-Clause
// Samples gathered to nodes: where, and only where, single ones tell nothing.
#include <pcl_crest/crest_extraction.h>

#include <gtest/gtest.h>

#include "sampling/sample_nodes.h"
#include "support/depth_cameras.h"
#include "support/detailed_surfaces.h"
#include "support/extraction.h"
#include "support/noisy_cloud.h"
#include "support/sensors.h"
#include "support/sharp_solids.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

using namespace pcl::crest;
using Cloud = pcl::PointCloud<pcl::PointNormal>;

namespace {

template <typename PointT>
SampleNodes
resolve (const pcl::PointCloud<PointT>& cloud, unsigned threads = 2)
{
  return resolveSamples ({cloud.empty() ? nullptr : &cloud[0].x,
                          nullptr,
                          sizeof (PointT) / sizeof (float),
                          cloud.size()},
                         threads);
}

std::size_t
flawsOf (const SampleNodes& nodes, SamplingFlaw flaw)
{
  return nodes.findings.flaws[static_cast<std::size_t> (flaw)];
}

/** \brief Every second sample of a line, and lines as many times farther apart. */
Cloud
inScanLines (const Cloud& even, double line_distance)
{
  Cloud cloud;
  for (const pcl::PointNormal& point : even) {
    const double place = point.x / line_distance;
    if (place - std::floor (place) < 0.04)
      cloud.push_back (point);
  }
  return cloud;
}

TEST (SampleNodes, EvenCloudsStayAsTheyAre)
{
  for (const auto& surface : {oracle::plane(),
                              oracle::sphere (1.0),
                              oracle::torus (1.0, 0.4),
                              oracle::bumpySphere(),
                              oracle::ridgeAndValley()}) {
    const Cloud::Ptr exact = oracle::sample (surface, 20000);
    const double h = oracle::meanSpacing (*exact);
    for (const double noise : {0.0, 0.05, 0.2, 0.5, 1.0}) {
      const SampleNodes nodes = resolve (*oracle::addNoise (*exact, noise * h));
      EXPECT_TRUE (nodes.isEmpty()) << surface.name << " " << noise;
      EXPECT_EQ (nodes.findings.gathered, 0U);
      // Random samples' spacing by the places between them is that of even ones.
      EXPECT_NEAR (nodes.findings.spacing / h, 1.0, 0.3) << surface.name;
    }
  }
}

TEST (SampleNodes, SolidsStayAsTheyAre)
{
  for (const auto& solid : {oracle::box (1.0, 0.8, 0.6),
                            oracle::box (1.0, 1.0, 0.02),
                            oracle::lBracket (1.0, 0.8, 0.2)}) {
    const Cloud::Ptr exact = oracle::sample (solid, 20000);
    const double h = oracle::meanSpacing (*exact);
    for (const double noise : {0.0, 0.2, 0.5})
      EXPECT_TRUE (resolve (*oracle::addNoise (*exact, noise * h)).isEmpty())
          << solid.name << " " << noise;
  }
}

TEST (SampleNodes, ReliefOfAFewSpacingsIsNoNoise)
{
  // In the residuals of quadrics it is: they grow with the window, and then no more.
  std::vector<Eigen::Vector2d> parameters;
  for (const double wavelength : {5.0, 6.0, 8.0}) {
    const Cloud::Ptr exact =
        oracle::sampleOneApart (oracle::crossingWaves (wavelength), 1, parameters);
    const double h = oracle::meanSpacing (*exact);
    for (const double noise : {0.0, 0.05})
      EXPECT_TRUE (resolve (*oracle::addNoise (*exact, noise * h)).isEmpty())
          << wavelength << " " << noise;
  }
  EXPECT_TRUE (resolve (*oracle::sampleOneApart (oracle::waveMixture(), 1, parameters))
                   .isEmpty());
}

TEST (SampleNodes, ClumpsBecomeTheirPlaces)
{
  const Cloud::Ptr exact = oracle::sample (oracle::box (1.0, 0.8, 0.6), 6000);
  const double h = oracle::meanSpacing (*exact);
  for (const double jitter : {0.01, 0.05}) {
    const Cloud cloud = oracle::accumulatedFrames (*exact, 5, jitter * h);
    const SampleNodes nodes = resolve (cloud);
    ASSERT_FALSE (nodes.isEmpty()) << jitter;
    EXPECT_GT (flawsOf (nodes, SamplingFlaw::CLUMPS), 0U);
    EXPECT_GT (nodes.findings.gathered, cloud.size() * 9 / 10);
    EXPECT_LE (nodes.positions.size(), exact->size());
    EXPECT_GT (nodes.positions.size(), exact->size() / 4);
    // The samples of one place are in one node.
    std::size_t together = 0;
    for (std::size_t i = 0; i < exact->size(); ++i)
      together += nodes.node_of[i] == nodes.node_of[i + exact->size()] ? 1 : 0;
    EXPECT_GT (together, exact->size() * 8 / 10) << jitter;
  }
}

TEST (SampleNodes, FramesOfABoxGiveItsEdges)
{
  const oracle::SharpSolid box = oracle::box (1.0, 0.8, 0.6);
  const Cloud::Ptr exact = oracle::sample (box, 12000);
  const double h = oracle::meanSpacing (*exact);
  const auto cloud =
      pcl::make_shared<Cloud> (oracle::accumulatedFrames (*exact, 5, 0.02 * h));
  const oracle::CrestRun run = oracle::extract (cloud);
  const oracle::LineScore found = oracle::scoreLines (run.lines,
                                                      *run.line_cloud,
                                                      oracle::trueCrestLines (box),
                                                      CrestType::RIDGE,
                                                      2.0 * h);
  EXPECT_GT (found.precision, 0.95);
  EXPECT_GT (found.recall, 0.95);
  // Labels come back to all samples.
  ASSERT_EQ (run.labels.size(), cloud->size());
  for (const pcl::Label& label : run.labels)
    EXPECT_NE (label.label, LABEL_INVALID);
  for (const CrestLine& line : run.lines)
    for (const auto& polyline : line.polylines)
      for (const index_t point : polyline)
        ASSERT_LT (static_cast<std::size_t> (point), cloud->size());
}

TEST (SampleNodes, ScanLinesAreGatheredAcross)
{
  const Cloud::Ptr even = oracle::sample (oracle::box (1.0, 1.0, 1.0), 120000);
  const double h = oracle::meanSpacing (*even);
  // Some eight times as far apart as samples along them.
  const Cloud cloud = inScanLines (*even, 25.0 * h);
  const SampleNodes nodes = resolve (cloud);
  ASSERT_FALSE (nodes.isEmpty());
  EXPECT_GT (nodes.findings.anisotropy, 8.0);
  EXPECT_GT (nodes.findings.resolving_spacing, 5.0 * h);
}

TEST (SampleNodes, DepthNoiseIsLittleBetweenNodes)
{
  const Eigen::Vector3d normal = Eigen::Vector3d (0.3, 0.5, 1.0).normalized();
  const double offset = 0.9;
  const auto image = oracle::depthImage (oracle::castPlanes ({{normal, offset}}));
  const SampleNodes nodes = resolve (image);
  ASSERT_FALSE (nodes.isEmpty());
  EXPECT_GT (flawsOf (nodes, SamplingFlaw::CORRELATED_NOISE) +
                 flawsOf (nodes, SamplingFlaw::DEPTH_STEPS),
             0U);
  const auto scatterOf = [&] (const auto& positions, const auto& at) {
    double squares = 0.0;
    for (const auto& position : positions)
      squares +=
          std::pow (normal.dot (at (position).template cast<double>()) - offset, 2);
    return std::sqrt (squares / static_cast<double> (positions.size()));
  };
  const double of_samples =
      scatterOf (image.points, [] (const pcl::PointXYZ& p) -> Eigen::Vector3f {
        return p.getVector3fMap();
      });
  const double of_nodes =
      scatterOf (nodes.positions, [] (const Eigen::Vector3f& p) { return p; });
  EXPECT_LT (of_nodes / nodes.findings.resolving_spacing,
             0.35 * of_samples / nodes.findings.spacing);
}

TEST (SampleNodes, NothingIsDrawnOfDepthNoise)
{
  const Eigen::Vector3d normal = Eigen::Vector3d (0.3, 0.5, 1.0).normalized();
  const auto image = oracle::depthImage (oracle::castPlanes ({{normal, 1.2}}));
  pcl::CrestLineEstimation<pcl::PointXYZ> estimation;
  estimation.setInputCloud (image.makeShared());
  pcl::PointCloud<pcl::Label> labels;
  estimation.compute (labels);
  const double spacing = estimation.getStatistics().sampling.spacing;
  ASSERT_GT (spacing, 0.0);
  EXPECT_LT (oracle::totalLength (estimation.getLines()), 20.0 * spacing);
}

TEST (SampleNodes, ACornerIsSeenThroughDepthNoise)
{
  // A vertical edge before the camera, and the corner of a room.
  const Eigen::Vector3d left = Eigen::Vector3d (1.0, 0.0, 1.0).normalized();
  const Eigen::Vector3d right = Eigen::Vector3d (-1.0, 0.0, 1.0).normalized();
  const double offset = std::sqrt (0.5);
  for (const bool nearest : {true, false}) {
    const auto image = oracle::depthImage (
        oracle::castPlanes ({{left, offset}, {right, offset}}, nearest));
    pcl::CrestLineEstimation<pcl::PointXYZ> estimation;
    estimation.setInputCloud (image.makeShared());
    pcl::PointCloud<pcl::Label> labels;
    estimation.compute (labels);
    const double node = estimation.getStatistics().sampling.resolving_spacing;
    ASSERT_GT (node, 0.0) << nearest;
    double right_length = 0.0;
    double wrong_length = 0.0;
    const auto& cloud = *estimation.getLineCloud();
    for (const CrestLine& line : estimation.getLines())
      for (const auto& polyline : line.polylines)
        for (std::size_t i = 0; i + 1 < polyline.size(); ++i) {
          const Eigen::Vector3f a =
              cloud[static_cast<std::size_t> (polyline[i])].getVector3fMap();
          const Eigen::Vector3f b =
              cloud[static_cast<std::size_t> (polyline[i + 1])].getVector3fMap();
          const Eigen::Vector3f middle = 0.5F * (a + b);
          const double off = std::hypot (middle.x(), middle.z() - 1.0F);
          const bool is_right =
              off < 2.0 * node &&
              line.type == (nearest ? CrestType::VALLEY : CrestType::RIDGE);
          (is_right ? right_length : wrong_length) += (b - a).norm();
        }
    const double whole =
        oracle::DepthCamera::HEIGHT / oracle::DepthCamera::FOCAL_LENGTH;
    EXPECT_GT (right_length, 0.8 * whole) << nearest;
    EXPECT_LT (wrong_length, 0.3 * right_length) << nearest;
  }
}

TEST (SampleNodes, NeitherOrderNorThreadsMatter)
{
  const Cloud::Ptr exact = oracle::sample (oracle::box (1.0, 0.8, 0.6), 4000);
  const Cloud cloud =
      oracle::accumulatedFrames (*exact, 5, 0.02 * oracle::meanSpacing (*exact));
  const SampleNodes nodes = resolve (cloud, 1);
  ASSERT_FALSE (nodes.isEmpty());
  EXPECT_EQ (resolve (cloud, 2).positions, nodes.positions);
  Cloud shuffled = cloud;
  std::shuffle (shuffled.begin(), shuffled.end(), std::mt19937 (3));
  EXPECT_EQ (resolve (shuffled).positions, nodes.positions);
}

TEST (SampleNodes, StraysChangeNothing)
{
  const Cloud::Ptr exact = oracle::sample (oracle::box (1.0, 0.8, 0.6), 4000);
  Cloud cloud =
      oracle::accumulatedFrames (*exact, 5, 0.02 * oracle::meanSpacing (*exact));
  const SampleNodes before = resolve (cloud);
  ASSERT_FALSE (before.isEmpty());
  pcl::PointNormal stray;
  for (const float far : {1e7F, std::numeric_limits<float>::lowest()}) {
    stray.getVector3fMap().setConstant (far);
    cloud.push_back (stray);
  }
  stray.x = std::numeric_limits<float>::quiet_NaN();
  cloud.push_back (stray);
  const SampleNodes after = resolve (cloud);
  ASSERT_EQ (after.positions.size(), before.positions.size() + 2);
  EXPECT_TRUE (std::equal (
      before.positions.begin(), before.positions.end(), after.positions.begin()));
  EXPECT_EQ (after.node_of.back(), -1);
  EXPECT_EQ (after.findings.gathered, before.findings.gathered);
}

TEST (SampleNodes, OfAVolumeItIsSaid)
{
  std::mt19937 random (1);
  std::uniform_real_distribution<float> side (-1.0F, 1.0F);
  Cloud ball;
  while (ball.size() < 8000) {
    const Eigen::Vector3f place (side (random), side (random), side (random));
    if (place.norm() < 1.0F) {
      ball.push_back (pcl::PointNormal());
      ball.back().getVector3fMap() = place;
    }
  }
  const auto words = [] (const Cloud& cloud) {
    return explainSampling (resolve (cloud).findings);
  };
  EXPECT_NE (words (ball).find ("exceeds the detail"), std::string::npos);
  const Cloud::Ptr sphere = oracle::sample (oracle::sphere (1.0), 8000);
  const double h = oracle::meanSpacing (*sphere);
  for (const double noise : {0.0, 1.0})
    EXPECT_EQ (words (*oracle::addNoise (*sphere, noise * h)).find ("exceeds"),
               std::string::npos);
}

TEST (SampleNodes, WhatIsNoSurfaceIsLeftAlone)
{
  EXPECT_TRUE (resolve (Cloud()).isEmpty());
  Cloud cloud (5000, 1);
  EXPECT_TRUE (resolve (cloud).isEmpty()); // all at the origin
  for (std::size_t i = 0; i < cloud.size(); ++i)
    cloud[i].x = static_cast<float> (i);
  EXPECT_TRUE (resolve (cloud).isEmpty()); // on a line
  for (pcl::PointNormal& point : cloud)
    point.x = std::numeric_limits<float>::quiet_NaN();
  EXPECT_TRUE (resolve (cloud).isEmpty());
}

} // namespace
