// SPDX-License-Identifier: BSD-3-Clause
#include "surface/oriented_points.h"

#include "base/large_arrays.h"
#include "base/parallel.h"
#include "search/curve_order.h"
#include "search/point_tree.h"
#include "search/point_view.h"

#include <algorithm>
#include <map>
#include <tuple>

namespace pcl {
namespace crest {

namespace {

/** \brief Whether a point is finite and, if the cloud has normals, has one. */
bool
isValid (const PointView& cloud, std::size_t i)
{
  if (!cloud.positionOf (i).allFinite())
    return false;
  return cloud.normal == nullptr || isUsable (cloud.normalOf (i));
}

/** \brief The valid points along a Morton curve.
 * \param[out] points get extent and unit
 */
std::vector<CurvePoint>
sortedSamples (const PointView& cloud, const Workers& workers, OrientedPoints& points)
{
  std::vector<CurvePoint> samples;
  reserveLarge (samples, cloud.size);
  for (std::size_t i = 0; i < cloud.size; ++i)
    if (isValid (cloud, i))
      samples.push_back ({0, cloud.positionOf (i), static_cast<index_t> (i)});
  if (samples.empty())
    return samples;
  const CurveBox box = sortAlongCurve (samples, workers);
  points.extent = box.extent();
  points.unit = unitFor (points.extent,
                         box.low.cwiseAbs().cwiseMax (box.high.cwiseAbs()).maxCoeff());
  return samples;
}

/** \brief The mean of the normals of coincident samples, of unit length, or zero if
 * they cancel out.
 */
Eigen::Vector3f
meanNormal (const PointView& cloud, const CurvePoint* first, const CurvePoint* last)
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

/** \brief Whether most of what was gathered was for noise that neighbours share. */
bool
shareNoise (const SamplingFindings& findings)
{
  const auto windows = [&findings] (SamplingFlaw flaw) {
    return findings.flaws[static_cast<std::size_t> (flaw)];
  };
  return windows (SamplingFlaw::DEPTH_STEPS) +
             windows (SamplingFlaw::CORRELATED_NOISE) >
         windows (SamplingFlaw::CLUMPS) + windows (SamplingFlaw::TWO_SCANS);
}

} // namespace

OrientedPoints
packOrientedPoints (const PointView& cloud, const Workers& workers)
{
  OrientedPoints points;
  points.packed_index = makeLarge<index_t> (cloud.size, OrientedPoints::INVALID);
  const std::vector<CurvePoint> samples = sortedSamples (cloud, workers, points);
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

OrientedPoints
packNodes (const PointView& cloud, const SampleNodes& nodes, const Workers& workers)
{
  const std::size_t size = nodes.positions.size();
  // In whole numbers, so that the sum does not depend on the order of the cloud.
  constexpr double ONE = 1U << 30U;
  using Sum = Eigen::Matrix<std::int64_t, 3, 1>;
  std::vector<Sum> sums (size, Sum::Zero());
  std::vector<index_t> nearest (size, OrientedPoints::INVALID);
  const auto rank = [&cloud, &nodes] (index_t i) {
    const Eigen::Vector3f place = cloud.positionOf (static_cast<std::size_t> (i));
    const Eigen::Vector3f& node = nodes.positions[nodes.node_of[i]];
    return std::make_tuple (
        (place - node).stableNorm(), place.x(), place.y(), place.z());
  };
  for (std::size_t i = 0; i < cloud.size; ++i) {
    if (!isValid (cloud, i))
      continue;
    const index_t node = nodes.node_of[i];
    const auto point = static_cast<index_t> (i);
    sums[node] +=
        (ONE * unitNormalOf (cloud, i)).array().round().matrix().cast<std::int64_t>();
    if (nearest[node] == OrientedPoints::INVALID || rank (point) < rank (nearest[node]))
      nearest[node] = point;
  }
  // Where the sheets of a thin part fell into one node, it is on one of them.
  constexpr double CANCELLED = 1e-6 * ONE;
  std::vector<Eigen::Vector3f> normals (size, Eigen::Vector3f::Zero());
  for (std::size_t node = 0; node < size; ++node)
    if (nearest[node] != OrientedPoints::INVALID) {
      const Eigen::Vector3d sum = sums[node].cast<double>();
      const Eigen::Vector3d normal =
          sum.norm() > CANCELLED
              ? sum.normalized()
              : unitNormalOf (cloud, static_cast<std::size_t> (nearest[node]));
      normals[node] = normal.cast<float>();
    }

  PointView view = nodes.view();
  view.normal = normals.front().data();
  OrientedPoints points = packOrientedPoints (view, workers);
  for (index_t& point : points.cloud_index)
    point = nearest[point];
  std::vector<index_t> packed_index =
      makeLarge<index_t> (cloud.size, OrientedPoints::INVALID);
  for (std::size_t i = 0; i < cloud.size; ++i)
    if (isValid (cloud, i))
      packed_index[i] = points.packed_index[nodes.node_of[i]];
  points.packed_index = std::move (packed_index);
  points.gathered = true;
  points.share_noise = shareNoise (nodes.findings);
  return points;
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
