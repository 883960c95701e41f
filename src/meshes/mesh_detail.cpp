// SPDX-License-Identifier: BSD-3-Clause
#include "meshes/mesh_detail.h"

#include "base/disjoint_sets.h"
#include "base/parallel.h"
#include "search/leaf_search.h"
#include "search/position_tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace pcl {
namespace crest {

namespace {

constexpr double PI = 3.14159265358979323846;

/** \brief A number that counts as much as its weight. */
using Weighted = std::pair<double, double>;

/** \brief The value that a part of the weight is below; 0 of none. */
double
weightedQuantile (std::vector<Weighted>& values, double part)
{
  std::sort (values.begin(), values.end());
  double all = 0.0;
  for (const Weighted& value : values)
    all += value.second;
  double sum = 0.0;
  for (const Weighted& value : values) {
    sum += value.second;
    if (sum > part * all)
      return value.first;
  }
  return 0.0;
}

/** \brief Of each point that is a corner its mean distance to the six nearest of these,
 * the spacing of the lines' parameters.
 */
std::vector<double>
cornerSpacings (const PointView& cloud, const Faces& triangles, const Workers& workers)
{
  constexpr int NEAREST = 6;
  std::vector<std::uint8_t> is_corner (cloud.size, 0);
  for (const index_t corner : triangles.corners)
    is_corner[corner] = 1;
  std::vector<index_t> corners;
  std::vector<Eigen::Vector3f> positions;
  for (std::size_t i = 0; i < cloud.size; ++i)
    if (is_corner[i] != 0) {
      corners.push_back (static_cast<index_t> (i));
      positions.push_back (cloud.positionOf (i));
    }
  const std::shared_ptr<const PointTree> tree = treeOver (positions, workers.threads);
  std::vector<double> spacings (cloud.size, 0.0);
  forEachBlock (
      tree->leafCount(),
      workers,
      [&] (std::size_t, std::size_t first, std::size_t last) {
        LeafSearch search (*tree, {NEAREST});
        for (std::size_t leaf = first; leaf < last; ++leaf) {
          const LeafNeighbors& found = search.searchLeaf (leaf);
          for (int i = 0; i < found.count; ++i) {
            double sum = 0.0;
            for (std::size_t j = found.offsets[i]; j < found.offsets[i + 1]; ++j)
              sum += std::sqrt (static_cast<double> (found.squared_distances[j]));
            const auto count =
                static_cast<double> (found.offsets[i + 1] - found.offsets[i]);
            spacings[corners[tree->index (found.first + i)]] =
                tree->unit * sum / std::max (1.0, count);
          }
        }
      });
  return spacings;
}

/** \brief An edge across which the surface turns by more than lines need by default. */
struct SharpEdge {
  index_t from, to;
  index_t face, other;
  double length;
};

/** \brief What the edges of a mesh divide it into. */
struct EdgeFindings {
  explicit EdgeFindings (const PointView& cloud, const Faces& triangles)
  : regions (triangles.size())
  , outlines (triangles.size(), 0.0)
  , goes_on (triangles.size(), 0)
  , on_outline (cloud.size, 0)
  {}

