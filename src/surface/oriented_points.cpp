// SPDX-License-Identifier: BSD-3-Clause
#include "surface/oriented_points.h"

#include "base/large_arrays.h"
#include "base/parallel.h"
#include "base/radix_sort.h"
#include "search/point_tree.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <map>
#include <tuple>

namespace pcl {
namespace crest {

namespace {

/** \brief Spreads the lowest 21 bits to every third bit. */
std::uint64_t
spreadBits (std::uint64_t v)
{
  v &= 0x1fffffULL;
  v = (v | v << 32) & 0x001f00000000ffffULL;
  v = (v | v << 16) & 0x001f0000ff0000ffULL;
  v = (v | v << 8) & 0x100f00f00f00f00fULL;
  v = (v | v << 4) & 0x10c30c30c30c30c3ULL;
  v = (v | v << 2) & 0x1249249249249249ULL;
  return v;
}

std::uint64_t
mortonCode (const Eigen::Vector3f& p, const Eigen::Vector3f& low, double cells_per_unit)
{
  const Eigen::Vector3d cell = (p.cast<double>() - low.cast<double>()) * cells_per_unit;
  return spreadBits (static_cast<std::uint64_t> (cell.x())) |
         spreadBits (static_cast<std::uint64_t> (cell.y())) << 1 |
         spreadBits (static_cast<std::uint64_t> (cell.z())) << 2;
}

struct CodedPoint {
  std::uint64_t code;
  Eigen::Vector3f position;
  index_t cloud_index;
};

void
sortAlongCurve (std::vector<CodedPoint>& samples)
{
  radixSort (
      samples.data(),
      samples.data() + samples.size(),
      [] (const CodedPoint& p) { return p.code; },
      [] (const CodedPoint& p, const CodedPoint& q) {
        return std::make_tuple (
                   p.position.x(), p.position.y(), p.position.z(), p.cloud_index) <
               std::make_tuple (
                   q.position.x(), q.position.y(), q.position.z(), q.cloud_index);
      });
}

Eigen::Vector3d
unitNormalOf (const PointView& cloud, std::size_t i)
{
  return cloud.normalOf (i).cast<double>().stableNormalized();
}

bool
isValid (const PointView& cloud, std::size_t i)
{
  const Eigen::Vector3f normal = cloud.normalOf (i);
  return cloud.positionOf (i).allFinite() && normal.allFinite() &&
         normal.cwiseAbs().maxCoeff() > 0.0F;
}

/** \brief The valid points in Morton order, coincident ones next to each other.
 * \param[out] points get extent and unit
 */
std::vector<CodedPoint>
sortedSamples (const PointView& cloud, const Workers& workers, OrientedPoints& points)
{
  std::vector<CodedPoint> samples;
  reserveLarge (samples, cloud.size);
  Eigen::Vector3f low =
      Eigen::Vector3f::Constant (std::numeric_limits<float>::infinity());
  Eigen::Vector3f high = -low;
  for (std::size_t i = 0; i < cloud.size; ++i)
    if (isValid (cloud, i)) {
      const Eigen::Vector3f p = cloud.positionOf (i);
      low = low.cwiseMin (p);
      high = high.cwiseMax (p);
      samples.push_back ({0, p, static_cast<index_t> (i)});
    }
  if (samples.empty())
    return samples;

  const double extent = (high.cast<double>() - low.cast<double>()).maxCoeff();
  points.extent = extent;
  points.unit = unitFor (extent, low.cwiseAbs().cwiseMax (high.cwiseAbs()).maxCoeff());
  constexpr double CELLS = (1 << 21) - 1;
  if (extent > 0.0)
    forEachBlock (samples.size(),
                  workers,
                  [&] (std::size_t, std::size_t first, std::size_t last) {
                    for (std::size_t i = first; i < last; ++i)
                      samples[i].code =
                          mortonCode (samples[i].position, low, CELLS / extent);
                  });
  sortAlongCurve (samples);
  return samples;
}

/** \brief Where the samples of each place begin, and the end of all. */
std::vector<std::size_t>
beginsOfPlaces (const std::vector<CodedPoint>& samples)
{
  std::vector<std::size_t> begins;
  reserveLarge (begins, samples.size() + 1);
  for (std::size_t i = 0; i < samples.size(); ++i)
    if (i == 0 || samples[i].position != samples[i - 1].position)
      begins.push_back (i);
  begins.push_back (samples.size());
  return begins;
}

/** \brief The mean of the normals of coincident samples, of unit length, or zero if
 * they cancel out.
 */
Eigen::Vector3f
meanNormal (const PointView& cloud, const CodedPoint* first, const CodedPoint* last)
{
  if (last - first == 1)
    return unitNormalOf (cloud, first->cloud_index).cast<float>();
  std::vector<Eigen::Vector3d> normals;
  for (; first < last; ++first)
    normals.push_back (unitNormalOf (cloud, first->cloud_index));
  // The sum, too, must not depend on the order of the cloud.
  std::sort (normals.begin(),
             normals.end(),
             [] (const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
               return std::lexicographical_compare (
                   a.begin(), a.end(), b.begin(), b.end());
             });
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& normal : normals)
    sum += normal;
  constexpr double CANCELLED = 1e-6;
  if (sum.norm() < CANCELLED)
    return Eigen::Vector3f::Zero();
  return sum.normalized().cast<float>();
}

} // namespace

OrientedPoints
packOrientedPoints (const PointView& cloud, const Workers& workers)
{
  OrientedPoints points;
  points.packed_index = makeLarge<index_t> (cloud.size, OrientedPoints::INVALID);
  const std::vector<CodedPoint> samples = sortedSamples (cloud, workers, points);
  const std::vector<std::size_t> begins = beginsOfPlaces (samples);
  const std::size_t places = begins.size() - 1;
  points.normals = makeLarge<Eigen::Vector3f> (places, Eigen::Vector3f::Zero());
  forEachBlock (
      places, workers, [&] (std::size_t, std::size_t first, std::size_t last) {
        for (std::size_t place = first; place < last; ++place)
          points.normals[place] = meanNormal (cloud,
                                              samples.data() + begins[place],
                                              samples.data() + begins[place + 1]);
      });

  reserveLarge (points.positions, places);
  reserveLarge (points.cloud_index, places);
  for (std::size_t place = 0; place < places; ++place) {
    if (points.normals[place].isZero (0.0F))
      continue;
    points.normals[points.size()] = points.normals[place];
    for (std::size_t i = begins[place]; i < begins[place + 1]; ++i)
      points.packed_index[samples[i].cloud_index] =
          static_cast<index_t> (points.size());
    points.positions.push_back (samples[begins[place]].position);
    points.cloud_index.push_back (samples[begins[place]].cloud_index);
  }
  points.normals.resize (points.size());
  return points;
}

std::uint64_t
fingerprint (const PointView& cloud, const Workers& workers)
{
  // The steps of FNV-1a (Fowler, Noll and Vo), over words in the place of bytes.
  constexpr std::uint64_t PRIME = 0x100000001b3ULL;
  constexpr std::uint64_t OFFSET = 0xcbf29ce484222325ULL;
  const auto add = [] (std::uint64_t& hash, const float* three) {
    std::array<std::uint32_t, 3> bits{};
    std::memcpy (bits.data(), three, sizeof (bits));
    hash = (hash ^ (bits[0] | static_cast<std::uint64_t> (bits[1]) << 32)) * PRIME;
    hash = (hash ^ hash >> 29 ^ bits[2]) * PRIME;
  };
  std::vector<std::uint64_t> of_blocks (blockCount (cloud.size), OFFSET);
  forEachBlock (cloud.size,
                workers,
                [&] (std::size_t block, std::size_t first, std::size_t last) {
                  for (std::size_t i = first; i < last; ++i) {
                    add (of_blocks[block], cloud.position + i * cloud.stride);
                    add (of_blocks[block], cloud.normal + i * cloud.stride);
                  }
                });
  std::uint64_t hash = OFFSET ^ cloud.size;
  for (const std::uint64_t of_block : of_blocks)
    hash = (hash ^ hash >> 29 ^ of_block) * PRIME;
  return hash;
}

index_t
locatePoints (const PointView& cloud,
              const std::vector<index_t>& indices,
              const PointView& surface,
              std::vector<index_t>& found)
{
  const auto key = [] (const Eigen::Vector3f& p) {
    return std::make_tuple (p.x(), p.y(), p.z());
  };
  std::map<std::tuple<float, float, float>, index_t> point_at;
  for (std::size_t i = 0; i < surface.size; ++i) {
    const Eigen::Vector3f position = surface.positionOf (i);
    if (!position.allFinite())
      continue;
    const auto point = static_cast<index_t> (i);
    index_t& there = point_at.emplace (key (position), point).first->second;
    // Of coincident points some may be invalid.
    if (!isValid (surface, static_cast<std::size_t> (there)))
      there = point;
  }
  found.assign (indices.size(), OrientedPoints::INVALID);
  for (std::size_t i = 0; i < indices.size(); ++i) {
    const Eigen::Vector3f position =
        cloud.positionOf (static_cast<std::size_t> (indices[i]));
    if (!position.allFinite())
      continue;
    const auto there = point_at.find (key (position));
    if (there == point_at.end())
      return indices[i];
    found[i] = there->second;
  }
  return OrientedPoints::INVALID;
}

} // namespace crest
} // namespace pcl
