// SPDX-License-Identifier: BSD-3-Clause
// Estimated normals against exact ones, and against PCL's.
#include <pcl_crest/impl/oriented_normal_estimation.hpp>

#include <pcl/features/normal_3d_omp.h>

#include <gtest/gtest.h>

#include "normals/plane_fits.h"
#include "normals/ray_parity.h"
#include "search/position_tree.h"
#include "support/analytic_surface.h"
#include "support/noisy_cloud.h"
#include "support/solid_clouds.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <utility>

using namespace pcl::crest;
using Cloud = pcl::PointCloud<pcl::PointNormal>;

namespace {

NormalRequest
requestFor (const Cloud& cloud, unsigned threads = 2)
{
  NormalRequest request;
  request.cloud = viewOf (cloud);
  request.threads = threads;
  return request;
}

oracle::SolidCloud
solid (const std::string& name)
{
  for (const oracle::NamedSolid& known : oracle::namedSolids())
    if (known.name == name)
      return known.sample (1);
  throw std::invalid_argument (name);
}

struct Signs {
  /** of the points that are not at right angles to the exact normal */
  double wrong = 0.0;
  /** of those whose sign is sure */
  double wrong_of_sure = 0.0;
  double unsure = 0.0;
};

Signs
score (const Cloud& exact, const NormalEstimate& found)
{
  double counted = 0.0;
  double wrong = 0.0;
  double unsure = 0.0;
  double counted_sure = 0.0;
  double wrong_of_sure = 0.0;
  for (std::size_t i = 0; i < exact.size(); ++i) {
    const float cosine = found.normals[i].dot (exact[i].getNormalVector3fMap());
    const double sure = found.trust[i] < SURE_SIGN ? 0.0 : 1.0;
    unsure += 1.0 - sure;
    if (std::abs (cosine) < 0.5F)
      continue;
    const double is_wrong = cosine < 0.0F ? 1.0 : 0.0;
    counted += 1.0;
    wrong += is_wrong;
    counted_sure += sure;
    wrong_of_sure += sure * is_wrong;
  }
  return {wrong / counted,
          wrong_of_sure / std::max (1.0, counted_sure),
          unsure / static_cast<double> (exact.size())};
}

Signs
scoreWithNoise (const std::string& name, double spacings)
{
  const oracle::SolidCloud sampled = solid (name);
  const Cloud::Ptr noisy =
      oracle::addNoise (*sampled.cloud, spacings * sampled.spacing);
  return score (*sampled.cloud, estimateNormals (requestFor (*noisy)));
}

TEST (NormalEstimation, PlanesAreThoseOfPclWhereTheSurfaceIsSmooth)
{
  const auto cloud = oracle::sample (oracle::torus (1.0, 0.4), 8000);
  for (const double noise : {0.0, 0.2}) {
    const Cloud::Ptr noisy =
        oracle::addNoise (*cloud, noise * oracle::meanSpacing (*cloud));
    pcl::NormalEstimationOMP<pcl::PointNormal, pcl::Normal> pcl_estimation (2);
    pcl_estimation.setInputCloud (noisy);
    pcl_estimation.setKSearch (24);
    pcl::PointCloud<pcl::Normal> expected;
    pcl_estimation.compute (expected);
    const NormalEstimate found = estimateNormals (requestFor (*noisy));
    // PCL computes in single precision.
    std::size_t same = 0;
    for (std::size_t i = 0; i < cloud->size(); ++i) {
      const bool same_normal =
          std::abs (found.normals[i].dot (expected[i].getNormalVector3fMap())) >
          0.99999F;
      same += same_normal ? 1 : 0;
      if (same_normal) {
        ASSERT_NEAR (found.variation[i], expected[i].curvature, 1e-4F);
      }
    }
    EXPECT_GE (static_cast<double> (same), 0.998 * static_cast<double> (cloud->size()))
        << noise;
  }
}

TEST (NormalEstimation, FacesAreNotAveragedAcrossSharpEdges)
{
  for (const char* name : {"dodecahedron",
                           "gear",
                           "plate of 1.5 h",
                           "plate of 2 h",
                           "plate of 3 h",
                           "channel of 4 h"}) {
    const oracle::SolidCloud sampled = solid (name);
    const NormalEstimate found = estimateNormals (requestFor (*sampled.cloud));
    std::vector<double> angles;
    for (std::size_t i = 0; i < sampled.cloud->size(); ++i)
      angles.push_back (
          std::acos (std::min (1.0F,
                               std::abs (found.normals[i].dot (
                                   (*sampled.cloud)[i].getNormalVector3fMap())))));
    // The rest are on two faces, or in corners where none of theirs has enough samples.
    const auto most =
        angles.begin() + static_cast<std::ptrdiff_t> (0.95 * angles.size());
    std::nth_element (angles.begin(), most, angles.end());
    EXPECT_LT (*most, 1.0 * 3.14159 / 180.0) << name;
  }
}

TEST (NormalEstimation, SignsHoldWithoutNoise)
{
  for (const char* name : {"cube with holes",
                           "gear",
                           "three bodies",
                           "hollow sphere",
                           "plate of 1 h",
                           "plate of 2 h",
                           "terrain",
                           "city"})
    EXPECT_LE (scoreWithNoise (name, 0.0).wrong, 0.001) << name;
}

TEST (NormalEstimation, SignsHoldThroughNoise)
{
  for (const char* name : {"cube with holes", "gear", "hollow sphere", "city"}) {
    EXPECT_LE (scoreWithNoise (name, 0.5).wrong, 0.01) << name;
    EXPECT_LE (scoreWithNoise (name, 1.0).wrong, 0.05) << name;
  }
  // Two sheets in every window.
  for (const char* name : {"plate of 1.5 h", "plate of 2 h"})
    EXPECT_LE (scoreWithNoise (name, 0.2).wrong, 0.004) << name;
}

TEST (NormalEstimation, SheetsAFewDeviationsApartAreTold)
{
  // In single windows they look much like one: half would be wrong.
  for (const auto& [name, noise] : {std::pair ("plate of 1 h", 0.2),
                                    std::pair ("plate of 2 h", 0.5),
                                    std::pair ("channel of 4 h", 1.0)}) {
    const Signs signs = scoreWithNoise (name, noise);
    EXPECT_LE (signs.wrong, 0.04) << name;
    EXPECT_LE (signs.wrong_of_sure, 0.01 * noise) << name;
    EXPECT_LE (signs.unsure, 0.5) << name;
  }
}

TEST (NormalEstimation, WhatCannotBeKnownIsUnsure)
{
  // In the tips of a star both faces fit.
  for (const double noise : {0.0, 0.2}) {
    const Signs tips = scoreWithNoise ("star", noise);
    EXPECT_LE (tips.wrong_of_sure, 0.001);
    EXPECT_LE (tips.unsure, 0.03);
  }
  for (const char* name : {"plate of 1 h", "plate of 2 h"})
    EXPECT_GE (scoreWithNoise (name, 1.0).unsure, 0.99) << name;
  for (const char* name : {"dodecahedron", "hollow sphere"})
    EXPECT_LE (scoreWithNoise (name, 0.2).unsure, 0.001) << name;
  // Terrain may be a ceiling, unless somebody says where up is.
  const Cloud::Ptr terrain = solid ("terrain").cloud;
  NormalRequest request = requestFor (*terrain);
  EXPECT_EQ (score (*terrain, estimateNormals (request)).unsure, 1.0);
  EXPECT_NE (explainDoubt (estimateNormals (request)), "");
  request.hints.up = Eigen::Vector3f::UnitZ();
  EXPECT_EQ (explainDoubt (estimateNormals (request)), "");
}

TEST (NormalEstimation, PartsAreToldWithTheirSides)
{
  const NormalEstimate bodies =
      estimateNormals (requestFor (*solid ("three bodies").cloud));
  ASSERT_EQ (bodies.parts.size(), 3U);
  std::vector<std::size_t> points (3, 0);
  for (const index_t part : bodies.part)
    ++points.at (static_cast<std::size_t> (part));
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ (bodies.parts[i].side, NormalSide::OUTWARD);
    EXPECT_GE (bodies.parts[i].trust, SURE_SIGN);
    EXPECT_EQ (bodies.parts[i].points, points[i]);
  }
  EXPECT_TRUE (std::is_sorted (points.rbegin(), points.rend()));

