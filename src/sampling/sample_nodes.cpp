// SPDX-License-Identifier: BSD-3-Clause
#include "sampling/sample_nodes.h"

#include "base/parallel.h"
#include "base/quantile.h"
#include "sampling/grid_positions.h"
#include "sampling/node_gathering.h"
#include "sampling/resolving_spacing.h"
#include "search/distinct_points.h"
#include "search/kernels.h"
#include "search/nearest_first.h"
#include "search/point_view.h"
#include "search/position_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>

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

/** \brief How far apart nodes are around a place: between the nearest windows, or 0
 * where most of them ask for none.
 */
float
spacingAt (const std::vector<Ranked>& nearest,
           const PointTree& windows,
           const ResolvingSpacing& wanted)
{
  const double farthest = squaredDistanceOf (nearest.back());
  double sum = 0.0;
  double weights = 0.0;
  std::size_t asking = 0;
  for (const Ranked& window : nearest) {
    const double spacing = wanted.spacings[windows.index (window.number)];
    if (!(spacing > 0.0))
      continue;
    // A window does not count for all, however near.
    const double weight =
        1.0 / (1e-3 * farthest + squaredDistanceOf (window) +
               static_cast<double> (std::numeric_limits<float>::min()));
    sum += weight * std::log (spacing);
    weights += weight;
    ++asking;
  }
  return 2 * asking > nearest.size() ? static_cast<float> (std::exp (sum / weights))
                                     : 0.0F;
}

/** \brief How far apart nodes are at each sample of a tree, by its index; the same for
 * those of a leaf.
 */
std::vector<float>
spreadSpacings (const PointTree& tree,
                const std::vector<SampleWindow>& windows,
                const ResolvingSpacing& wanted,
                const Workers& workers)
{
  constexpr std::size_t NEAREST = 4;
  std::vector<Eigen::Vector3f> middles;
  for (const SampleWindow& window : windows)
    middles.push_back (window.position.cast<float>());
  const std::shared_ptr<const PointTree> middle_tree =
      treeOver (middles, workers.threads);
  const auto unit = static_cast<float> (middle_tree->unit);
  std::vector<float> spacings (tree.size, 0.0F);
  const auto spreadOver = [&] (std::size_t, std::size_t first, std::size_t last) {
    NearestFirst search (*middle_tree, kernelsFor (bestSimd()));
    for (std::size_t leaf = first; leaf < last; ++leaf) {
      const PointLeaf& samples = tree.leaves[leaf];
      const auto count = static_cast<int> (
          std::min<std::size_t> (LEAF_SIZE, tree.size - leaf * LEAF_SIZE));
      const Eigen::Vector3f place =
          Eigen::Vector3f (samples.x[0], samples.y[0], samples.z[0]) / unit;
      const float spacing = spacingAt (
          search.search (
              -1, place.data(), NEAREST, std::numeric_limits<float>::infinity()),
          *middle_tree,
          wanted);
      for (int i = 0; i < count; ++i)
        spacings[samples.index[i]] = spacing;
    }
  };
  forEachBlock (tree.leafCount(), workers, spreadOver);
  return spacings;
}

/** \brief What the windows tell, in the unit of the cloud. */
SamplingFindings
summarize (std::vector<SampleWindow> windows, double unit)
{
  SamplingFindings findings;
  if (windows.empty())
    return findings;
  const auto ofAll = [&windows] (std::size_t percent, const auto& value) {
    std::vector<double> values;
    for (const SampleWindow& window : windows)
      values.push_back (value (window));
    return quantile (values, percent);
  };
  findings.spacing =
      unit * ofAll (50, [] (const SampleWindow& w) { return w.empty_spacing; });
  findings.anisotropy = ofAll (50, [] (const SampleWindow& w) { return w.anisotropy; });
  for (std::size_t i = 0; i < WINDOW_SIZES.size(); ++i)
    findings.noise[i] =
        unit * ofAll (25, [i] (const SampleWindow& w) { return w.noise[i]; });
  return findings;
}

/** \brief Enters what was gathered, and why. */
void
describe (const ResolvingSpacing& wanted,
          std::vector<float> spacings,
          double scale,
          SamplingFindings& findings)
{
  for (const SamplingFlaw flaw : wanted.flaws)
    if (flaw != SamplingFlaw::NONE)
      ++findings.flaws[static_cast<std::size_t> (flaw)];
  spacings.erase (std::remove (spacings.begin(), spacings.end(), 0.0F), spacings.end());
  findings.gathered = spacings.size();
  findings.resolving_spacing = quantile (spacings, 50) / scale;
}

