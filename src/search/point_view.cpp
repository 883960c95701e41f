// SPDX-License-Identifier: BSD-3-Clause
#include "search/point_view.h"

#include "base/parallel.h"

#include <array>
#include <cstring>
#include <stdexcept>
#include <string>
#include <vector>

namespace pcl {
namespace crest {

void
checkPoints (const PointView& cloud)
{
  if (cloud.size > MOST_POINTS)
    throw std::invalid_argument (
        "A cloud of " + std::to_string (cloud.size) +
        " points is too large for 32-bit indices, which tell " +
        std::to_string (MOST_POINTS) +
        " points apart: compute it in parts that overlap");
  if (cloud.size > 0 && cloud.position == nullptr)
    throw std::invalid_argument (
        "The cloud has no positions: point to three floats of each");
  if (cloud.size > 1 && cloud.stride < 3)
    throw std::invalid_argument ("The stride of the cloud is " +
                                 std::to_string (cloud.stride) +
                                 ", but must be at least 3 floats");
  if (cloud.size > 1 && cloud.normal != nullptr && cloud.normal_stride != 0 &&
      cloud.normal_stride < 3)
    throw std::invalid_argument ("The stride of the normals is " +
                                 std::to_string (cloud.normal_stride) +
                                 ", but must be at least 3 floats");
}

std::uint64_t
fingerprint (const PointView& cloud, const Workers& workers)
{
  // The steps of FNV-1a (Fowler, Noll and Vo), over words in the place of bytes.
  constexpr std::uint64_t PRIME = 0x100000001b3ULL;
  constexpr std::uint64_t OFFSET = 0xcbf29ce484222325ULL;
  const auto add = [] (std::uint64_t& hash, const Eigen::Vector3f& three) {
    std::array<std::uint32_t, 3> bits{};
    std::memcpy (bits.data(), three.data(), sizeof (bits));
    hash = (hash ^ (bits[0] | static_cast<std::uint64_t> (bits[1]) << 32)) * PRIME;
    hash = (hash ^ hash >> 29 ^ bits[2]) * PRIME;
  };
  std::vector<std::uint64_t> of_blocks (blockCount (cloud.size), OFFSET);
  forEachBlock (cloud.size,
                workers,
                [&] (std::size_t block, std::size_t first, std::size_t last) {
                  for (std::size_t i = first; i < last; ++i) {
                    add (of_blocks[block], cloud.positionOf (i));
                    if (cloud.normal != nullptr)
                      add (of_blocks[block], cloud.normalOf (i));
                  }
                });
  std::uint64_t hash = OFFSET ^ cloud.size;
  for (const std::uint64_t of_block : of_blocks)
    hash = (hash ^ hash >> 29 ^ of_block) * PRIME;
  return hash;
}

} // namespace crest
} // namespace pcl