  const Cloud::Ptr terrain = solid ("terrain").cloud;
  NormalRequest request = requestFor (*terrain);
  for (const float up : {1.0F, -1.0F}) {
    request.hints.up = Eigen::Vector3f (0.0F, 0.0F, up);
    const NormalEstimate found = estimateNormals (request);
    EXPECT_EQ (found.parts.at (0).side, NormalSide::UP);
    EXPECT_NEAR (score (*terrain, found).wrong, up > 0.0F ? 0.0 : 1.0, 0.001);
  }
  // No way up along a wall.
  request.hints.up = Eigen::Vector3f::UnitX();
  EXPECT_LT (estimateNormals (request).parts.at (0).trust, SURE_SIGN);
  request.hints.viewpoint = Eigen::Vector3f (0.0F, 0.0F, -50.0F);
  const NormalEstimate seen = estimateNormals (request);
  EXPECT_EQ (seen.parts.at (0).side, NormalSide::VIEWPOINT);
  EXPECT_NEAR (score (*terrain, seen).wrong, 1.0, 0.001);
}

TEST (NormalEstimation, DependsNeitherOnTheOrderNorOnThreads)
{
  const oracle::SolidCloud sampled = solid ("star");
  const Cloud::Ptr noisy = oracle::addNoise (*sampled.cloud, 0.5 * sampled.spacing);
  const NormalEstimate one = estimateNormals (requestFor (*noisy, 1));
  const NormalEstimate three = estimateNormals (requestFor (*noisy, 3));
  EXPECT_EQ (one.normals, three.normals);
  EXPECT_EQ (one.trust, three.trust);
  std::vector<std::size_t> order (noisy->size());
  for (std::size_t i = 0; i < order.size(); ++i)
    order[i] = i;
  std::shuffle (order.begin(), order.end(), std::mt19937 (1));
  Cloud shuffled;
  for (const std::size_t i : order)
    shuffled.push_back ((*noisy)[i]);
  const NormalEstimate other = estimateNormals (requestFor (shuffled));
  for (std::size_t i = 0; i < order.size(); ++i) {
    ASSERT_EQ (other.normals[i], one.normals[order[i]]);
    ASSERT_EQ (other.trust[i], one.trust[order[i]]);
  }
}

