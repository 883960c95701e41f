// SPDX-License-Identifier: BSD-3-Clause
#include "search/kd_order.h"

#include <algorithm>

namespace pcl {
namespace crest {

namespace {

/** Points are sorted in another way up to this number. */
constexpr std::ptrdiff_t SMALL = 64;

int
widestAxis (const Box& box)
{
  int widest = 0;
  for (int axis = 1; axis < 3; ++axis)
    if (box.high[axis] - box.low[axis] > box.high[widest] - box.low[widest])
      widest = axis;
  return widest;
}

/** \brief The bounds of every step-th point. */
Box
boundsOf (const PackedPoint* first, const PackedPoint* last, std::ptrdiff_t step)
{
  Box bounds{{first->coordinates[0], first->coordinates[1], first->coordinates[2]},
             {first->coordinates[0], first->coordinates[1], first->coordinates[2]}};
  for (; first < last; first += std::min (step, last - first))
    for (int axis = 0; axis < 3; ++axis) {
      bounds.low[axis] = std::min (bounds.low[axis], first->coordinates[axis]);
      bounds.high[axis] = std::max (bounds.high[axis], first->coordinates[axis]);
    }
  return bounds;
}

/** \brief The axis to split points along: the widest, as a sample of them tells, or
 * none (-1) if they are all coincident.
 */
int
splitAxis (const PackedPoint* first, const PackedPoint* last)
{
  constexpr std::ptrdiff_t SAMPLES = 256;
  const std::ptrdiff_t step = std::max<std::ptrdiff_t> (1, (last - first) / SAMPLES);
  Box bounds = boundsOf (first, last, step);
  int axis = widestAxis (bounds);
  if (bounds.low[axis] == bounds.high[axis] && step > 1) {
    bounds = boundsOf (first, last, 1);
    axis = widestAxis (bounds);
  }
  return bounds.low[axis] == bounds.high[axis] ? -1 : axis;
}

/** \brief A value close to the one of a given rank, on its far side: what is on the
 * wrong side of it is most of the points that need not be looked at any more.
 */
template <int Axis>
float
valueNear (const PackedPoint* first, const PackedPoint* wanted, const PackedPoint* last)
{
  constexpr std::ptrdiff_t SAMPLES = 64;
  // Twice the standard deviation of a quantile of so many.
  constexpr std::ptrdiff_t MARGIN = 8;
  float samples[SAMPLES];
  const std::ptrdiff_t count = last - first;
  for (std::ptrdiff_t i = 0; i < SAMPLES; ++i)
    samples[i] = first[i * count / SAMPLES].coordinates[Axis];
  const std::ptrdiff_t rank = (wanted - first) * SAMPLES / count;
  const std::ptrdiff_t beyond = 2 * rank <= SAMPLES
                                    ? std::min (rank + MARGIN, SAMPLES - 1)
                                    : std::max<std::ptrdiff_t> (rank - MARGIN, 0);
  std::nth_element (samples, samples + beyond, samples + SAMPLES);
  return samples[beyond];
}

/** \brief Brings the points below a value to the front. There are no branches to be
 * predicted, half of which would be wrong.
 * \return the first of the others
 */
template <int Axis>
PackedPoint*
partitionAt (PackedPoint* first, PackedPoint* last, float value)
{
  PackedPoint* border = first;
  for (PackedPoint* p = first; p < last; ++p) {
    const PackedPoint point = *p;
    *p = *border;
    *border = point;
    border += static_cast<std::ptrdiff_t> (point.coordinates[Axis] < value);
  }
  return border;
}

/** \brief Sorts a few points by counting how many are below each. */
template <int Axis>
void
sortByRank (PackedPoint* first, PackedPoint* last, const Kernels& kernels)
{
  float values[SMALL + KERNEL_SLACK];
  // Kernels load whole vectors, beyond the count too.
  std::int32_t indices[SMALL + KERNEL_SLACK] = {};
  std::int32_t ranks[SMALL + KERNEL_SLACK];
  PackedPoint points[SMALL];
  const auto count = static_cast<int> (last - first);
  for (int i = 0; i < count; ++i) {
    points[i] = first[i];
    values[i] = points[i].coordinates[Axis];
    indices[i] = points[i].index;
  }
  if (!kernels.rankDistinct (values, count, ranks))
    kernels.rankTied (values, indices, count, ranks);
  for (int i = 0; i < count; ++i)
    first[ranks[i]] = points[i];
}

/** \brief Does what std::nth_element does, faster. */
template <int Axis>
void
split (PackedPoint* first,
       PackedPoint* middle,
       PackedPoint* last,
       const Kernels& kernels)
{
  // More rounds are needed only among many equal coordinates, where they may be in
  // vain.
  for (int round = 0; round < 5 && last - first > SMALL; ++round) {
    PackedPoint* const border =
        partitionAt<Axis> (first, last, valueNear<Axis> (first, middle, last));
    if (border <= middle)
      first = border;
    else
      last = border;
  }
  if (last - first <= SMALL)
    sortByRank<Axis> (first, last, kernels);
  else
    std::nth_element (
        first, middle, last, [] (const PackedPoint& a, const PackedPoint& b) {
          return a.coordinates[Axis] < b.coordinates[Axis];
        });
}

/** \brief Puts the points of a range of leaves in the order of the tree. The left of
 * two halves has the largest power of two of leaves, all full: the borders of groups on
 * all levels are then borders of halves.
 */
void
arrange (PackedPoint* first, PackedPoint* last, const Kernels& kernels)
{
  constexpr std::ptrdiff_t WORTH_A_TASK = 1 << 14;
  while (last - first > LEAF_SIZE) {
    std::ptrdiff_t half = LEAF_SIZE;
    while (2 * half < last - first)
      half *= 2;
    const int axis = splitAxis (first, last);
    PackedPoint* const middle = first + half;
    if (axis < 0) {
      // Coincident points by index, so that a search may stop at the lowest.
      std::sort (first, last, [] (const PackedPoint& a, const PackedPoint& b) {
        return a.index < b.index;
      });
      return;
    }
    if (axis == 0)
      split<0> (first, middle, last, kernels);
    else if (axis == 1)
      split<1> (first, middle, last, kernels);
    else
      split<2> (first, middle, last, kernels);
    if (half >= WORTH_A_TASK) {
#pragma omp task firstprivate(first, middle) shared(kernels)
      arrange (first, middle, kernels);
    }
    else
      arrange (first, middle, kernels);
    first = middle;
  }
}

} // namespace

void
putInKdOrder (PackedPoint* points,
              std::size_t size,
              const Kernels& kernels,
              int threads)
{
#pragma omp parallel num_threads(threads)
#pragma omp single
  arrange (points, points + size, kernels);
}

} // namespace crest
} // namespace pcl
