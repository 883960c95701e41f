// SPDX-License-Identifier: BSD-3-Clause
#include "performance_work.h"

#include <pcl_crest/crest_line_estimation.h>

#include <pcl/features/normal_3d_omp.h>
#include <pcl/features/principal_curvatures.h>
#include <pcl/search/kdtree.h>

#include "curvature/quadric.h"
#include "peak_memory.h"
#include "search/leaf_search.h"
#include "surface/surface_graph.h"
#include <benchmark/benchmark.h>
#include <flann/flann.hpp>
#include <nanoflann.hpp>

#include <chrono>

namespace performance {

namespace {

using pcl::PointNormal;
using pcl::crest::Parameters;
using pcl::crest::Preset;
using pcl::crest::Simd;

int
neighborCount ()
{
  return Parameters().k;
}

struct OurRun {
  Preset preset;
  bool batched;
};

Counters
extractLines (const OurRun& how, const Cloud& cloud, unsigned threads)
{
  Parameters parameters;
  parameters.preset = how.preset;
  parameters.batched_search = how.batched;
  parameters.threads = threads;
  pcl::CrestLineEstimation<PointNormal> estimation;
  estimation.setInputCloud (cloud.points);
  estimation.setParameters (parameters);
  pcl::PointCloud<pcl::Label> labels;
  estimation.compute (labels);
  Counters counters;
  for (const pcl::crest::StageTime& time : estimation.getStatistics().times)
    counters.emplace_back ("ms " + time.stage, time.milliseconds);
  counters.emplace_back ("lines", estimation.getLines().size());
  return counters;
}

Counters
measureMemory (const OurRun& how, const Cloud& cloud, unsigned threads)
{
  const std::size_t peak = peakMemory ([&] { extractLines (how, cloud, threads); });
  return {{"bytes_per_point",
           static_cast<double> (peak) / static_cast<double> (cloud.points->size())}};
}

/** \brief A run with other thresholds after a first one; its time is the counter
 * "ms rerun", that of the first "ms first".
 */
Counters
runAgain (const std::function<void (Parameters&)>& change,
          const Cloud& cloud,
          unsigned threads)
{
  Parameters parameters;
  parameters.preset = Preset::PAPER;
  parameters.batched_search = true;
  parameters.threads = threads;
  pcl::CrestLineEstimation<PointNormal> estimation;
  estimation.setInputCloud (cloud.points);
  estimation.setKeepAnalysis (true);
  const auto milliseconds = [&] {
    estimation.setParameters (parameters);
    pcl::PointCloud<pcl::Label> labels;
    const auto start = std::chrono::steady_clock::now();
    estimation.compute (labels);
    return std::chrono::duration<double, std::milli> (std::chrono::steady_clock::now() -
                                                      start)
        .count();
  };
  const double first = milliseconds();
  estimation.setAnalysis (estimation.getAnalysis());
  change (parameters);
  return {{"ms first", first}, {"ms rerun", milliseconds()}};
}

/** \brief The curvature of the preset paper with and without AVX2: the counters "ms
 * avx2" and "ms portable".
 */
Counters
curvatureBySimd (const Cloud& cloud, unsigned threads)
{
  const pcl::crest::OrientedPoints points =
      pcl::crest::packOrientedPoints ({&cloud.points->front().x,
                                       &cloud.points->front().normal_x,
                                       sizeof (PointNormal) / sizeof (float),
                                       cloud.points->size()},
                                      threads);
  const pcl::crest::SurfaceGraph graph = pcl::crest::buildSurfaceGraph (
      points, pcl::crest::treeOver (points.positions, threads), Parameters());
  const auto milliseconds = [&] (Simd simd) {
    const auto start = std::chrono::steady_clock::now();
    benchmark::DoNotOptimize (
        pcl::crest::estimateCurvature (points, graph, threads, simd));
    return std::chrono::duration<double, std::milli> (std::chrono::steady_clock::now() -
                                                      start)
        .count();
  };
  // Memory is new to the first, which is not counted.
  milliseconds (Simd::PORTABLE);
  return {{"ms avx2", milliseconds (Simd::AVX2)},
          {"ms portable", milliseconds (Simd::PORTABLE)}};
}

template <typename Estimation, typename Output>
void
runFeature (Estimation& estimation, const Cloud& cloud, Output& output)
{
  const auto tree = pcl::make_shared<pcl::search::KdTree<PointNormal>>();
  estimation.setInputCloud (cloud.points);
  estimation.setSearchMethod (tree);
  estimation.setKSearch (neighborCount());
  estimation.compute (output);
  benchmark::DoNotOptimize (output.points.data());
}

Counters
principalCurvatures (const Cloud& cloud, unsigned /*threads*/)
{
  pcl::PrincipalCurvaturesEstimation<PointNormal, PointNormal> estimation;
  estimation.setInputNormals (cloud.points);
  pcl::PointCloud<pcl::PrincipalCurvatures> curvatures;
  runFeature (estimation, cloud, curvatures);
  return {};
}

Counters
normals (const Cloud& cloud, unsigned threads)
{
  pcl::NormalEstimationOMP<PointNormal, pcl::Normal> estimation (threads);
  pcl::PointCloud<pcl::Normal> found;
  runFeature (estimation, cloud, found);
  return {};
}

Counters
searchOfPcl (const Cloud& cloud, unsigned /*threads*/)
{
  pcl::search::KdTree<PointNormal> tree;
  tree.setInputCloud (cloud.points);
  pcl::Indices found;
  std::vector<float> squared;
  for (const PointNormal& point : *cloud.points)
    benchmark::DoNotOptimize (
        tree.nearestKSearch (point, neighborCount(), found, squared));
  return {};
}

/** \brief Our search, over coordinates as the pipeline packs them. */
Counters
batchedSearch (Simd simd, const Cloud& cloud, unsigned threads)
{
  pcl::crest::PointTree tree;
  pcl::crest::buildPointTree (&cloud.points->front().x,
                              sizeof (PointNormal) / sizeof (float),
                              cloud.points->size(),
                              threads,
                              tree,
                              simd);
  const auto leaves = static_cast<std::ptrdiff_t> (tree.leafCount());
#pragma omp parallel num_threads(threads)
  {
    // The point itself is one of the k.
    pcl::crest::LeafSearch search (tree, {neighborCount() - 1}, simd);
#pragma omp for schedule(dynamic, 64)
    for (std::ptrdiff_t leaf = 0; leaf < leaves; ++leaf)
      benchmark::DoNotOptimize (search.searchLeaf (leaf).places);
  }
  return {};
}

struct NanoflannCloud {
  const PointCloud& points;

