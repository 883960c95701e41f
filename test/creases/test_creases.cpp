// SPDX-License-Identifier: BSD-3-Clause
// Creases against exact wedges, and none on smooth surfaces.
#include <gtest/gtest.h>

#include "creases/creases.h"
#include "creases/sharp_lines.h"
#include "search/position_tree.h"
#include "support/noisy_cloud.h"
#include "support/sharp_solids.h"
#include "support/solid_clouds.h"
#include "support/surface_stages.h"

#include <algorithm>
#include <numeric>
#include <random>

using namespace pcl::crest;
using Cloud = pcl::PointCloud<pcl::PointNormal>;

namespace {

struct Found {
  oracle::SurfaceStages stages;
  std::vector<Crease> creases;
};

Found
find (const Cloud& cloud, unsigned threads = 0)
{
  Found found;
  found.stages = oracle::surfaceStages (cloud);
  // Of samples with little noise, in spacings.
  constexpr double LARGEST_RESIDUAL = 0.35;
  Parameters parameters;
  parameters.k = CREASE_NEIGHBORS;
  found.creases = findCreases (found.stages.points,
                               found.stages.graph,
                               oracle::kdTreeSearch (found.stages.points, parameters),
                               LARGEST_RESIDUAL,
                               threads);
  return found;
}

std::size_t
count (const std::vector<Crease>& creases)
{
  return static_cast<std::size_t> (
      std::count_if (creases.begin(), creases.end(), [] (const Crease& crease) {
        return crease.type != CrestType::NONE;
      }));
}

} // namespace

class WedgeCreases : public testing::TestWithParam<std::tuple<double, CrestType>> {};

TEST_P (WedgeCreases, AreWhereTheEdgeIs)
{
  const auto [angle, type] = GetParam();
  const Cloud::Ptr exact = oracle::sample (oracle::wedge (angle, type), 4000);
  const double h = oracle::meanSpacing (*exact);
  for (const double noise : {0.0, 0.05, 0.2}) {
    const Found found = find (*oracle::withNoise (*exact, noise * h));
    std::size_t near_edge = 0;
    std::size_t right = 0;
    double error = 0.0;
    double turn = 0.0;
    double lean = 0.0;
    for (std::size_t i = 0; i < found.creases.size(); ++i) {
      // Away from the borders, where half the window is missing.
      const Eigen::Vector3f& p = found.stages.points.positions[i];
      if (std::abs (p.y()) > 0.5 - 6.0 * h || std::hypot (p.x(), p.z()) > 0.5 * h)
        continue;
      ++near_edge;
      const Crease& crease = found.creases[i];
      if (crease.type != type)
        continue;
      ++right;
      error += std::hypot (crease.foot.x(), crease.foot.z()) / h;
      turn += crease.angle;
      lean += std::abs (crease.direction.y());
      EXPECT_GT (crease.normal.z(), 0.7F);
    }
    const auto n = static_cast<double> (right);
    ASSERT_GT (near_edge, 20U);
    EXPECT_GT (n, 0.85 * static_cast<double> (near_edge)) << noise;
    EXPECT_LT (error / n, 0.1 + noise) << noise;
    EXPECT_NEAR (turn / n, angle, 4.0 + 20.0 * noise) << noise;
    EXPECT_GT (lean / n, 0.99) << noise;
  }
}

INSTANTIATE_TEST_SUITE_P (Exact,
                          WedgeCreases,
                          testing::Combine (testing::Values (40.0, 60.0, 90.0, 120.0),
                                            testing::Values (CrestType::RIDGE,
                                                             CrestType::VALLEY)));

TEST (Creases, ShallowOnesAreFoundWithoutNoise)
{
  const Cloud::Ptr cloud =
      oracle::sample (oracle::wedge (12.0, CrestType::RIDGE), 4000);
  EXPECT_GT (count (find (*cloud).creases), 50U);
}

class SmoothSurfaces : public testing::TestWithParam<oracle::AnalyticSurface> {};

TEST_P (SmoothSurfaces, HaveHardlyAnyCreases)
{
  const Cloud::Ptr exact = oracle::sample (GetParam(), 6000);
  const double h = oracle::meanSpacing (*exact);
  for (const double noise : {0.0, 0.05, 0.2}) {
    const Found found = find (*oracle::withNoise (*exact, noise * h));
    EXPECT_LE (count (found.creases), found.creases.size() / 100) << noise;
  }
}

