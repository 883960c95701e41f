// SPDX-License-Identifier: BSD-3-Clause
#include "search/kernels.h"

#include <algorithm>
#include <limits>

namespace pcl {
namespace crest {

namespace {

unsigned
boxesWithin (const BoxGroup& group,
             const Box& box,
             float limit,
             float* squared_distances)
{
  float gaps[3][LEAF_SIZE];
  for (int axis = 0; axis < 3; ++axis)
    for (int i = 0; i < LEAF_SIZE; ++i)
      gaps[axis][i] = std::max (std::max (group.low[axis][i] - box.high[axis],
                                          box.low[axis] - group.high[axis][i]),
                                0.0F);
  unsigned within = 0;
  for (int i = 0; i < LEAF_SIZE; ++i) {
    squared_distances[i] =
        (gaps[0][i] * gaps[0][i] + gaps[1][i] * gaps[1][i]) + gaps[2][i] * gaps[2][i];
    within |= static_cast<unsigned> (squared_distances[i] <= limit) << i;
  }
  return within;
}

int
pointsWithin (const PointLeaf* leaves,
              const std::int32_t* numbers,
              int count,
              const float* point,
              std::int32_t self,
              float limit,
              float* squared_distances,
              std::int32_t* places)
{
  int found = 0;
  for (int l = 0; l < count; ++l) {
    const PointLeaf& leaf = leaves[numbers[l]];
    float squared[LEAF_SIZE];
    for (int i = 0; i < LEAF_SIZE; ++i) {
      const float dx = leaf.x[i] - point[0];
      const float dy = leaf.y[i] - point[1];
      const float dz = leaf.z[i] - point[2];
      squared[i] = (dx * dx + dy * dy) + dz * dz;
    }
    for (int i = 0; i < LEAF_SIZE; ++i) {
      const std::int32_t place = numbers[l] * LEAF_SIZE + i;
      squared_distances[found] = squared[i];
      places[found] = place;
      found += static_cast<int> (squared[i] <= limit && place != self);
    }
  }
  return found;
}

/** \brief Counts for eight values at once, without branches: compilers make vectors of
 * that.
 * \param[in] isLess (i, j) whether value j comes before value i
 */
template <typename IsLess>
void
countLess (int count, const IsLess& isLess, std::int32_t* ranks)
{
  for (int first = 0; first < count; first += LEAF_SIZE) {
    std::int32_t less[LEAF_SIZE] = {};
    for (int j = 0; j < count; ++j)
      for (int i = 0; i < LEAF_SIZE; ++i)
        less[i] += static_cast<std::int32_t> (isLess (first + i, j));
    std::copy (less, less + LEAF_SIZE, ranks + first);
  }
}

bool
rankDistinct (float* values, int count, std::int32_t* ranks)
{
  std::fill_n (values + count, LEAF_SIZE, std::numeric_limits<float>::infinity());
  countLess (
      count, [values] (int i, int j) { return values[j] < values[i]; }, ranks);
  std::int64_t sum = 0;
  for (int i = 0; i < count; ++i)
    sum += ranks[i];
  // Equal values share the lowest of their ranks, which makes the sum smaller.
  return sum == static_cast<std::int64_t> (count) * (count - 1) / 2;
}

void
rankTied (const float* values,
          const std::int32_t* indices,
          int count,
          std::int32_t* ranks)
{
  const auto isLess = [values, indices] (int i, int j) {
    const auto nearer = static_cast<unsigned> (values[j] < values[i]);
    const auto equal = static_cast<unsigned> (values[j] == values[i]);
    return nearer | (equal & static_cast<unsigned> (indices[j] < indices[i]));
  };
  countLess (count, isLess, ranks);
}

} // namespace

const Kernels&
portableKernels ()
{
  static constexpr Kernels KERNELS{boxesWithin, pointsWithin, rankDistinct, rankTied};
  return KERNELS;
}

} // namespace crest
} // namespace pcl