  /** faces that smooth edges connect */
  DisjointSets regions;
  /** of each face the length of its sharp and open edges */
  std::vector<double> outlines;
  /** of each face whether another goes on in its plane */
  std::vector<std::uint8_t> goes_on;
  /** of each point whether it is on a sharp or open edge */
  std::vector<std::uint8_t> on_outline;
  std::vector<SharpEdge> sharp;
  bool is_flat = true;
};

EdgeFindings
findEdges (const PointView& cloud,
           const Faces& triangles,
           const EdgeTable& edges,
           const TriangleShapes& shapes)
{
  const double sharp_cosine = std::cos (25.0 / 180.0 * PI);
  const double flat_cosine = std::cos (1.0 / 180.0 * PI);
  EdgeFindings found (cloud, triangles);
  forEachEdge (edges, [&] (index_t smaller, const FaceEdge* edge, std::size_t sides) {
    double cosine = -1.0;
    if (sides == 2) {
      const Eigen::Vector3d& n = shapes.normals[edge[0].face];
      const Eigen::Vector3d& m = shapes.normals[edge[1].face];
      // Where there is none it is no edge that can be told.
      cosine = n.isZero (0.0) || m.isZero (0.0) ? 1.0 : n.dot (m);
      found.is_flat = found.is_flat && cosine > flat_cosine;
      if (cosine > flat_cosine)
        found.goes_on[edge[0].face] = found.goes_on[edge[1].face] = 1;
    }
    if (cosine > sharp_cosine) {
      found.regions.unite (edge[0].face, edge[1].face);
      return;
    }
    const index_t larger = edge->larger;
    found.on_outline[smaller] = found.on_outline[larger] = 1;
    const double length =
        (cloud.positionOf (static_cast<std::size_t> (smaller)).cast<double>() -
         cloud.positionOf (static_cast<std::size_t> (larger)).cast<double>())
            .norm();
    for (std::size_t i = 0; i < sides; ++i)
      found.outlines[edge[i].face] += length;
    if (sides == 2)
      found.sharp.push_back ({smaller, larger, edge[0].face, edge[1].face, length});
  });
  return found;
}

/** \brief Of each region whether hardly any vertices are inside: not one for six faces,
 * where a grid two cells wide has one for four, or not even enough for a fit.
 */
std::vector<std::uint8_t>
findBareRegions (const Faces& triangles, EdgeFindings& found)
{
  constexpr std::size_t FEW = 10;
  constexpr std::size_t FACES_A_VERTEX = 6;
  std::vector<std::uint8_t> passed = found.on_outline;
  std::vector<std::size_t> faces (triangles.size(), 0);
  std::vector<std::size_t> inside (triangles.size(), 0);
  for (std::size_t face = 0; face < triangles.size(); ++face) {
    const index_t region = found.regions.find (static_cast<index_t> (face));
    ++faces[region];
    for (std::size_t i = 3 * face; i < 3 * face + 3; ++i) {
      const index_t corner = triangles.corners[i];
      inside[region] += passed[corner] == 0 ? 1 : 0;
      passed[corner] = 1;
    }
  }
  std::vector<std::uint8_t> bare;
  for (std::size_t i = 0; i < faces.size(); ++i)
    bare.push_back (inside[i] < FEW || FACES_A_VERTEX * inside[i] < faces[i] ? 1 : 0);
  return bare;
}

/** \brief Of each sharp edge the length of the chain that it is of, from corner to
 * corner.
 */
std::vector<double>
chainLengths (std::size_t points, const std::vector<SharpEdge>& edges)
{
  std::vector<std::array<index_t, 2>> first_at (points, {-1, -1});
  std::vector<int> meeting (points, 0);
  for (std::size_t i = 0; i < edges.size(); ++i)
    for (const index_t end : {edges[i].from, edges[i].to}) {
      if (meeting[end] < 2)
        first_at[end][meeting[end]] = static_cast<index_t> (i);
      ++meeting[end];
    }
  DisjointSets chains (edges.size());
  for (std::size_t i = 0; i < points; ++i)
    if (meeting[i] == 2)
      chains.unite (first_at[i][0], first_at[i][1]);
  std::vector<double> sums (edges.size(), 0.0);
  for (std::size_t i = 0; i < edges.size(); ++i)
    sums[chains.find (static_cast<index_t> (i))] += edges[i].length;
  std::vector<double> lengths;
  for (std::size_t i = 0; i < edges.size(); ++i)
    lengths.push_back (sums[chains.find (static_cast<index_t> (i))]);
  return lengths;
}

/** So much longer than a width of as many samples: shorter lines are noise to most. */
constexpr double CHAIN_OVER_WIDTH = 7.0 / 4.0;

/** \brief Twice the area over the outline, of the region of each face: the width of a
 * strip, and the radius of a disk. 0 where nothing bounds it.
 */
std::vector<double>
regionWidths (const std::vector<double>& areas, EdgeFindings& found)
{
  std::vector<double> region_areas (areas.size(), 0.0);
  std::vector<double> outlines (areas.size(), 0.0);
  for (std::size_t face = 0; face < areas.size(); ++face) {
    const index_t region = found.regions.find (static_cast<index_t> (face));
    region_areas[region] += areas[face];
    outlines[region] += found.outlines[face];
  }
  std::vector<double> widths;
  for (std::size_t face = 0; face < areas.size(); ++face) {
    const index_t region = found.regions.find (static_cast<index_t> (face));
    widths.push_back (
        outlines[region] > 0.0 ? 2.0 * region_areas[region] / outlines[region] : 0.0);
  }
  return widths;
}

/** \brief The width that all but one percent of the sharp edges leave beside them. */
double
featureWidth (const std::vector<double>& region_widths,
              std::size_t points,
              const std::vector<SharpEdge>& edges)
{
  constexpr double STRAY = 0.01;
  const std::vector<double> chains = chainLengths (points, edges);
  DisjointSets rings (points);
  for (const SharpEdge& edge : edges)
    rings.unite (edge.from, edge.to);
  std::vector<double> ring_lengths (points, 0.0);
  for (const SharpEdge& edge : edges)
    ring_lengths[rings.find (edge.from)] += edge.length;
  std::vector<Weighted> widths;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const SharpEdge& edge = edges[i];
    widths.emplace_back (std::min ({ring_lengths[rings.find (edge.from)] / (2.0 * PI),
                                    chains[i] / CHAIN_OVER_WIDTH,
                                    region_widths[edge.face],
                                    region_widths[edge.other]}),
                         edge.length);
  }
  return weightedQuantile (widths, STRAY);
}

/** What it takes to find the edges of a feature: planes two or three samples wide on
 * either side. */
constexpr double SAMPLES_PER_WIDTH = 4.0;
/** Windows that tell the sampling have a radius of 11. */
constexpr double SAMPLES_PER_REGION = 20.0;
/** Enough for lines that look smooth, and as many as take some seconds. */
constexpr double LEAST_SAMPLES = 4e4;
constexpr double MOST_SAMPLES = 1e6;

} // namespace