TEST_P (SmoothSurfaces, HaveNoSharpLinesThroughNoise)
{
  const Cloud::Ptr exact = oracle::sample (GetParam(), 6000);
  const double h = oracle::meanSpacing (*exact);
  for (const double noise : {0.0, 0.2, 0.4, 0.5, 0.6, 1.0}) {
    const oracle::SurfaceStages stages =
        oracle::surfaceStages (*oracle::withNoise (*exact, noise * h));
    const SharpLines lines = findSharpLines (
        stages.points, stages.graph, treeOver (stages.points.positions, 2), 2);
    EXPECT_EQ (lines.nodes.size(), 0U) << noise;
  }
}

INSTANTIATE_TEST_SUITE_P (Analytic,
                          SmoothSurfaces,
                          testing::Values (oracle::plane(),
                                           oracle::sphere (1.0),
                                           oracle::cylinder (0.5),
                                           oracle::torus (1.0, 0.4),
                                           oracle::ellipsoid (1.0, 0.7, 0.45)),
                          [] (const auto& info) { return info.param.name; });

TEST (Creases, FlippedNormalsSwapTypesExactly)
{
  const Cloud::Ptr exact = oracle::sample (oracle::lBracket (1.0, 0.8, 0.2), 5000);
  const Cloud::Ptr cloud =
      oracle::withNoise (*exact, 0.1 * oracle::meanSpacing (*exact));
  const Found found = find (*cloud);
  for (pcl::PointNormal& point : *cloud)
    point.getNormalVector3fMap() *= -1.0F;
  const Found flipped = find (*cloud);
  ASSERT_GT (count (found.creases), 100U);
  for (std::size_t i = 0; i < found.creases.size(); ++i) {
    const Crease& a = found.creases[i];
    const Crease& b = flipped.creases[i];
    ASSERT_EQ (a.type == CrestType::NONE, b.type == CrestType::NONE);
    if (a.type == CrestType::NONE)
      continue;
    EXPECT_NE (a.type, b.type);
    EXPECT_EQ (a.foot, b.foot);
    EXPECT_EQ (a.angle, b.angle);
    EXPECT_EQ (a.ratio, b.ratio);
  }
}

TEST (Creases, DependNeitherOnOrderNorThreads)
{
  const Cloud::Ptr cloud = oracle::sampleOnGrids (oracle::box (1.0, 1.0, 1.0), 3000);
  const Found found = find (*cloud, 1);
  std::vector<std::size_t> order (cloud->size());
  std::iota (order.begin(), order.end(), 0);
  std::shuffle (order.begin(), order.end(), std::mt19937 (5));
  Cloud shuffled;
  for (const std::size_t i : order)
    shuffled.push_back ((*cloud)[i]);
  const Found other = find (shuffled, 3);
  ASSERT_EQ (found.creases.size(), other.creases.size());
  for (std::size_t i = 0; i < found.creases.size(); ++i) {
    EXPECT_EQ (found.creases[i].type, other.creases[i].type);
    EXPECT_EQ (found.creases[i].foot, other.creases[i].foot);
  }
}

/** \brief Where solids touch: a plane, and another one that ends at it along the y
 * axis, below or above. The signs of its normals are a matter of taste, or of chance.
 */
class TouchingSheets : public testing::TestWithParam<std::tuple<double, double>> {};

