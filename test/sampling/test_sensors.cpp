// SPDX-License-Identifier: BSD-3-Clause
// The simulated sensors do what is said of them, and what they can see of a scene is
// known.
#include <gtest/gtest.h>

#include "support/depth_cameras.h"
#include "support/lidar.h"
#include "support/marching_cubes.h"
#include "support/noisy_cloud.h"
#include "support/sensors.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace {

using Cloud = pcl::PointCloud<pcl::PointXYZ>;
using Eigen::Vector3d;

Vector3d
positionOf (const pcl::PointXYZ& point)
{
  return point.getVector3fMap().cast<double>();
}

/** \brief Before a wall at z = 2, which is seen at a right angle in the middle. */
oracle::RayCaster
wall ()
{
  return oracle::castPlanes ({{Vector3d::UnitZ(), 2.0}});
}

/** \brief Above the blocks in a corner. */
Eigen::Isometry3d
aboveBlocks ()
{
  return oracle::lookAt ({0.3, -1.7, 1.5}, {0.0, 0.0, 0.1});
}

std::size_t
countMissing (const Cloud& image)
{
  return static_cast<std::size_t> (
      std::count_if (image.begin(), image.end(), [] (const pcl::PointXYZ& point) {
        return !std::isfinite (point.x);
      }));
}

double
salientLength (const std::vector<oracle::TruthSegment>& truth)
{
  double length = 0.0;
  for (const oracle::TruthSegment& segment : oracle::salientLines (truth))
    length += (segment.b - segment.a).norm();
  return length;
}

TEST (Sensors, RaysMeetHeightFieldsOnTheSurface)
{
  const oracle::AnalyticSurface surface = oracle::ridgeAndValley();
  const oracle::RayCaster cast = oracle::castHeightField (surface);
  const Vector3d eye (0.3, -2.5, 1.5);
  int hits = 0;
  for (double x = -0.95; x < 1.0; x += 0.05)
    for (double y = -0.85; y < 0.9; y += 0.05) {
      const Vector3d direction = (Vector3d (x, y, 0.0) - eye).normalized();
      const oracle::Hit hit = cast (eye, direction);
      if (!std::isfinite (hit.distance))
        continue;
      ++hits;
      const Vector3d p = eye + hit.distance * direction;
      EXPECT_NEAR (p.z(), surface.position (p.x(), p.y()).z(), 1e-9);
      EXPECT_NEAR (
          hit.normal.dot (oracle::unitNormal (surface, p.x(), p.y())), 1, 1e-6);
      // Nothing was passed before.
      for (double t = 0.0; t < hit.distance - 1e-6; t += 0.003) {
        const Vector3d before = eye + t * direction;
        if (before.y() > surface.v_min) {
          ASSERT_GT (before.z(), surface.position (before.x(), before.y()).z());
        }
      }
    }
  EXPECT_GT (hits, 1200);
}

TEST (Sensors, EdgesAreAsWideAsTheirNarrowerFace)
{
  const oracle::Scene box = oracle::sceneOf (oracle::box (1.0, 0.8, 0.6));
  EXPECT_NEAR (salientLength (oracle::visibleCrests (box, {}, 0.1, 5.0)), 9.6, 1e-6);
  // The four that are .6 long, between faces that go on for 1 and .8.
  EXPECT_NEAR (salientLength (oracle::visibleCrests (box, {}, 0.1, 7.0)), 2.4, 1e-6);
  const oracle::Scene large = oracle::scaled (box, 10.0);
  EXPECT_NEAR (salientLength (oracle::visibleCrests (large, {}, 1.0, 7.0)), 24.0, 1e-5);
}

TEST (Sensors, EdgesCountWhereBothFacesAreSeen)
{
  const oracle::Scene box = oracle::sceneOf (oracle::box (1.0, 1.0, 1.0));
  const auto seenFrom = [&] (const Vector3d& eye) {
    const oracle::View view =
        oracle::viewOfDepthCamera (oracle::lookAt (eye, Vector3d::Zero()));
    return salientLength (oracle::visibleCrests (box, view, 0.05, 1.0));
  };
  EXPECT_NEAR (seenFrom ({3.0, 0.1, 0.1}), 0.0, 1e-6);
  EXPECT_NEAR (seenFrom ({2.5, 2.4, 0.1}), 1.0, 1e-6);
  EXPECT_NEAR (seenFrom ({2.0, 1.9, 2.1}), 3.0, 1e-6);
  // Beyond the image, or too far for its pixels.
  EXPECT_LT (seenFrom ({0.8, 0.7, 0.8}), 2.0);
  EXPECT_NEAR (seenFrom ({200.0, 190.0, 210.0}), 0.0, 1e-6);
}

