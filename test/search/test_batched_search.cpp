// SPDX-License-Identifier: BSD-3-Clause
// The batched search against brute force, on clouds that are hard for one reason each.
#include <gtest/gtest.h>

#include "search/leaf_search.h"
#include <omp.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace pcl {
namespace crest {
namespace {

using Cloud = std::vector<std::array<float, 3>>;

/** \brief A neighbour by its index, as (squared distance, index). */
using Neighbor = std::pair<float, std::int32_t>;
/** \brief Those of each point, by its index. */
using Neighbors = std::vector<std::vector<Neighbor>>;

PointTree
treeOf (const Cloud& cloud, unsigned threads = 1)
{
  PointTree tree;
  EXPECT_EQ (
      buildPointTree (
          cloud.empty() ? nullptr : cloud[0].data(), 3, cloud.size(), threads, tree),
      "");
  return tree;
}

/** \brief Puts down what was found by index, in the cloud's unit. */
void
collect (const PointTree& tree, const LeafNeighbors& found, Neighbors& neighbors)
{
  for (int i = 0; i < found.count; ++i) {
    std::vector<Neighbor>& own = neighbors[tree.index (found.first + i)];
    own.clear();
    for (std::size_t j = found.offsets[i]; j < found.offsets[i + 1]; ++j)
      own.emplace_back (
          static_cast<float> (found.squared_distances[j] * tree.unit * tree.unit),
          tree.index (found.places[j]));
  }
}

Neighbors
batched (const Cloud& cloud,
         const NeighborCount& count,
         Simd simd = bestSimd(),
         int threads = 1)
{
  const PointTree tree = treeOf (cloud, static_cast<unsigned> (threads));
  Neighbors neighbors (cloud.size());
  const auto leaves = static_cast<std::ptrdiff_t> (tree.leafCount());
#pragma omp parallel num_threads(threads)
  {
    LeafSearch search (tree, count, simd);
#pragma omp for schedule(dynamic, 7)
    for (std::ptrdiff_t leaf = 0; leaf < leaves; ++leaf)
      collect (tree, search.searchLeaf (static_cast<std::size_t> (leaf)), neighbors);
  }
  return neighbors;
}

/** \brief The neighbours of one point by looking at all others. */
std::vector<Neighbor>
bruteForce (const Cloud& cloud, std::size_t query, const NeighborCount& count)
{
  std::vector<Neighbor> all;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (i == query)
      continue;
    const float dx = cloud[i][0] - cloud[query][0];
    const float dy = cloud[i][1] - cloud[query][1];
    const float dz = cloud[i][2] - cloud[query][2];
    all.emplace_back ((dx * dx + dy * dy) + dz * dz, static_cast<std::int32_t> (i));
  }
  std::size_t kept = std::min (all.size(), static_cast<std::size_t> (count.nearest));
  const std::size_t most =
      std::max (kept, std::min (all.size(), static_cast<std::size_t> (count.most)));
  std::partial_sort (
      all.begin(), all.begin() + static_cast<std::ptrdiff_t> (most), all.end());
  if (kept > 0) {
    const auto tied =
        static_cast<float> (all[kept - 1].first * (1.0 + count.equidistant));
    while (kept < most && all[kept].first <= tied)
      ++kept;
  }
  all.resize (kept);
  return all;
}

constexpr std::array<Simd, 3> ALL_SIMD{Simd::PORTABLE, Simd::SSE2, Simd::AVX2};

/** \brief Compares every stride-th point with brute force, with all instructions. The
 * test counts as skipped where the machine lacks some.
 */
void
expectExact (const Cloud& cloud, const NeighborCount& count, std::size_t stride = 1)
{
  const Neighbors found = batched (cloud, count);
  for (std::size_t i = 0; i < cloud.size(); i += stride)
    ASSERT_EQ (found[i], bruteForce (cloud, i, count)) << "at point " << i;
  for (const Simd simd : ALL_SIMD) {
    if (!isAvailable (simd))
      GTEST_SKIP() << "not compared from instructions " << static_cast<int> (simd)
                   << " on: this machine does not have them";
    ASSERT_EQ (batched (cloud, count, simd), found)
        << "with instructions " << static_cast<int> (simd);
  }
}

Cloud
uniformCube (std::size_t size, unsigned seed = 1)
{
  std::mt19937 random (seed);
  std::uniform_real_distribution<float> coordinate (-1.0F, 1.0F);
  Cloud cloud (size);
  for (auto& p : cloud)
    p = {coordinate (random), coordinate (random), coordinate (random)};
  return cloud;
}

Cloud
unitSphere (std::size_t size, unsigned seed = 2)
{
  std::mt19937 random (seed);
  std::normal_distribution<float> normal;
  Cloud cloud (size);
  for (auto& p : cloud) {
    p = {normal (random), normal (random), normal (random)};
    const float length = std::sqrt (p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
    p = {p[0] / length, p[1] / length, p[2] / length};
  }
  return cloud;
}

Cloud
lattice (int nx, int ny, int nz)
{
  Cloud cloud;
  for (int z = 0; z < nz; ++z)
    for (int y = 0; y < ny; ++y)
      for (int x = 0; x < nx; ++x)
        cloud.push_back ({0.5F * static_cast<float> (x),
                          0.5F * static_cast<float> (y),
                          0.5F * static_cast<float> (z)});
  // The order of the indices has to be another than any of space.
  std::shuffle (cloud.begin(), cloud.end(), std::mt19937 (3));
  return cloud;
}

Cloud
scaled (Cloud cloud, float x, float y, float z)
{
  for (auto& p : cloud)
    p = {x * p[0], y * p[1], z * p[2]};
  return cloud;
}

TEST (BatchedSearch, IsExactOnSurfacesAndVolumes)
{
  for (const int k : {1, 6, 20, 96}) {
    expectExact (uniformCube (3000), {k});
    expectExact (unitSphere (3000), {k});
  }
}

TEST (BatchedSearch, TakesAnyNumberOfPoints)
{
  for (const std::size_t size : {0, 1, 2, 7, 8, 9, 16, 17, 63, 64, 65, 513, 520})
    for (const int k : {0, 1, 5, 8, 20, 700})
      expectExact (uniformCube (size), {k});
}

TEST (BatchedSearch, FindsNoneForNegativeNumbers)
{
  const Neighbors found = batched (uniformCube (20), {-3});
  for (const auto& neighbors : found)
    EXPECT_TRUE (neighbors.empty());
}

TEST (BatchedSearch, BreaksTiesByIndexOnLattices)
{
  for (const int k : {1, 4, 6, 7, 20, 26, 50}) {
    expectExact (lattice (12, 12, 12), {k});
    expectExact (lattice (40, 40, 1), {k});
    expectExact (lattice (1, 1500, 1), {k});
  }
}

TEST (BatchedSearch, FindsAllThatAreEquallyFarOnRequest)
{
  for (const int k : {1, 4, 20, 23}) {
    expectExact (lattice (12, 12, 12), {k, 1e-3, 8 * k});
    expectExact (lattice (40, 40, 1), {k, 1e-3, 8 * k});
    expectExact (uniformCube (2000), {k, 0.1, 2 * k});
    expectExact (unitSphere (2000), {k, 3.0, 5 * k});
    // Ties are found up to a limit, those of lowest index.
    expectExact (lattice (12, 12, 12), {k, 1e-3, k + 1});
  }
}

TEST (BatchedSearch, FindsCoincidentPoints)
{
  // Few of them ...
  Cloud cloud = uniformCube (400);
  for (int i = 0; i < 1200; ++i)
    cloud.push_back (cloud[static_cast<std::size_t> (i % 300)]);
  std::shuffle (cloud.begin(), cloud.end(), std::mt19937 (4));
  for (const int k : {1, 3, 4, 20})
    expectExact (cloud, {k});
  // ... and many, among others.
  cloud = uniformCube (1000);
  cloud.resize (3000, {0.25F, 0.5F, 0.125F});
  std::shuffle (cloud.begin(), cloud.end(), std::mt19937 (5));
  expectExact (cloud, {20});
  expectExact (cloud, {20, 1e-3, 160});
}

TEST (BatchedSearch, CopesWithFiftyThousandCoincidentPoints)
{
  Cloud cloud (50000, {3.0F, -2.0F, 1.0F});
  expectExact (cloud, {20}, 2503);
  for (std::size_t i = 0; i < 500; ++i)
    cloud[100 * i] = {3.0F + static_cast<float> (i % 7), static_cast<float> (i), 0.0F};
  expectExact (cloud, {20}, 2503);
}

TEST (BatchedSearch, FindsTheNeighborsOfOutliers)
{
  Cloud cloud = scaled (unitSphere (4000), 1e-3F, 1e-3F, 1e-3F);
  const Cloud far = scaled (uniformCube (60), 1e4F, 1e4F, 1e4F);
  cloud.insert (cloud.end(), far.begin(), far.end());
  expectExact (cloud, {20});
}

TEST (BatchedSearch, CopesWithClustersAndWithDensityOneToThousand)
{
  Cloud cloud;
  for (int cluster = 0; cluster < 300; ++cluster) {
    const float size = std::pow (10.0F, -static_cast<float> (cluster % 5));
    const Cloud centers = scaled (uniformCube (300, 9), 50.0F, 50.0F, 50.0F);
    for (const auto& p : uniformCube (13, static_cast<unsigned> (cluster)))
      cloud.push_back ({centers[static_cast<std::size_t> (cluster)][0] + size * p[0],
                        centers[static_cast<std::size_t> (cluster)][1] + size * p[1],
                        centers[static_cast<std::size_t> (cluster)][2] + size * p[2]});
  }
  for (const int k : {5, 12, 20})
    expectExact (cloud, {k});

  cloud = unitSphere (4000);
  for (auto& p : cloud)
    if (p[0] > 0.0F)
      p = {0.03F * p[0], 0.03F * p[1], 0.03F * p[2] + 1.0F};
  expectExact (cloud, {20});
}

TEST (BatchedSearch, IsExactOnPlanesAndLines)
{
  expectExact (scaled (uniformCube (2500), 1.0F, 1.0F, 0.0F), {20});
  expectExact (scaled (uniformCube (2500), 0.0F, 1.0F, 0.0F), {20});
  expectExact (scaled (uniformCube (2500), 1.0F, 1e-6F, 1e3F), {20});
}

TEST (BatchedSearch, IsExactFarFromTheOrigin)
{
  Cloud cloud = uniformCube (2500);
  for (auto& p : cloud)
    p = {p[0] + 5e6F, p[1] - 3e5F, p[2]};
  expectExact (cloud, {20});
}

TEST (BatchedSearch, KeepsHugeAndTinySquaresWithinFloats)
{
  const Cloud cloud = uniformCube (2500);
  const Neighbors expected = batched (cloud, {20});
  for (const int exponent : {-100, 126}) {
    const float scale = std::ldexp (1.0F, exponent);
    const Neighbors found = batched (scaled (cloud, scale, scale, scale), {20});
    ASSERT_EQ (found.size(), cloud.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
      ASSERT_EQ (found[i].size(), 20U) << "2^" << exponent;
      for (std::size_t j = 0; j < found[i].size(); ++j)
        ASSERT_EQ (found[i][j].second, expected[i][j].second) << "2^" << exponent;
    }
  }
  // An extent beyond the largest float, and below the smallest normal one.
  const float huge = std::numeric_limits<float>::max();
  const float tiny = 8.0F * std::numeric_limits<float>::denorm_min();
  for (const float unit : {huge, tiny}) {
    const Neighbors found =
        batched ({{unit, 0, 0}, {-unit, 0, 0}, {-unit / 2, 0, 0}, {0, unit, 0}}, {2});
    EXPECT_EQ (found[0][0].second, 3) << unit;
    EXPECT_EQ (found[3][1].second, 0) << unit;
  }
}

TEST (BatchedSearch, FindsTheSameWithAnyNumberOfThreads)
{
  Cloud cloud = unitSphere (60000);
  const Cloud grid = lattice (25, 25, 25);
  cloud.insert (cloud.end(), grid.begin(), grid.end());
  const Neighbors expected = batched (cloud, {20}, bestSimd(), 1);
  EXPECT_EQ (batched (cloud, {20}, bestSimd(), 4), expected);
  EXPECT_EQ (batched (cloud, {20}, bestSimd(), 3), expected);
}

TEST (BatchedSearch, FindsTheSameInAnyOrder)
{
  const Cloud cloud = unitSphere (5000);
  std::vector<std::int32_t> order (cloud.size());
  std::iota (order.begin(), order.end(), 0);
  std::shuffle (order.begin(), order.end(), std::mt19937 (6));
  Cloud shuffled;
  for (const std::int32_t i : order)
    shuffled.push_back (cloud[static_cast<std::size_t> (i)]);
  const Neighbors expected = batched (cloud, {20});
  const Neighbors found = batched (shuffled, {20});
  for (std::size_t i = 0; i < found.size(); ++i) {
    std::vector<Neighbor> mapped = found[i];
    for (Neighbor& neighbor : mapped)
      neighbor.second = order[static_cast<std::size_t> (neighbor.second)];
    std::sort (mapped.begin(), mapped.end());
    ASSERT_EQ (mapped, expected[static_cast<std::size_t> (order[i])]);
  }
}

TEST (BatchedSearch, FindsTheSameForSinglePointsInAnyOrder)
{
  Cloud cloud = uniformCube (3000);
  const Cloud grid = lattice (10, 10, 10);
  cloud.insert (cloud.end(), grid.begin(), grid.end());
  const PointTree tree = treeOf (cloud);
  std::vector<std::int32_t> places (cloud.size());
  std::iota (places.begin(), places.end(), 0);
  std::shuffle (places.begin(), places.end(), std::mt19937 (7));
  Neighbors found (cloud.size());
  LeafSearch search (tree, {20, 1e-3, 160});
  for (const std::int32_t place : places)
    collect (tree, search.searchPoint (place), found);
  EXPECT_EQ (found, batched (cloud, {20, 1e-3, 160}));
}

TEST (PointTree, HasEachPointOnceInDisjointLeaves)
{
  const Cloud cloud = uniformCube (5003);
  const PointTree tree = treeOf (cloud);
  ASSERT_EQ (tree.size, cloud.size());
  std::vector<int> seen (cloud.size(), 0);
  for (std::int32_t place = 0; place < static_cast<std::int32_t> (tree.size); ++place) {
    const std::int32_t index = tree.index (place);
    ++seen[static_cast<std::size_t> (index)];
    EXPECT_EQ (static_cast<float> (tree.leaves[place / LEAF_SIZE].x[place % LEAF_SIZE] *
                                   tree.unit),
               cloud[static_cast<std::size_t> (index)][0]);
  }
  EXPECT_EQ (std::count (seen.begin(), seen.end(), 1), 5003);
  const auto& groups = tree.levels[0];
  const auto apart = [&groups] (std::size_t a, std::size_t b) {
    for (int axis = 0; axis < 3; ++axis)
      if (groups[a / 8].low[axis][a % 8] >= groups[b / 8].high[axis][b % 8] ||
          groups[b / 8].low[axis][b % 8] >= groups[a / 8].high[axis][a % 8])
        return true;
    return false;
  };
  for (std::size_t a = 0; a < tree.leafCount(); ++a)
    for (std::size_t b = 0; b < a; ++b)
      ASSERT_TRUE (apart (a, b)) << a << " and " << b;
}

TEST (PointTree, RefusesPointsThatAreNotFinite)
{
  Cloud cloud = uniformCube (100);
  cloud[42][1] = std::numeric_limits<float>::quiet_NaN();
  PointTree tree;
  EXPECT_NE (
      buildPointTree (cloud[0].data(), 3, cloud.size(), 1, tree).find ("Point 42"),
      std::string::npos);
  EXPECT_EQ (tree.size, 0U);
  cloud[42][1] = std::numeric_limits<float>::infinity();
  EXPECT_NE (buildPointTree (cloud[0].data(), 3, cloud.size(), 1, tree), "");
}

TEST (PointTree, RefusesMorePointsThanItsIndicesReach)
{
  PointTree tree;
  const std::string error = buildPointTree (nullptr, 3, MOST_POINTS + 1, 1, tree);
  EXPECT_NE (error.find ("2147483648"), std::string::npos) << error;
}

} // namespace
} // namespace crest
} // namespace pcl