TEST (NormalEstimation, RaysTellInsideFromOutside)
{
  // With the exact normals, of which the inner sphere's look into its cavity.
  const oracle::SolidCloud sampled = solid ("hollow sphere");
  std::vector<Eigen::Vector3f> positions;
  for (const pcl::PointNormal& point : *sampled.cloud)
    positions.emplace_back (point.getVector3fMap());
  const auto tree = treeOver (positions, 1);
  PlaneFits fits = fitPlanes (*tree, 24, 1);
  const RayParity rays (fits);
  int right = 0;
  int asked = 0;
  for (std::size_t place = 0; place < fits.size(); place += 97) {
    const auto point =
        static_cast<std::size_t> (tree->index (static_cast<int> (place)));
    const float cosine =
        fits.normals[place].dot ((*sampled.cloud)[point].getNormalVector3fMap());
    right += rays.vote (place) * cosine > 0.5F ? 1 : 0;
    ++asked;
  }
  EXPECT_GE (right, 0.99 * asked);
}

TEST (NormalEstimation, CloudsWithoutSurfaceHaveNoNormals)
{
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const auto normalsOf = [] (const std::vector<Eigen::Vector3f>& positions) {
    NormalRequest request;
    request.cloud = {positions.front().data(), nullptr, 3, positions.size()};
    return estimateNormals (request);
  };
  std::vector<Eigen::Vector3f> line;
  std::vector<Eigen::Vector3f> slanted;
  for (int i = 0; i < 300; ++i) {
    line.emplace_back (0.1F * static_cast<float> (i), 0.0F, 0.0F);
    slanted.emplace_back (static_cast<float> (i) * Eigen::Vector3f (0.5F, 0.25F, 2.0F));
  }
  for (const std::vector<Eigen::Vector3f>& positions :
       {std::vector<Eigen::Vector3f> (1, Eigen::Vector3f::Zero()),
        std::vector<Eigen::Vector3f> (2, Eigen::Vector3f::Zero()),
        std::vector<Eigen::Vector3f> (500, Eigen::Vector3f::Ones()),
        std::vector<Eigen::Vector3f> (3, Eigen::Vector3f (nan, 0.0F, 0.0F)),
        line,
        slanted}) {
    const NormalEstimate found = normalsOf (positions);
    EXPECT_TRUE (found.parts.empty()) << positions.size();
    for (std::size_t i = 0; i < positions.size(); ++i) {
      EXPECT_TRUE (found.normals[i].isZero (0.0F));
      EXPECT_EQ (found.part[i], -1);
      EXPECT_EQ (found.trust[i], 0.0F);
    }
  }
  NormalRequest nothing;
  EXPECT_TRUE (estimateNormals (nothing).normals.empty());
}