TEST (Sensors, BlocksStandOnTheirFloor)
{
  const oracle::SharpSolid solid = oracle::blocks();
  const oracle::Scene scene = oracle::sceneOf (solid);
  for (const oracle::SceneCrest& crest : scene.crests) {
    ASSERT_EQ (crest.sides.size(), 2U);
    // A valley has what is above one face before the other.
    const bool is_valley = crest.sides[0].normal.dot (crest.sides[1].inward) > 0.0;
    ASSERT_EQ (is_valley, crest.segment.type == pcl::crest::CrestType::VALLEY);
  }
  const auto cloud = oracle::sample (solid, 5000);
  for (const pcl::PointNormal& point : *cloud) {
    // From just above the sample down to it.
    const Vector3d normal = point.getNormalVector3fMap().cast<double>();
    const Vector3d above = point.getVector3fMap().cast<double>() + 1e-3 * normal;
    ASSERT_NEAR (scene.cast (above, -normal).distance, 1e-3, 1e-6);
  }
}

TEST (Sensors, StructuredLightHasStepsOfDisparity)
{
  const Cloud image = oracle::depthImage (wall());
  EXPECT_EQ (countMissing (image), 0U);
  using Camera = oracle::DepthCamera;
  const double exact = Camera::FOCAL_LENGTH * Camera::BASELINE / 2.0;
  double squares = 0.0;
  for (const pcl::PointXYZ& point : image) {
    const double disparity = Camera::FOCAL_LENGTH * Camera::BASELINE / point.z;
    const double steps = disparity / Camera::DISPARITY_STEP;
    ASSERT_NEAR (steps, std::round (steps), 1e-4);
    squares += std::pow (disparity - exact, 2);
  }
  // A tenth of a pixel of noise, and the rounding.
  const double expected = 0.01 + Camera::DISPARITY_STEP * Camera::DISPARITY_STEP / 12.0;
  EXPECT_NEAR (squares / static_cast<double> (image.size()), expected, 0.1 * expected);
}

TEST (Sensors, StructuredLightMissesPixelsAtEdges)
{
  const oracle::Scene scene = oracle::sceneOf (oracle::blocks());
  const Cloud image = oracle::depthImage (scene.cast, aboveBlocks());
  // What has a depth is near a surface: nothing is between two.
  const Vector3d eye = aboveBlocks().translation();
  std::size_t seen = 0;
  for (const pcl::PointXYZ& point : image)
    if (std::isfinite (point.x)) {
      const Vector3d way = positionOf (point) - eye;
      const double depth = (aboveBlocks().inverse() * positionOf (point)).z();
      // Half a step, and five deviations; a window that bends over an edge sees less.
      const double most =
          depth * depth * 0.75 /
          (oracle::DepthCamera::FOCAL_LENGTH * oracle::DepthCamera::BASELINE);
      ASSERT_LT (std::abs (scene.cast (eye, way.normalized()).distance - way.norm()),
                 2.0 * most);
      ++seen;
    }
  EXPECT_GT (seen, 20000U);
  EXPECT_FALSE (image.is_dense);
}

TEST (Sensors, TimeOfFlightHasTheNoiseOfItsDepth)
{
  const Cloud image = oracle::timeOfFlightImage (wall());
  double squares = 0.0;
  double expected = 0.0;
  for (const pcl::PointXYZ& point : image) {
    const double incidence =
        std::acos (2.0 / std::sqrt (point.x * point.x + point.y * point.y + 4.0));
    squares += std::pow (point.z - 2.0, 2);
    expected += std::pow (oracle::timeOfFlightNoise (2.0, incidence), 2);
  }
  EXPECT_NEAR (squares / expected, 1.0, 0.02);
  EXPECT_NEAR (oracle::timeOfFlightNoise (2.0, 0.0), 1.7e-3, 1e-9);
}

TEST (Sensors, TimeOfFlightHasPixelsThatFly)
{
  const oracle::Scene scene = oracle::sceneOf (oracle::blocks());
  const Cloud image = oracle::timeOfFlightImage (scene.cast, aboveBlocks());
  const Vector3d eye = aboveBlocks().translation();
  const auto isFlying = [&] (const pcl::PointXYZ& point) {
    const Vector3d way = positionOf (point) - eye;
    const double off = scene.cast (eye, way.normalized()).distance - way.norm();
    return std::isfinite (point.x) && std::abs (off) > 0.05;
  };
  const auto flying = std::count_if (image.begin(), image.end(), isFlying);
  EXPECT_GT (flying, 100);
  EXPECT_LT (flying, static_cast<std::ptrdiff_t> (image.size() / 50));
}