  [[nodiscard]] std::size_t
  kdtree_get_point_count () const
  {
    return points.size();
  }
  [[nodiscard]] float
  kdtree_get_pt (std::size_t point, std::size_t axis) const
  {
    return points[point].data[axis];
  }
  template <typename Box>
  bool
  kdtree_get_bbox (Box& /*box*/) const
  {
    return false;
  }
};

Counters
nanoflannSearch (const Cloud& cloud, unsigned /*threads*/)
{
  using Distance = nanoflann::L2_Simple_Adaptor<float, NanoflannCloud>;
  using Tree =
      nanoflann::KDTreeSingleIndexAdaptor<Distance, NanoflannCloud, 3, std::uint32_t>;
  const NanoflannCloud adapted{*cloud.points};
  constexpr std::size_t LEAF_POINTS = 16;
  Tree tree (3, adapted, nanoflann::KDTreeSingleIndexAdaptorParams (LEAF_POINTS));
  const auto k = static_cast<std::size_t> (neighborCount());
  std::vector<std::uint32_t> found (k);
  std::vector<float> squared (k);
  for (const PointNormal& point : *cloud.points)
    benchmark::DoNotOptimize (
        tree.knnSearch (point.data, k, found.data(), squared.data()));
  return {};
}

Counters
flannSearch (const Cloud& cloud, unsigned threads)
{
  const std::size_t count = cloud.points->size();
  const flann::Matrix<float> points (
      const_cast<float*> (cloud.points->front().data), // FLANN only reads it
      count,
      3,
      sizeof (PointNormal));
  flann::Index<flann::L2_3D<float>> index (points, flann::KDTreeSingleIndexParams (15));
  index.buildIndex();
  constexpr std::size_t BATCH = 1024;
  const auto k = static_cast<std::size_t> (neighborCount());
  std::vector<int> found (BATCH * k);
  std::vector<float> squared (BATCH * k);
  flann::SearchParams parameters (flann::FLANN_CHECKS_UNLIMITED);
  parameters.cores = static_cast<int> (threads);
  for (std::size_t first = 0; first < count; first += BATCH) {
    const std::size_t size = std::min (BATCH, count - first);
    flann::Matrix<int> indices (found.data(), size, k);
    flann::Matrix<float> distances (squared.data(), size, k);
    index.knnSearch (
        flann::Matrix<float> (points[first], size, 3, sizeof (PointNormal)),
        indices,
        distances,
        k,
        parameters);
  }
  return {};
}

Work
ours (const std::string& name, const OurRun& how)
{
  return {name, true, [how] (const Cloud& cloud, unsigned threads) {
            return extractLines (how, cloud, threads);
          }};
}

Work
memoryOfOurs (const std::string& name, const OurRun& how)
{
  return {name, true, [how] (const Cloud& cloud, unsigned threads) {
            return measureMemory (how, cloud, threads);
          }};
}

Work
rerun (const std::string& name, const std::function<void (Parameters&)>& change)
{
  return {name, true, [change] (const Cloud& cloud, unsigned threads) {
            return runAgain (change, cloud, threads);
          }};
}

Work
searchWith (const std::string& name, Simd simd)
{
  return {name, true, [simd] (const Cloud& cloud, unsigned threads) {
            return batchedSearch (simd, cloud, threads);
          }};
}

} // namespace

const std::vector<Work>&
listWork ()
{
  static const std::vector<Work> all = [] {
    std::vector<Work> list{ours ("paper", {Preset::PAPER, true}),
                           ours ("paper_kdtree", {Preset::PAPER, false}),
                           ours ("auto", {Preset::AUTO, true}),
                           memoryOfOurs ("memory_paper", {Preset::PAPER, true}),
                           memoryOfOurs ("memory_auto", {Preset::AUTO, true}),
                           rerun ("rerun_M",
                                  [] (Parameters& p) {
                                    p.maximality = {0.1, 0.1};
                                  }),
                           rerun ("rerun_lower_M",
                                  [] (Parameters& p) {
                                    p.maximality = {0.001, 0.001};
                                  }),
                           rerun ("rerun_S",
                                  [] (Parameters& p) {
                                    p.min_size = {30, 30};
                                  }),
                           searchWith ("search_portable", Simd::PORTABLE),
                           {"curvature_simd", false, curvatureBySimd},
                           {"search_pcl", false, searchOfPcl},
                           {"search_nanoflann", false, nanoflannSearch},
                           {"search_flann", true, flannSearch},
                           {"pcl_principal_curvatures", false, principalCurvatures},
                           {"pcl_normals", true, normals}};
    for (const auto& [name, simd] :
         {std::pair{"search_sse2", Simd::SSE2}, std::pair{"search_avx2", Simd::AVX2}})
      if (pcl::crest::isAvailable (simd))
        list.push_back (searchWith (name, simd));
    return list;
  }();
  return all;
}

} // namespace performance
