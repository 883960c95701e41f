// SPDX-License-Identifier: BSD-3-Clause
// The kernels for x86-64. Each function has the instructions that it needs by an
// attribute: flags for a whole file would reach the inline functions of its headers,
// which the linker may then take for everywhere.
#include "search/kernels.h"

#if defined(__x86_64__) && defined(__GNUC__)

#include <immintrin.h>

#include <algorithm>
#include <array>
#include <limits>

namespace pcl {
namespace crest {

namespace {

constexpr float FAR_AWAY = std::numeric_limits<float>::infinity();

bool
allDistinct (std::int64_t sum_of_ranks, int count)
{
  // Equal values share the lowest of their ranks, which makes the sum smaller.
  return sum_of_ranks == static_cast<std::int64_t> (count) * (count - 1) / 2;
}

namespace sse2 {

constexpr int LANES = 4;

unsigned
boxesWithin (const BoxGroup& group,
             const Box& box,
             float limit,
             float* squared_distances)
{
  unsigned within = 0;
  for (int i = 0; i < LEAF_SIZE; i += LANES) {
    __m128 squares[3];
    for (int axis = 0; axis < 3; ++axis) {
      const __m128 above =
          _mm_sub_ps (_mm_load_ps (group.low[axis] + i), _mm_set1_ps (box.high[axis]));
      const __m128 below =
          _mm_sub_ps (_mm_set1_ps (box.low[axis]), _mm_load_ps (group.high[axis] + i));
      const __m128 gap = _mm_max_ps (_mm_max_ps (above, below), _mm_setzero_ps());
      squares[axis] = _mm_mul_ps (gap, gap);
    }
    const __m128 squared = _mm_add_ps (_mm_add_ps (squares[0], squares[1]), squares[2]);
    _mm_storeu_ps (squared_distances + i, squared);
    within |= static_cast<unsigned> (
                  _mm_movemask_ps (_mm_cmple_ps (squared, _mm_set1_ps (limit))))
              << i;
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
  const __m128 x = _mm_set1_ps (point[0]);
  const __m128 y = _mm_set1_ps (point[1]);
  const __m128 z = _mm_set1_ps (point[2]);
  const __m128 most = _mm_set1_ps (limit);
  int found = 0;
  const bool own = count > 0 && numbers[0] == self / LEAF_SIZE;
  unsigned wanted = own ? ~(1U << self % LEAF_SIZE) : ~0U;
  for (int l = 0; l < count; ++l) {
    const PointLeaf& leaf = leaves[numbers[l]];
    for (int i = 0; i < LEAF_SIZE; i += LANES) {
      const __m128 dx = _mm_sub_ps (_mm_load_ps (leaf.x + i), x);
      const __m128 dy = _mm_sub_ps (_mm_load_ps (leaf.y + i), y);
      const __m128 dz = _mm_sub_ps (_mm_load_ps (leaf.z + i), z);
      const __m128 squared = _mm_add_ps (
          _mm_add_ps (_mm_mul_ps (dx, dx), _mm_mul_ps (dy, dy)), _mm_mul_ps (dz, dz));
      const unsigned within =
          static_cast<unsigned> (_mm_movemask_ps (_mm_cmple_ps (squared, most))) &
          wanted >> i;
      if (within == 0)
        continue;
      float values[LANES];
      _mm_storeu_ps (values, squared);
      const std::int32_t place = numbers[l] * LEAF_SIZE + i;
      for (int lane = 0; lane < LANES; ++lane) {
        squared_distances[found] = values[lane];
        places[found] = place + lane;
        found += static_cast<int> (within >> lane & 1U);
      }
    }
    wanted = ~0U;
  }
  return found;
}

bool
rankDistinct (float* values, int count, std::int32_t* ranks)
{
  const int padded = (count + 2 * LANES - 1) / (2 * LANES) * (2 * LANES);
  std::fill (values + count, values + padded, FAR_AWAY);
  for (int i = 0; i < padded; i += 2 * LANES) {
    const __m128 a = _mm_loadu_ps (values + i);
    const __m128 b = _mm_loadu_ps (values + i + LANES);
    __m128i less_a = _mm_setzero_si128();
    __m128i less_b = _mm_setzero_si128();
    for (int j = 0; j < count; ++j) {
      const __m128 other = _mm_set1_ps (values[j]);
      less_a = _mm_sub_epi32 (less_a, _mm_castps_si128 (_mm_cmplt_ps (other, a)));
      less_b = _mm_sub_epi32 (less_b, _mm_castps_si128 (_mm_cmplt_ps (other, b)));
    }
    _mm_storeu_si128 (reinterpret_cast<__m128i*> (ranks + i), less_a);
    _mm_storeu_si128 (reinterpret_cast<__m128i*> (ranks + i + LANES), less_b);
  }
  std::int64_t sum = 0;
  for (int i = 0; i < count; ++i)
    sum += ranks[i];
  return allDistinct (sum, count);
}

void
rankTied (const float* values,
          const std::int32_t* indices,
          int count,
          std::int32_t* ranks)
{
  for (int i = 0; i < count; i += LANES) {
    const __m128 value = _mm_loadu_ps (values + i);
    const __m128i index =
        _mm_loadu_si128 (reinterpret_cast<const __m128i*> (indices + i));
    __m128i less = _mm_setzero_si128();
    for (int j = 0; j < count; ++j) {
      const __m128 other = _mm_set1_ps (values[j]);
      const __m128i first = _mm_cmplt_epi32 (_mm_set1_epi32 (indices[j]), index);
      const __m128i nearer = _mm_castps_si128 (_mm_cmplt_ps (other, value));
      const __m128i equal = _mm_castps_si128 (_mm_cmpeq_ps (other, value));
      less = _mm_sub_epi32 (less, _mm_or_si128 (nearer, _mm_and_si128 (equal, first)));
    }
    _mm_storeu_si128 (reinterpret_cast<__m128i*> (ranks + i), less);
  }
}

} // namespace sse2

namespace avx2 {

constexpr int LANES = LEAF_SIZE;

/** \brief For each set of lanes their numbers, those in the set first. */
constexpr std::array<std::array<std::uint8_t, LANES>, 1 << LANES>
packedLanes ()
{
  std::array<std::array<std::uint8_t, LANES>, 1 << LANES> table{};
  for (unsigned set = 0; set < table.size(); ++set) {
    unsigned next = 0;
    for (std::uint8_t lane = 0; lane < LANES; ++lane)
      if ((set >> lane & 1U) != 0)
        table[set][next++] = lane;
  }
  return table;
}

alignas (64) constexpr auto PACKED_LANES = packedLanes();

__attribute__ ((target ("avx2"))) unsigned
boxesWithin (const BoxGroup& group,
             const Box& box,
             float limit,
             float* squared_distances)
{
  __m256 squares[3];
  for (int axis = 0; axis < 3; ++axis) {
    const __m256 above = _mm256_sub_ps (_mm256_load_ps (group.low[axis]),
                                        _mm256_set1_ps (box.high[axis]));
    const __m256 below = _mm256_sub_ps (_mm256_set1_ps (box.low[axis]),
                                        _mm256_load_ps (group.high[axis]));
    const __m256 gap =
        _mm256_max_ps (_mm256_max_ps (above, below), _mm256_setzero_ps());
    squares[axis] = _mm256_mul_ps (gap, gap);
  }
  const __m256 squared =
      _mm256_add_ps (_mm256_add_ps (squares[0], squares[1]), squares[2]);
  _mm256_storeu_ps (squared_distances, squared);
  return static_cast<unsigned> (
      _mm256_movemask_ps (_mm256_cmp_ps (squared, _mm256_set1_ps (limit), _CMP_LE_OQ)));
}

__attribute__ ((target ("avx2,popcnt"))) int
pointsWithin (const PointLeaf* leaves,
              const std::int32_t* numbers,
              int count,
              const float* point,
              std::int32_t self,
              float limit,
              float* squared_distances,
              std::int32_t* places)
{
  const __m256 x = _mm256_set1_ps (point[0]);
  const __m256 y = _mm256_set1_ps (point[1]);
  const __m256 z = _mm256_set1_ps (point[2]);
  const __m256 most = _mm256_set1_ps (limit);
  int found = 0;
  const bool own = count > 0 && numbers[0] == self / LEAF_SIZE;
  unsigned wanted = own ? ~(1U << self % LEAF_SIZE) : ~0U;
  for (int l = 0; l < count; ++l) {
    const PointLeaf& leaf = leaves[numbers[l]];
    const __m256 dx = _mm256_sub_ps (_mm256_load_ps (leaf.x), x);
    const __m256 dy = _mm256_sub_ps (_mm256_load_ps (leaf.y), y);
    const __m256 dz = _mm256_sub_ps (_mm256_load_ps (leaf.z), z);
    const __m256 squared =
        _mm256_add_ps (_mm256_add_ps (_mm256_mul_ps (dx, dx), _mm256_mul_ps (dy, dy)),
                       _mm256_mul_ps (dz, dz));
    const unsigned within = static_cast<unsigned> (_mm256_movemask_ps (
                                _mm256_cmp_ps (squared, most, _CMP_LE_OQ))) &
                            wanted;
    wanted = ~0U;
    const __m256i lanes = _mm256_cvtepu8_epi32 (_mm_loadl_epi64 (
        reinterpret_cast<const __m128i*> (PACKED_LANES[within].data())));
    _mm256_storeu_ps (squared_distances + found,
                      _mm256_permutevar8x32_ps (squared, lanes));
    _mm256_storeu_si256 (
        reinterpret_cast<__m256i*> (places + found),
        _mm256_add_epi32 (lanes, _mm256_set1_epi32 (numbers[l] * LEAF_SIZE)));
    found += __builtin_popcount (within);
  }
  return found;
}

__attribute__ ((target ("avx2"))) bool
rankDistinct (float* values, int count, std::int32_t* ranks)
{
  const int padded = (count + 2 * LANES - 1) / (2 * LANES) * (2 * LANES);
  std::fill (values + count, values + padded, FAR_AWAY);
  for (int i = 0; i < padded; i += 2 * LANES) {
    const __m256 a = _mm256_loadu_ps (values + i);
    const __m256 b = _mm256_loadu_ps (values + i + LANES);
    __m256i less_a = _mm256_setzero_si256();
    __m256i less_b = _mm256_setzero_si256();
    for (int j = 0; j < count; ++j) {
      const __m256 other = _mm256_broadcast_ss (values + j);
      less_a = _mm256_sub_epi32 (
          less_a, _mm256_castps_si256 (_mm256_cmp_ps (other, a, _CMP_LT_OQ)));
      less_b = _mm256_sub_epi32 (
          less_b, _mm256_castps_si256 (_mm256_cmp_ps (other, b, _CMP_LT_OQ)));
    }
    _mm256_storeu_si256 (reinterpret_cast<__m256i*> (ranks + i), less_a);
    _mm256_storeu_si256 (reinterpret_cast<__m256i*> (ranks + i + LANES), less_b);
  }
  std::int64_t sum = 0;
  for (int i = 0; i < count; ++i)
    sum += ranks[i];
  return allDistinct (sum, count);
}

__attribute__ ((target ("avx2"))) void
rankTied (const float* values,
          const std::int32_t* indices,
          int count,
          std::int32_t* ranks)
{
  for (int i = 0; i < count; i += LANES) {
    const __m256 value = _mm256_loadu_ps (values + i);
    const __m256i index =
        _mm256_loadu_si256 (reinterpret_cast<const __m256i*> (indices + i));
    __m256i less = _mm256_setzero_si256();
    for (int j = 0; j < count; ++j) {
      const __m256 other = _mm256_broadcast_ss (values + j);
      const __m256i first = _mm256_cmpgt_epi32 (index, _mm256_set1_epi32 (indices[j]));
      const __m256i nearer =
          _mm256_castps_si256 (_mm256_cmp_ps (other, value, _CMP_LT_OQ));
      const __m256i equal =
          _mm256_castps_si256 (_mm256_cmp_ps (other, value, _CMP_EQ_OQ));
      less = _mm256_sub_epi32 (
          less, _mm256_or_si256 (nearer, _mm256_and_si256 (equal, first)));
    }
    _mm256_storeu_si256 (reinterpret_cast<__m256i*> (ranks + i), less);
  }
}

} // namespace avx2

} // namespace

const Kernels*
sse2Kernels ()
{
  static constexpr Kernels KERNELS{
      sse2::boxesWithin, sse2::pointsWithin, sse2::rankDistinct, sse2::rankTied};
  return &KERNELS;
}

const Kernels*
avx2Kernels ()
{
  static constexpr Kernels KERNELS{
      avx2::boxesWithin, avx2::pointsWithin, avx2::rankDistinct, avx2::rankTied};
  static const bool available =
      __builtin_cpu_supports ("avx2") != 0 && __builtin_cpu_supports ("popcnt") != 0;
  return available ? &KERNELS : nullptr;
}

} // namespace crest
} // namespace pcl

#else

namespace pcl {
namespace crest {

const Kernels*
sse2Kernels ()
{
  return nullptr;
}

const Kernels*
avx2Kernels ()
{
  return nullptr;
}

} // namespace crest
} // namespace pcl

#endif