TEST (NormalEstimation, FarClustersAndStrayPointsDoNoHarm)
{
  const auto ball = oracle::sample (oracle::sphere (1.0), 4000);
  Cloud cloud = *ball;
  for (const pcl::PointNormal& point : *ball) {
    cloud.push_back (point);
    cloud.back().getVector3fMap() += Eigen::Vector3f (3000.0F, 0.0F, 0.0F);
  }
  const std::size_t size = cloud.size();
  cloud.push_back (pcl::PointNormal (0.0F, 0.0F, 0.1F));
  cloud.push_back (pcl::PointNormal (1500.0F, 9.0F, 0.0F));
  const NormalEstimate found = estimateNormals (requestFor (cloud));
  cloud.resize (size);
  EXPECT_LE (score (cloud, found).wrong, 0.002);
}

TEST (NormalEstimation, StraysHoweverFarDoNoHarm)
{
  const auto ball = oracle::sample (oracle::sphere (1.0), 4000);
  for (const float distance : {1e5F, 1e7F, 1e9F}) {
    Cloud cloud = *ball;
    cloud.push_back (pcl::PointNormal (distance, 0.0F, 0.0F));
    const NormalEstimate found = estimateNormals (requestFor (cloud));
    EXPECT_LE (score (*ball, found).wrong, 0.001) << distance;
    EXPECT_LE (score (*ball, found).unsure, 0.001) << distance;
  }
}

TEST (NormalEstimation, ViewpointsHoweverFarAreDirections)
{
  const auto ball = oracle::sample (oracle::sphere (1.0), 4000);
  const Cloud::Ptr terrain = solid ("terrain").cloud;
  for (const float height : {1e3F, 1e8F, 1e30F}) {
    NormalRequest request = requestFor (*ball);
    request.hints.viewpoint = Eigen::Vector3f (0.0F, 0.0F, height);
    EXPECT_LE (score (*ball, estimateNormals (request)).wrong, 0.001) << height;
    request = requestFor (*terrain);
    request.hints.viewpoint = Eigen::Vector3f (0.0F, 0.0F, -height);
    EXPECT_GE (score (*terrain, estimateNormals (request)).wrong, 0.999) << height;
  }
}

TEST (NormalEstimation, DebrisMakesNoViewOfAModel)
{
  const auto ball = oracle::sample (oracle::sphere (1.0), 4000);
  Cloud cloud = *ball;
  for (const pcl::PointNormal& point : *ball)
    if (point.z > 0.97F) {
      cloud.push_back (point);
      cloud.back().getVector3fMap() += Eigen::Vector3f (3.0F, 0.0F, 0.0F);
    }
  ASSERT_GE (cloud.size(), ball->size() + LEAST_PART);
  NormalRequest request = requestFor (cloud);
  request.hints.viewpoint = Eigen::Vector3f::Zero();
  request.hints.viewpoint_assumed = true;
  EXPECT_LE (score (*ball, estimateNormals (request)).wrong, 0.001);
}

TEST (NormalEstimation, WhoSetsAViewpointInsideIsInARoom)
{
  const auto ball = oracle::sample (oracle::sphere (1.0), 4000);
  NormalRequest request = requestFor (*ball);
  request.hints.viewpoint = Eigen::Vector3f (0.1F, 0.2F, 0.0F);
  const NormalEstimate room = estimateNormals (request);
  EXPECT_TRUE (room.single_view);
  EXPECT_GE (score (*ball, room).wrong, 0.999);
  request.hints.viewpoint_assumed = true;
  EXPECT_LE (score (*ball, estimateNormals (request)).wrong, 0.001);
}

