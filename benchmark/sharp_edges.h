// SPDX-License-Identifier: BSD-3-Clause
// Meshes and solids with sharp edges, and how near lines come to these.
#pragma once

#include "timed_run.h"
#include "type_score.h"

namespace accuracy {

/** \brief A piece of a sharp edge; a ridge where convex, a valley where concave. */
struct SharpEdge {
  Eigen::Vector3d a, b;
  pcl::crest::CrestType type;
  /** between the normals of its two faces, in degrees */
  double angle;
};

struct SharpObject {
  std::string name;
  /** with exact normals */
  pcl::PointCloud<pcl::PointNormal>::Ptr cloud;
  std::vector<SharpEdge> edges;
};

/** \brief Where at least three edges of more than 25 degrees, the least turning angle
 * of lines by default, have an end in common.
 */
std::vector<Eigen::Vector3d>
cornersOf (const std::vector<SharpEdge>& edges);

struct SharpScore {
  std::string name;
  double noise;
  std::string preset;
  std::size_t points;
  double milliseconds;
  /** types together, ridges, valleys; all edges count as salient */
  std::vector<TypeScore> types;
  /** how many corners there are, and at how many lines meet: a junction within the
   * tolerance, or ends of two polylines of any type in the same place
   */
  std::size_t corners, joined;
};

/** \brief What is within this many h of a sharp edge is on it. */
constexpr double SHARP_TOLERANCE = 2.0;

/** \brief Fills in what can be told without the names. */
SharpScore
scoreSharp (const TimedRun& run, const std::vector<SharpEdge>& edges, double spacing);

} // namespace accuracy