bool
MeshDetail::needsSamples() const
{
  constexpr double LEAST_PART = 0.25;
  return !is_flat && untold_area > LEAST_PART * area;
}

double
MeshDetail::resolvingSpacing() const
{
  constexpr double MUCH = 0.25;
  double spacing = std::sqrt (area / LEAST_SAMPLES);
  if (feature_width > 0.0)
    spacing = std::min (spacing, feature_width / SAMPLES_PER_WIDTH);
  if (region_width > 0.0)
    spacing = std::min (spacing, region_width / SAMPLES_PER_REGION);
  if (area - untold_area > MUCH * area && vertex_spacing > 0.0)
    spacing = std::min (spacing, vertex_spacing);
  return std::max (spacing, std::sqrt (area / MOST_SAMPLES));
}

bool
MeshDetail::isFinerThanSamples() const
{
  return feature_width > 0.0 && feature_width < SAMPLES_PER_WIDTH * resolvingSpacing();
}

MeshDetail
measureDetail (const PointView& cloud,
               const Faces& triangles,
               const EdgeTable& edges,
               const TriangleShapes& shapes,
               const Workers& workers)
{
  constexpr double SPACINGS_ACROSS = 4.0;
  constexpr double MUCH_OF_EXTENT = 0.1;
  EdgeFindings found = findEdges (cloud, triangles, edges, shapes);
  const std::vector<std::uint8_t> bare = findBareRegions (triangles, found);
  const std::vector<double> spacings = cornerSpacings (cloud, triangles, workers);
  const double large = MUCH_OF_EXTENT * extentOf (cloud, triangles);
  MeshDetail detail;
  std::vector<Weighted> told;
  for (std::size_t face = 0; face < triangles.size(); ++face) {
    const double area = shapes.areas[face];
    const double longest = longestSide (cloud, triangles, face);
    double spacing = 0.0;
    for (std::size_t i = 3 * face; i < 3 * face + 3; ++i)
      spacing = std::max (spacing, spacings[triangles.corners[i]]);
    const bool is_bare = bare[found.regions.find (static_cast<index_t> (face))] != 0;
    detail.area += area;
    if (longest > SPACINGS_ACROSS * spacing ||
        (is_bare && (found.goes_on[face] != 0 || longest > large)))
      detail.untold_area += area;
    else
      told.emplace_back (spacing, area);
  }
  detail.vertex_spacing = weightedQuantile (told, 0.5);
  detail.is_flat = found.is_flat;
  const std::vector<double> widths = regionWidths (shapes.areas, found);
  detail.feature_width = featureWidth (widths, cloud.size, found.sharp);
  std::vector<Weighted> bounded;
  for (std::size_t face = 0; face < widths.size(); ++face)
    if (widths[face] > 0.0)
      bounded.emplace_back (widths[face], shapes.areas[face]);
  detail.region_width = weightedQuantile (bounded, 0.5);
  return detail;
}

} // namespace crest
} // namespace pcl