TEST (NormalEstimation, ADepthImageTellsWhereItWasTaken)
{
  // Two walls that meet at a right angle, by a camera that looks along +z.
  Cloud cloud;
  for (int column = -80; column <= 80; ++column)
    for (int row = -60; row <= 60; ++row) {
      const Eigen::Vector3f ray (0.01F * column, 0.01F * row, 1.0F);
      const Eigen::Vector3f toward =
          Eigen::Vector3f (column < 0 ? 1.0F : -1.0F, 0.0F, -1.0F).normalized();
      const Eigen::Vector3f position = 3.0F / (1.0F + std::abs (ray.x())) * ray;
      pcl::PointNormal point (position.x(), position.y(), position.z());
      point.getNormalVector3fMap() = toward;
      cloud.push_back (point);
    }
  NormalRequest request = requestFor (cloud);
  const NormalEstimate seen = estimateNormals (request);
  EXPECT_TRUE (seen.single_view);
  EXPECT_EQ (score (cloud, seen).wrong, 0.0);
  // Less an offset it was taken from where the origin had been.
  const Eigen::Vector3f offset (0.0F, 0.0F, 2.0F);
  Cloud moved = cloud;
  for (pcl::PointNormal& point : moved)
    point.getVector3fMap() -= offset;
  NormalRequest of_moved = requestFor (moved);
  EXPECT_FALSE (estimateNormals (of_moved).single_view);
  of_moved.hints.origin = -offset;
  EXPECT_TRUE (estimateNormals (of_moved).single_view);
  EXPECT_EQ (score (moved, estimateNormals (of_moved)).wrong, 0.0);
  of_moved.hints.origin.x() = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW (estimateNormals (of_moved), std::invalid_argument);

  // Terrain above the origin of its map is no image.
  Cloud terrain = *solid ("terrain").cloud;
  for (pcl::PointNormal& point : terrain)
    point.z += 3.0F;
  request = requestFor (terrain);
  EXPECT_EQ (score (terrain, estimateNormals (request)).wrong, 0.0);
  request.hints.viewpoint = Eigen::Vector3f::Zero();
  request.hints.viewpoint_assumed = true;
  EXPECT_EQ (score (terrain, estimateNormals (request)).wrong, 0.0);
  request.hints.viewpoint_assumed = false;
  EXPECT_EQ (score (terrain, estimateNormals (request)).wrong, 1.0);
}

TEST (NormalEstimation, RowsAndColumnsOfAMapAreNoImage)
{
  // A roof above the origin, as a grid of heights.
  Cloud roof;
  for (int column = -40; column <= 40; ++column)
    for (int row = -40; row <= 40; ++row) {
      roof.push_back (pcl::PointNormal (
          0.1F * column, 0.1F * row, 5.0F - 0.05F * std::abs (column)));
      roof.back().getNormalVector3fMap() =
          Eigen::Vector3f (column < 0 ? -0.5F : 0.5F, 0.0F, 1.0F).normalized();
    }
  NormalRequest request = requestFor (roof);
  request.hints.viewpoint = Eigen::Vector3f::Zero();
  request.hints.viewpoint_assumed = true;
  request.hints.organized = true;
  const NormalEstimate found = estimateNormals (request);
  EXPECT_LE (score (roof, found).wrong, 0.001);
  EXPECT_LT (found.parts.at (0).trust, SURE_SIGN);
}