TEST_P (TouchingSheets, MeetInAnEdge)
{
  constexpr double SPACING = 0.02;
  const auto [side, flipped] = GetParam();
  std::mt19937 random (4);
  std::uniform_real_distribution<double> jitter (-0.4, 0.4);
  std::bernoulli_distribution coin (flipped);
  Cloud cloud;
  const auto add = [&] (double x, double z, int row, float nx, float nz) {
    pcl::PointNormal point (x, (row + jitter (random)) * SPACING, z);
    point.getNormalVector3fMap() = Eigen::Vector3f (nx, 0.0F, nz);
    cloud.push_back (point);
  };
  for (int row = -25; row <= 25; ++row) {
    for (int i = -15; i <= 15; ++i)
      add ((i + jitter (random)) * SPACING, 0.0, row, 0.0F, 1.0F);
    for (int i = 1; i <= 15; ++i)
      add (0.0,
           side * (i + jitter (random)) * SPACING,
           row,
           coin (random) ? 1.0F : -1.0F,
           0.0F);
  }
  const Found found = find (cloud);
  std::size_t near_edge = 0;
  std::size_t right = 0;
  for (std::size_t i = 0; i < found.creases.size(); ++i) {
    const Eigen::Vector3f& p = found.stages.points.positions[i];
    if (std::abs (p.y()) > 19.0 * SPACING || std::hypot (p.x(), p.z()) > 0.5 * SPACING)
      continue;
    ++near_edge;
    const Crease& crease = found.creases[i];
    const bool is_there =
        std::hypot (crease.foot.x(), crease.foot.z()) < 0.1 * SPACING &&
        std::abs (crease.direction.y()) > 0.99F && std::abs (crease.angle - 90.0) < 2.0;
    if (is_there && crease.type == (side < 0.0 ? CrestType::RIDGE : CrestType::VALLEY))
      ++right;
  }
  ASSERT_GT (near_edge, 20U);
  EXPECT_GT (static_cast<double> (right), 0.85 * static_cast<double> (near_edge));
}

INSTANTIATE_TEST_SUITE_P (Exact,
                          TouchingSheets,
                          testing::Combine (testing::Values (-1.0, 1.0),
                                            testing::Values (0.0, 0.5, 1.0)));

class ThinPlates : public testing::TestWithParam<std::tuple<const char*, double>> {};

TEST_P (ThinPlates, HaveTheEdgesOfBothSheets)
{
  const auto [name, noise] = GetParam();
  const auto& solids = oracle::namedSolids();
  const auto solid =
      std::find_if (solids.begin(), solids.end(), [name = name] (const auto& s) {
        return s.name == name;
      });
  ASSERT_NE (solid, solids.end());
  const oracle::SolidCloud plate = solid->sample (1);
  const double h = plate.spacing;
  const oracle::SurfaceStages stages =
      oracle::surfaceStages (*oracle::addNoise (*plate.cloud, noise * h));
  const SharpLines lines = findSharpLines (
      stages.points, stages.graph, treeOver (stages.points.positions, 0), 0);
  const auto distance = [] (const oracle::SharpEdge& edge, const Eigen::Vector3d& p) {
    const Eigen::Vector3d e = edge.b - edge.a;
    const double s = std::clamp ((p - edge.a).dot (e) / e.squaredNorm(), 0.0, 1.0);
    return (p - edge.a - s * e).norm();
  };
  for (const SharpNode& node : lines.nodes) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const oracle::SharpEdge& edge : plate.edges)
      nearest = std::min (nearest, distance (edge, node.crease.foot.cast<double>()));
    // Samples at a corner see two edges, and take one between.
    EXPECT_LT (nearest, 1.2 * h);
    EXPECT_EQ (node.crease.type, CrestType::RIDGE);
  }
  // Nodes are less than three spacings apart along an edge.
  int places = 0;
  int missed = 0;
  for (const oracle::SharpEdge& edge : plate.edges) {
    const double length = (edge.b - edge.a).norm();
    // Those of its corners are no longer than it is thick.
    if (length < 5.0 * h)
      continue;
    for (double s = 0.5 * h; s < length; s += h) {
      const Eigen::Vector3d place = edge.a + s / length * (edge.b - edge.a);
      ++places;
      missed += std::none_of (
                    lines.nodes.begin(),
                    lines.nodes.end(),
                    [&] (const SharpNode& node) {
                      return (node.crease.foot.cast<double>() - place).norm() < 1.5 * h;
                    })
                    ? 1
                    : 0;
    }
  }
  EXPECT_LT (missed, 0.03 * places);
}

INSTANTIATE_TEST_SUITE_P (Rims,
                          ThinPlates,
                          testing::Combine (testing::Values ("plate of 1 h",
                                                             "plate of 1.5 h",
                                                             "plate of 2 h"),
                                            testing::Values (0.0, 0.05)));