/** \brief The points of a cloud that are finite and not far from all others, by the
 * quartiles of their coordinates.
 */
std::vector<index_t>
withoutStrays (const PointView& cloud)
{
  constexpr double FAR = 50.0;
  std::vector<index_t> points;
  for (std::size_t i = 0; i < cloud.size; ++i)
    if (cloud.positionOf (i).allFinite())
      points.push_back (static_cast<index_t> (i));
  if (points.empty())
    return points;
  Eigen::Vector3d low;
  Eigen::Vector3d high;
  std::vector<float> values (points.size());
  for (int axis = 0; axis < 3; ++axis) {
    for (std::size_t i = 0; i < points.size(); ++i)
      values[i] = cloud.positionOf (static_cast<std::size_t> (points[i]))[axis];
    low[axis] = static_cast<double> (quantile (values, 25));
    high[axis] = static_cast<double> (quantile (values, 75));
  }
  const double reach = FAR * (high - low).maxCoeff();
  if (!(reach > 0.0))
    return points;
  const auto isStray = [&] (index_t i) {
    const Eigen::Array3d place =
        cloud.positionOf (static_cast<std::size_t> (i)).cast<double>().array();
    return (place < low.array() - reach).any() || (place > high.array() + reach).any();
  };
  points.erase (std::remove_if (points.begin(), points.end(), isStray), points.end());
  return points;
}

/** \brief Samples without normals as a cloud. */
PointView
viewOf (const std::vector<Eigen::Vector3f>& positions)
{
  return {positions.empty() ? nullptr : positions.front().data(),
          nullptr,
          3,
          positions.size()};
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
  const std::vector<std::int32_t> places = tree->places();
  const std::size_t few = std::clamp (size / SAMPLES_EACH, LEAST, FEW);
  std::vector<SampleWindow> windows =
      measureWindows (*tree, places, few, widest, workers);
  result.findings = summarize (windows, tree->unit / distinct.scale);
  const double spacing = result.findings.spacing * distinct.scale;
  const auto on_grid = [&] {
    return spacing > 0.0 && lieOnGrid (distinct.positions, spacing);
  };
  const NoiseSearch search = !noise_tells ? NoiseSearch::NONE
                             : again      ? NoiseSearch::NODES
                             : on_grid()  ? NoiseSearch::GRID_SAMPLES
                                          : NoiseSearch::SAMPLES;
  ResolvingSpacing wanted = findResolvingSpacing (windows, search);
  if (!wanted.asks())
    return result;
  windows = measureWindows (*tree,
                            places,
                            std::clamp (size / SAMPLES_EACH_OF_MANY, few, MANY),
                            widest,
                            workers);
  wanted = findResolvingSpacing (windows, search);
  if (!wanted.asks())
    return result;
  std::vector<float> spacings = spreadSpacings (*tree, windows, wanted, workers);
  for (float& spacing : spacings)
    spacing *= static_cast<float> (tree->unit);
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
  describe (wanted, spacings, distinct.scale, result.findings);
  return result;
}

} // namespace

SampleNodes
resolveSamples (const PointView& cloud, const Workers& workers)
{
  constexpr int ROUNDS = 3;
  const std::vector<index_t> points = withoutStrays (cloud);
  std::vector<Eigen::Vector3f> positions;
  for (const index_t i : points)
    positions.push_back (cloud.positionOf (static_cast<std::size_t> (i)));
  SampleNodes nodes = resolveOnce (viewOf (positions), false, workers);
  nodes.cloud = fingerprint (positionsOf (cloud), workers);
  for (int round = 1; round < ROUNDS && !nodes.isEmpty(); ++round) {
    SampleNodes again = resolveOnce (nodes.view(), true, workers);
    if (again.isEmpty())
      break;
    for (index_t& node : nodes.node_of)
      node = again.node_of[node];
    nodes.positions = std::move (again.positions);
    nodes.findings.resolving_spacing = again.findings.resolving_spacing;
  }
  if (nodes.isEmpty())
    return nodes;
  nodes.findings.nodes = nodes.positions.size();
  std::vector<index_t> node_of (cloud.size, -1);
  for (std::size_t i = 0; i < points.size(); ++i)
    node_of[points[i]] = nodes.node_of[i];
  // What strays is a node by itself.
  for (std::size_t i = 0; i < cloud.size; ++i)
    if (node_of[i] < 0 && cloud.positionOf (i).allFinite()) {
      node_of[i] = static_cast<index_t> (nodes.positions.size());
      nodes.positions.push_back (cloud.positionOf (i));
    }
  nodes.node_of = std::move (node_of);
  return nodes;
}

} // namespace crest
} // namespace pcl
