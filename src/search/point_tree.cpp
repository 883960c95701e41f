// SPDX-License-Identifier: BSD-3-Clause
#include "search/point_tree.h"

#include "search/kd_order.h"
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>

namespace pcl {
namespace crest {

namespace {

/** \brief The bounding box of points as they are given, and the first that is not
 * finite or their number.
 */
struct Survey {
  Box bounds;
  std::size_t first_invalid;
};

Survey
survey (const float* coordinates, std::size_t stride, std::size_t size, int threads)
{
  constexpr float FAR_AWAY = std::numeric_limits<float>::infinity();
  float low[3] = {FAR_AWAY, FAR_AWAY, FAR_AWAY};
  float high[3] = {-FAR_AWAY, -FAR_AWAY, -FAR_AWAY};
  std::size_t first_invalid = size;
#pragma omp parallel for num_threads(threads) schedule(static)                         \
    reduction(min                                                                      \
              : low, first_invalid) reduction(max                                      \
                                              : high)
  for (std::size_t i = 0; i < size; ++i) {
    const float* const p = coordinates + i * stride;
    if (!std::isfinite (p[0]) || !std::isfinite (p[1]) || !std::isfinite (p[2]))
      first_invalid = std::min (first_invalid, i);
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = std::min (low[axis], p[axis]);
      high[axis] = std::max (high[axis], p[axis]);
    }
  }
  return {{{low[0], low[1], low[2]}, {high[0], high[1], high[2]}}, first_invalid};
}

double
unitOf (const Box& bounds)
{
  double extent = 0.0;
  double largest = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    const double low = bounds.low[axis];
    const double high = bounds.high[axis];
    extent = std::max (extent, high - low);
    largest = std::max ({largest, std::abs (low), std::abs (high)});
  }
  return unitFor (extent, largest);
}

/** \brief Memory that holds the points one after the other, then the leaves. */
void*
allocateLeaves (std::size_t leaves)
{
  return ::operator new (leaves * sizeof (PointLeaf),
                         std::align_val_t{alignof (PointLeaf)});
}

/** \brief Makes a leaf in the place of its points. */
void
makeLeaf (PackedPoint* points, int count)
{
  static_assert (sizeof (PointLeaf) == LEAF_SIZE * sizeof (PackedPoint),
                 "a leaf has to fit where its points were");
  PointLeaf leaf;
  for (int i = 0; i < LEAF_SIZE; ++i) {
    constexpr float FAR_AWAY = std::numeric_limits<float>::infinity();
    const PackedPoint point =
        i < count ? points[i] : PackedPoint{{FAR_AWAY, FAR_AWAY, FAR_AWAY}, -1};
    leaf.x[i] = point.coordinates[0];
    leaf.y[i] = point.coordinates[1];
    leaf.z[i] = point.coordinates[2];
    leaf.index[i] = point.index;
  }
  new (points) PointLeaf (leaf);
}

int
pointsOfLeaf (std::size_t size, std::ptrdiff_t leaf)
{
  const std::size_t first = static_cast<std::size_t> (leaf) * LEAF_SIZE;
  return static_cast<int> (std::min<std::size_t> (size - first, LEAF_SIZE));
}

BoxGroup
emptyGroup ()
{
  BoxGroup group;
  for (int axis = 0; axis < 3; ++axis) {
    std::fill_n (group.low[axis], LEAF_SIZE, std::numeric_limits<float>::infinity());
    std::fill_n (group.high[axis], LEAF_SIZE, -std::numeric_limits<float>::infinity());
  }
  std::fill_n (group.lowest_index, LEAF_SIZE, std::numeric_limits<std::int32_t>::max());
  return group;
}

void
addLeafBox (BoxGroup& group, int i, const PointLeaf& leaf, int points)
{
  const float* const coordinates[] = {leaf.x, leaf.y, leaf.z};
  for (int axis = 0; axis < 3; ++axis) {
    const auto [low, high] =
        std::minmax_element (coordinates[axis], coordinates[axis] + points);
    group.low[axis][i] = *low;
    group.high[axis][i] = *high;
  }
  group.lowest_index[i] = *std::min_element (leaf.index, leaf.index + points);
}

void
addGroupBox (BoxGroup& group, int i, const BoxGroup& child)
{
  for (int axis = 0; axis < 3; ++axis) {
    group.low[axis][i] =
        *std::min_element (child.low[axis], child.low[axis] + LEAF_SIZE);
    group.high[axis][i] =
        *std::max_element (child.high[axis], child.high[axis] + LEAF_SIZE);
  }
  group.lowest_index[i] =
      *std::min_element (child.lowest_index, child.lowest_index + LEAF_SIZE);
}

std::size_t
groupCount (std::size_t children)
{
  return (children + LEAF_SIZE - 1) / LEAF_SIZE;
}

/** \brief The boxes of all levels, from the leaves up. */
std::vector<std::vector<BoxGroup>>
boxesOver (const PointTree& tree, int threads)
{
  std::vector<std::vector<BoxGroup>> levels;
  levels.emplace_back (groupCount (tree.leafCount()), emptyGroup());
  const auto leaves = static_cast<std::ptrdiff_t> (tree.leafCount());
#pragma omp parallel for num_threads(threads) schedule(static, 4 * LEAF_SIZE)
  for (std::ptrdiff_t l = 0; l < leaves; ++l)
    addLeafBox (levels[0][l / LEAF_SIZE],
                static_cast<int> (l % LEAF_SIZE),
                tree.leaves[l],
                pointsOfLeaf (tree.size, l));
  while (levels.back().size() > 1) {
    const std::vector<BoxGroup>& children = levels.back();
    std::vector<BoxGroup> groups (groupCount (children.size()), emptyGroup());
    for (std::size_t c = 0; c < children.size(); ++c)
      addGroupBox (
          groups[c / LEAF_SIZE], static_cast<int> (c % LEAF_SIZE), children[c]);
    levels.push_back (std::move (groups));
  }
  return levels;
}

} // namespace

