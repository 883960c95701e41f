// SPDX-License-Identifier: BSD-3-Clause
#include "normals/normal_orientation.h"

#include "normals/normal_edges.h"
#include "normals/signed_sets.h"
#include "normals/single_view.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace pcl {
namespace crest {

namespace {

/** \brief What decides the side of a part; sums weighted by area. */
struct Part {
  double area = 0.0;
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  double volume = 0.0;
  double largest_volume = 0.0;
  double facing = 0.0;
};

bool
isClosed (const Part& part)
{
  // Net normals of a closed surface vanish; a quarter leaves room for scans with holes
  // and uneven sampling. A hemisphere has one half, a height field nearly one.
  constexpr double MOST_OPEN = 0.25;
  constexpr double LEAST_VOLUME = 0.01;
  return part.normal.norm() < MOST_OPEN * part.area &&
         std::abs (part.volume) > LEAST_VOLUME * part.largest_volume;
}

/** \brief Whether nearly all of a part shows the same side to the viewpoint. */
bool
showsOneSide (const Part& part)
{
  constexpr double CLEAR_VOTE = 0.5;
  return std::abs (part.facing) > CLEAR_VOTE * part.area;
}

/** \brief Whether a cloud is one closed surface around the viewpoint: rather a model
 * around its origin than what a sensor saw.
 */
bool
isModelAround (const std::vector<Part>& parts)
{
  const auto has_area = [] (const Part& part) { return part.area > 0.0; };
  const auto part = std::find_if (parts.begin(), parts.end(), has_area);
  return std::count_if (parts.begin(), parts.end(), has_area) == 1 &&
         isClosed (*part) && showsOneSide (*part);
}

/** \brief Whether a part has to be turned over as a whole. */
bool
decideSide (const Part& part, Orientation& orientation)
{
  if (isClosed (part)) {
    ++orientation.outward;
    return part.volume < 0.0;
  }
  if (showsOneSide (part)) {
    ++orientation.toward_viewpoint;
    return part.facing < 0.0;
  }
  ++orientation.upward;
  return part.normal.z() < 0.0;
}

} // namespace

Orientation
orientNormals (const std::vector<Eigen::Vector3f>& points,
               const std::optional<Eigen::Vector3f>& viewpoint,
               bool organized,
               const NearestMaker& nearest,
               unsigned threads,
               std::vector<Eigen::Vector3f>& normals)
{
  const NormalEdges graph (points, nearest);
  Orientation orientation;
  // An organized cloud is one image of a sensor, which sees no surface from behind.
  orientation.single_view = viewpoint.has_value() && organized;
  if (orientation.single_view) {
    faceViewpoint (points, graph, *viewpoint, threads, normals);
    return orientation;
  }
  std::vector<index_t> all (points.size());
  std::iota (all.begin(), all.end(), 0);
  std::vector<double> areas;
  SignedSets sets (points.size());
  for (const NormalEdge& edge : graph.find (normals, all, threads, areas))
    sets.unite (edge.a, edge.b, edge.opposite);

  std::vector<index_t> root (points.size());
  std::vector<Part> parts (points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const SignedSets::Place place = sets.find (static_cast<index_t> (i));
    root[i] = place.root;
    if (place.turned)
      normals[i] = -normals[i];
    if (normals[i].isZero (0.0F))
      continue;
    Part& part = parts[place.root];
    part.area += areas[i];
    part.center += areas[i] * points[i].cast<double>();
    part.normal += areas[i] * normals[i].cast<double>();
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    Part& part = parts[root[i]];
    if (normals[i].isZero (0.0F) || part.area == 0.0)
      continue;
    const Eigen::Vector3d position = points[i].cast<double>();
    const Eigen::Vector3d normal = areas[i] * normals[i].cast<double>();
    const Eigen::Vector3d arm = position - part.center / part.area;
    part.volume += normal.dot (arm);
    part.largest_volume += areas[i] * arm.norm();
    if (viewpoint)
      part.facing +=
          std::copysign (areas[i], normal.dot (viewpoint->cast<double>() - position));
  }
  orientation.single_view = viewpoint.has_value() && !isModelAround (parts) &&
                            isSeenFrom (points, areas, *viewpoint, threads);
  if (orientation.single_view) {
    faceViewpoint (points, graph, *viewpoint, threads, normals);
    return orientation;
  }
  std::vector<char> turn (points.size(), 0);
  for (std::size_t i = 0; i < points.size(); ++i)
    if (parts[i].area > 0.0)
      turn[i] = decideSide (parts[i], orientation) ? 1 : 0;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (turn[root[i]] != 0)
      normals[i] = -normals[i];
  return orientation;
}

} // namespace crest
} // namespace pcl