TEST (Sensors, LidarsHaveTheirRings)
{
  const oracle::Scene yard = oracle::scaled (oracle::sceneOf (oracle::blocks()), 20.0);
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation().z() = 1.8;
  for (const int beams : {16, 32, 64, 128}) {
    const oracle::Lidar lidar = oracle::lidarOf (beams);
    ASSERT_EQ (lidar.elevations.size(), static_cast<std::size_t> (beams));
    const Cloud cloud = oracle::lidarTurn (lidar, yard.cast, pose);
    std::set<long> seen;
    for (const pcl::PointXYZ& point : cloud) {
      const Vector3d way = positionOf (point) - pose.translation();
      const Vector3d direction = way.normalized();
      const double elevation = std::asin (direction.z()) * 180.0 / M_PI;
      const auto beam = std::min_element (
          lidar.elevations.begin(), lidar.elevations.end(), [&] (double a, double b) {
            return std::abs (a - elevation) < std::abs (b - elevation);
          });
      ASSERT_NEAR (*beam, elevation, 0.01) << beams;
      seen.insert (beam - lidar.elevations.begin());
      // Rounding to floats may find the other face beside an edge.
      const oracle::Hit hit = yard.cast (pose.translation(), direction);
      const double incidence = std::acos (std::abs (hit.normal.dot (direction)));
      ASSERT_LT (std::abs (hit.distance - way.norm()),
                 5.0 * oracle::rangeNoise (lidar, hit.distance, incidence) + 0.01)
          << beams;
    }
    // The highest look over the blocks.
    EXPECT_GT (seen.size(), static_cast<std::size_t> (beams) * 8 / 10);
    EXPECT_EQ (*seen.begin(), 0);
  }
}

TEST (Sensors, ScansAreApart)
{
  const auto first = oracle::sample (oracle::plane(), 5000, 1);
  const auto second = oracle::sample (oracle::plane(), 5000, 2);
  const auto both = oracle::registeredScans (*first, *second, {0.0, 0.0, 0.1}, 0.01);
  ASSERT_EQ (both.size(), first->size() + second->size());
  double means[2] = {0.0, 0.0};
  for (std::size_t i = 0; i < both.size(); ++i)
    means[i < first->size() ? 0 : 1] += both[i].z;
  EXPECT_NEAR (means[0] / static_cast<double> (first->size()), 0.05, 1e-3);
  EXPECT_NEAR (means[1] / static_cast<double> (second->size()), -0.05, 1e-3);
}

TEST (Sensors, PhotogrammetrySharesItsNoise)
{
  const auto exact = oracle::sample (oracle::plane(), 20000);
  const double h = oracle::meanSpacing (*exact);
  oracle::Photogrammetry how;
  for (const double length : {5.0, 10.0}) {
    how.correlation_length = length;
    const auto cloud = oracle::photogrammetry (*exact, how);
    EXPECT_NEAR (static_cast<double> (cloud.size()) /
                     static_cast<double> (exact->size()),
                 1.0 - how.part_in_holes,
                 0.01);
    double squares = 0.0;
    double products = 0.0;
    double pairs = 0.0;
    pcl::search::KdTree<pcl::PointNormal> tree;
    tree.setInputCloud (cloud.makeShared());
    pcl::Indices found;
    std::vector<float> squared;
    for (std::size_t i = 0; i < cloud.size(); i += 10) {
      squares += 10.0 * cloud[i].z * cloud[i].z;
      tree.radiusSearch (cloud[i], 1.1 * length * h, found, squared);
      for (std::size_t j = 0; j < found.size(); ++j)
        if (squared[j] > std::pow (0.9 * length * h, 2)) {
          products += cloud[i].z * cloud[static_cast<std::size_t> (found[j])].z;
          ++pairs;
        }
    }
    const double variance = squares / static_cast<double> (cloud.size()) / (h * h);
    EXPECT_NEAR (variance, 0.25 * 0.25 + 0.05 * 0.05, 0.01) << length;
    EXPECT_NEAR (products / pairs / (h * h * 0.25 * 0.25), std::exp (-1.0), 0.15)
        << length;
  }
}

TEST (Sensors, MarchingCubesHaveTheirGrid)
{
  constexpr double STEP = 0.05;
  const oracle::AnalyticSurface surface = oracle::ridgeAndValley();
  const oracle::Scene scene = oracle::heightFieldScene (surface);
  const auto offsOf = [&] (const pcl::PointXYZ& point, const pcl::PointXYZ& first) {
    // From the nearest plane of the grid, of which two are through the first vertex,
    // but for x, which it moved along.
    Eigen::Vector3d off = (positionOf (point) - positionOf (first)) / STEP;
    return (off - off.array().round().matrix()).eval();
  };
  for (const auto values : {oracle::GridValues::DISTANCES, oracle::GridValues::SIDES}) {
    const Cloud cloud = oracle::marchingCubesVertices (scene, STEP, values);
    ASSERT_GT (cloud.size(), 1500U);
    for (const pcl::PointXYZ& point : cloud) {
      const double above = point.z - surface.position (point.x, point.y).z();
      // The heights at both ends of an edge of the grid have different signs.
      const double most = values == oracle::GridValues::DISTANCES ? 1e-5 : STEP;
      ASSERT_LT (std::abs (above), most);
      const Vector3d off = offsOf (point, cloud.front());
      const auto on_planes = (off.array().tail (2).abs() < 1e-3).count();
      // Those on edges along x are on planes of both other axes, others on one.
      ASSERT_GE (on_planes, 1);
    }
  }
}

} // namespace