TEST (NormalEstimation, AnAssumedViewpointIsAGuessThatUpOverrules)
{
  // A dome above the origin is seen from there, as everything inside of it would be.
  Cloud dome = *solid ("hemisphere").cloud;
  for (pcl::PointNormal& point : dome)
    point.z += 5.0F;
  NormalRequest request = requestFor (dome);
  request.hints.viewpoint = Eigen::Vector3f::Zero();
  request.hints.viewpoint_assumed = true;
  const NormalEstimate guessed = estimateNormals (request);
  EXPECT_EQ (guessed.countUnsure(), dome.size());
  EXPECT_TRUE (guessed.canBeTold());
  request.hints.up = Eigen::Vector3f::UnitZ();
  const NormalEstimate told = estimateNormals (request);
  EXPECT_LE (score (dome, told).wrong, 0.001);
  EXPECT_LT (told.countUnsure(), dome.size() / 100);

  // A plate far from the origin has two sides, and is no view.
  Cloud plate = *solid ("plate of 2 h").cloud;
  for (pcl::PointNormal& point : plate)
    point.x += 1000.0F;
  request = requestFor (plate);
  request.hints.viewpoint = Eigen::Vector3f::Zero();
  request.hints.viewpoint_assumed = true;
  const NormalEstimate found = estimateNormals (request);
  EXPECT_EQ (found.parts.at (0).side, NormalSide::OUTWARD);
  EXPECT_LE (score (plate, found).wrong, 0.01);
}

TEST (NormalEstimation, ASensorInTheSurfaceTellsNothing)
{
  Cloud plane;
  for (int i = -40; i < 40; ++i)
    for (int j = -40; j < 40; ++j)
      plane.push_back (
          pcl::PointNormal (0.1F * i + 0.05F, 0.1F * j + 0.05F, 0.0F, 0, 0, 1));
  NormalRequest request = requestFor (plane);
  request.hints.viewpoint = Eigen::Vector3f::Zero();
  request.hints.organized = true;
  EXPECT_EQ (score (plane, estimateNormals (request)).wrong, 0.0);
}

TEST (NormalEstimation, UnitsDoNotMatter)
{
  const auto ball = oracle::sample (oracle::sphere (1.0), 3000);
  for (const float scale : {1e-30F, 1e-9F, 1e9F, 1e30F}) {
    Cloud scaled = *ball;
    for (pcl::PointNormal& point : scaled)
      point.getVector3fMap() *= scale;
    EXPECT_LE (score (*ball, estimateNormals (requestFor (scaled))).wrong, 0.001)
        << scale;
  }
}

TEST (NormalEstimation, SaysWhatIsWrong)
{
  const std::vector<Eigen::Vector3f> positions (10, Eigen::Vector3f::Zero());
  const auto refusal = [] (const NormalRequest& request) -> std::string {
    try {
      estimateNormals (request);
    }
    catch (const std::invalid_argument& problem) {
      return problem.what();
    }
    return "nothing";
  };
  NormalRequest request;
  request.cloud = {positions.front().data(), nullptr, 3, positions.size()};
  request.k = 2;
  EXPECT_EQ (refusal (request), "k is 2, but normals need at least 3 neighbours");
  request.k = 1001;
  EXPECT_EQ (refusal (request), "k is 1001, but must be at most 1000");
  request.k = 24;
  request.hints.viewpoint =
      Eigen::Vector3f::Constant (std::numeric_limits<float>::infinity());
  EXPECT_EQ (
      refusal (request),
      "The viewpoint, or the sensor origin of the cloud, is not finite: set one that "
      "is");
  request.hints.viewpoint.reset();
  request.hints.up = Eigen::Vector3f::Zero();
  EXPECT_EQ (refusal (request),
             "The up direction is zero or not finite: set a direction, as 0 0 1");
  request.hints.up = Eigen::Vector3f::Ones();
  request.threads = static_cast<unsigned> (-1);
  EXPECT_EQ (refusal (request),
             "There are 4294967295 threads, but there must be at most 1024");
  request.threads = 1;
  request.cloud.position = nullptr;
  EXPECT_EQ (refusal (request),
             "The cloud has no positions: point to three floats of each");
}

TEST (NormalEstimation, StopsWhereTheCallbackSaysSo)
{
  const auto cloud = oracle::sample (oracle::sphere (1.0), 3000);
  NormalRequest request = requestFor (*cloud);
  double last = -1.0;
  request.progress = [&last] (const std::string& stage, double done) {
    EXPECT_EQ (stage, "normals");
    EXPECT_GE (done, last);
    last = done;
    return true;
  };
  estimateNormals (request);
  EXPECT_EQ (last, 1.0);
  request.progress = [] (const std::string&, double) { return false; };
  EXPECT_THROW (estimateNormals (request), Cancelled);
}

} // namespace
