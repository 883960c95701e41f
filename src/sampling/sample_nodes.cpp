// SPDX-License-Identifier: BSD-3-Clause
#include "sampling/sample_nodes.h"

#include "base/parallel.h"
#include "sampling/node_gathering.h"
#include "sampling/resolving_spacing.h"
#include "search/distinct_points.h"
#include "search/kernels.h"
#include "search/nearest_first.h"
#include "search/position_tree.h"

#include <algorithm>
#include <cmath>

namespace pcl {
namespace crest {

namespace {

/** Fewer samples tell nothing but what is in them. */
constexpr std::size_t LEAST_SAMPLES = 1000;

/** \brief Windows around samples that are spread along the curve. */
std::vector<SampleWindow>
measureWindows (const PointTree& tree,
                const std::vector<std::int32_t>& places,
                std::size_t count,
                int widest,
                const Workers& workers)
{
  // Not at regular steps, which grids and scan lines have as well.
  constexpr std::uint64_t SPREAD = 0x9e3779b97f4a7c15ULL;
  std::vector<SampleWindow> windows (count);
  std::vector<char> is_measured (count, 0);
  constexpr std::size_t BUNCH = 16;
  const auto measureBunch = [&] (std::size_t, std::size_t begin, std::size_t end) {
    WindowMeasure measure (tree, widest);
    for (std::size_t i = begin; i < end; ++i) {
      const std::size_t first = i * tree.size / count;
      const std::size_t last = (i + 1) * tree.size / count;
      const std::size_t sample = first + (i * SPREAD >> 32U) % (last - first);
      is_measured[i] = measure.measure (places[sample], windows[i]) ? 1 : 0;
    }
  };
  forEachBlock (count, workers, measureBunch, BUNCH);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < count; ++i)
    if (is_measured[i] != 0)
      windows[kept++] = windows[i];
  windows.resize (kept);
  return windows;
}

/** \brief How far apart nodes are at each of the positions: between the nearest
 * windows, or 0 where most of them ask for none.
 */
std::vector<float>
spreadSpacings (const std::vector<Eigen::Vector3f>& positions,
                const std::vector<SampleWindow>& windows,
                const ResolvingSpacing& wanted,
                const Workers& workers)
{
  constexpr std::size_t NEAREST = 4;
  std::vector<Eigen::Vector3f> middles;
  for (const SampleWindow& window : windows)
    middles.push_back (window.position.cast<float>());
  const std::shared_ptr<const PointTree> tree = treeOver (middles, workers.threads);
  const auto unit = static_cast<float> (tree->unit);
  std::vector<float> spacings (positions.size(), 0.0F);
  forEachBlock (positions.size(),
                workers,
                [&] (std::size_t, std::size_t first, std::size_t last) {
                  NearestFirst search (*tree, kernelsFor (bestSimd()));
                  for (; first < last; ++first) {
                    const Eigen::Vector3f place = positions[first] / unit;
                    const std::vector<Ranked>& found =
                        search.search (-1,
                                       place.data(),
                                       NEAREST,
                                       std::numeric_limits<float>::infinity());
                    const double farthest = squaredDistanceOf (found.back());
                    double sum = 0.0;
                    double weights = 0.0;
                    int asking = 0;
                    for (const Ranked& window : found) {
                      const double spacing =
                          wanted.spacings[tree->index (window.number)];
                      if (!(spacing > 0.0))
                        continue;
                      const double weight =
                          1.0 / (1e-3 * farthest + squaredDistanceOf (window) + 1e-30);
                      sum += weight * std::log (spacing);
                      weights += weight;
                      ++asking;
                    }
                    if (2 * asking > static_cast<int> (found.size()))
                      spacings[first] = static_cast<float> (std::exp (sum / weights));
                  }
                });
  return spacings;
}

/** \brief The medians of what the windows tell, in the unit of the cloud. */
SamplingFindings
summarize (std::vector<SampleWindow> windows, double unit)
{
  SamplingFindings findings;
  if (windows.empty())
    return findings;
  const auto median = [&windows] (const auto& value) {
    std::vector<double> values;
    for (const SampleWindow& window : windows)
      values.push_back (value (window));
    const auto middle =
        values.begin() + static_cast<std::ptrdiff_t> (values.size() / 2);
    std::nth_element (values.begin(), middle, values.end());
    return *middle;
  };
  findings.spacing =
      unit * median ([] (const SampleWindow& w) { return w.empty_spacing; });
  findings.anisotropy = median ([] (const SampleWindow& w) { return w.anisotropy; });
  for (std::size_t i = 0; i < WINDOW_SIZES.size(); ++i)
    findings.noise[i] =
        unit * median ([i] (const SampleWindow& w) { return w.noise[i]; });
  return findings;
}

/** \brief One round of gathering. */
SampleNodes
resolveOnce (const PointView& cloud, bool again, const Workers& workers)
{
  constexpr std::size_t FEW = 256;
  constexpr std::size_t LEAST = 96;
  constexpr std::size_t SAMPLES_EACH = 96;
  constexpr std::size_t MANY = 2048;
  constexpr std::size_t SAMPLES_EACH_OF_MANY = 32;
  SampleNodes result;
  const DistinctPoints distinct = takeDistinct (cloud, workers.threads);
  const std::size_t size = distinct.positions.size();
  if (size < LEAST_SAMPLES)
    return result;
  const std::shared_ptr<const PointTree> tree =
      treeOver (distinct.positions, workers.threads);
  // Windows that hold much of the cloud tell of its shape rather than of noise.
  const bool noise_tells = size >= 16 * static_cast<std::size_t> (WINDOW_SIZES.back());
  const int widest = noise_tells
                         ? WINDOW_SIZES.back()
                         : std::max (WINDOW_SIZES[1], static_cast<int> (size / 16));
  const NoiseSearch search = !noise_tells ? NoiseSearch::NONE
                             : again      ? NoiseSearch::NODES
                                          : NoiseSearch::SAMPLES;
  const std::vector<std::int32_t> places = tree->places();
  const auto probe = [&] (std::size_t count, std::vector<SampleWindow>& windows) {
    windows = measureWindows (*tree, places, count, widest, workers);
    return findResolvingSpacing (windows, search);
  };
  const std::size_t few = std::clamp (size / SAMPLES_EACH, LEAST, FEW);
  std::vector<SampleWindow> windows;
  ResolvingSpacing wanted = probe (few, windows);
  result.findings = summarize (windows, tree->unit / distinct.scale);
  if (!wanted.asks())
    return result;
  wanted = probe (std::clamp (size / SAMPLES_EACH_OF_MANY, few, MANY), windows);
  for (SampleWindow& window : windows)
    window.position *= tree->unit;
  for (double& spacing : wanted.spacings)
    spacing *= tree->unit;
  if (!wanted.asks())
    return result;
  const std::vector<float> spacings =
      spreadSpacings (distinct.positions, windows, wanted, workers);
  if (std::none_of (spacings.begin(), spacings.end(), [] (float s) { return s > 0; }))
    return result;
  const GatheredSamples gathered =
      gatherSamples (*tree, distinct.positions, spacings, workers);

  std::vector<Eigen::Vector3d> sums (gathered.nodes, Eigen::Vector3d::Zero());
  std::vector<double> counts (gathered.nodes, 0.0);
  result.node_of.assign (cloud.size, -1);
  for (std::size_t i = 0; i < size; ++i) {
    const index_t node = gathered.node_of[i];
    sums[node] += distinct.positions[i].cast<double>();
    counts[node] += 1.0;
    for (std::size_t j = distinct.begins[i]; j < distinct.begins[i + 1]; ++j)
      result.node_of[distinct.points[j].cloud_index] = node;
  }
  for (std::size_t node = 0; node < gathered.nodes; ++node)
    result.positions.emplace_back (
        (sums[node] / counts[node] / distinct.scale + distinct.center).cast<float>());
  for (const float spacing : spacings)
    if (spacing > 0.0F)
      ++result.findings.gathered;
  result.findings.nodes = gathered.nodes;
  for (const SamplingFlaw flaw : wanted.flaws)
    if (flaw != SamplingFlaw::NONE)
      ++result.findings.flaws[static_cast<std::size_t> (flaw)];
  return result;
}

} // namespace

SampleNodes
resolveSamples (const PointView& cloud, const Workers& workers)
{
  constexpr int ROUNDS = 3;
  SampleNodes nodes = resolveOnce (cloud, false, workers);
  for (int round = 1; round < ROUNDS && !nodes.isEmpty(); ++round) {
    SampleNodes again = resolveOnce (nodes.view(), true, workers);
    if (again.isEmpty())
      break;
    for (index_t& node : nodes.node_of)
      if (node >= 0)
        node = again.node_of[node];
    nodes.positions = std::move (again.positions);
    nodes.findings.nodes = nodes.positions.size();
  }
  return nodes;
}

} // namespace crest
} // namespace pcl