void
PointTree::Release::operator() (PointLeaf* leaves) const
{
  ::operator delete (leaves, std::align_val_t{alignof (PointLeaf)});
}

std::vector<std::int32_t>
PointTree::places() const
{
  std::vector<std::int32_t> places (size);
  for (std::size_t place = 0; place < size; ++place)
    places[index (static_cast<std::int32_t> (place))] =
        static_cast<std::int32_t> (place);
  return places;
}

double
unitFor (double extent, double largest)
{
  // A plane far away may be at the largest floats and still be narrow.
  constexpr int LARGEST_EXPONENT = std::numeric_limits<float>::max_exponent - 2;
  int exponent = 0;
  int exponent_of_largest = 0;
  std::frexp (extent, &exponent);
  std::frexp (largest, &exponent_of_largest);
  return std::ldexp (1.0, std::max (exponent, exponent_of_largest - LARGEST_EXPONENT));
}

std::string
buildPointTree (const float* coordinates,
                std::size_t stride,
                std::size_t size,
                unsigned threads,
                PointTree& tree,
                Simd simd)
{
  tree = PointTree();
  if (size > MOST_POINTS)
    return std::to_string (size) + " points are too many: the neighbour search takes " +
           std::to_string (MOST_POINTS);
  if (size == 0)
    return {};
  const int thread_count =
      threads == 0 ? omp_get_num_procs() : static_cast<int> (threads);
  const Survey found = survey (coordinates, stride, size, thread_count);
  if (found.first_invalid < size)
    return "Point " + std::to_string (found.first_invalid) +
           " is not finite: the neighbour search takes finite points only";

  tree.size = size;
  tree.unit = unitOf (found.bounds);
  const auto leaves = static_cast<std::ptrdiff_t> (tree.leafCount());
  void* const memory = allocateLeaves (tree.leafCount());
  auto* const points = static_cast<PackedPoint*> (memory);
  const double scale = 1.0 / tree.unit;
#pragma omp parallel for num_threads(thread_count) schedule(static)
  for (std::size_t i = 0; i < size; ++i) {
    const float* const p = coordinates + i * stride;
    new (points + i) PackedPoint{{static_cast<float> (scale * p[0]),
                                  static_cast<float> (scale * p[1]),
                                  static_cast<float> (scale * p[2])},
                                 static_cast<std::int32_t> (i)};
  }
  putInKdOrder (points, size, kernelsFor (simd), thread_count);
#pragma omp parallel for num_threads(thread_count) schedule(static)
  for (std::ptrdiff_t l = 0; l < leaves; ++l)
    makeLeaf (points + l * LEAF_SIZE, pointsOfLeaf (size, l));
  tree.leaves.reset (std::launder (static_cast<PointLeaf*> (memory)));
  tree.levels = boxesOver (tree, thread_count);
  return {};
}

} // namespace crest
} // namespace pcl
