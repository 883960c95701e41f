// SPDX-License-Identifier: BSD-3-Clause
// The input of the method (paper, section 4): points that know their normals.
#pragma once

#include <pcl_crest/input.h>
#include <pcl_crest/types.h>

#include <Eigen/Core>

#include "base/progress.h"
#include "sampling/sample_nodes.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl {
namespace crest {

/** \brief The points that the stages work on: finite, with unit normals, without
 * coincident points, in an order that depends on their positions alone.
 *
 * The order (along a Morton curve) makes every later tie break by index independent
 * of the order of the input, and keeps neighbours close in memory. Coincident points
 * are one sample of the surface: k neighbours at distance zero would tell nothing of
 * its shape. Such a sample has the mean of their normals, and is invalid where these
 * cancel out.
 */
struct OrientedPoints {
  static constexpr index_t INVALID = -1;

  std::vector<Eigen::Vector3f> positions;
  std::vector<Eigen::Vector3f> normals;
  /** the point of the cloud that each was made of (of coincident ones the first) */
  std::vector<index_t> cloud_index;
  /** for each point of the cloud its place here, or INVALID */
  std::vector<index_t> packed_index;
  /** largest side of the axis-aligned bounding box, in the cloud's unit */
  double extent = 0.0;
  /** a power of two to measure in where squares have to fit into floats (unitFor) */
  double unit = 1.0;
  /** whether they stand for samples that tell nothing one by one (packNodes) */
  bool gathered = false;
  /** whether the samples shared their noise with neighbours: points do, a little */
  bool share_noise = false;

  std::size_t
  size () const
  {
    return positions.size();
  }

  /** \brief The way from one point to another. In double precision it is exact, and
   * does not overflow where coordinates are near the largest float.
   */
  Eigen::Vector3d
  edge (index_t from, index_t to) const
  {
    return positions[to].cast<double>() - positions[from].cast<double>();
  }
};

/** \brief Packs the valid points of a cloud. Invalid are those whose position or
 * normal is not finite, or whose normal is zero.
 * \param[in] workers a number of threads, 0 for all processors
 */
PCL_CREST_EXPORT OrientedPoints
packOrientedPoints (const PointView& cloud, const Workers& workers = 1);

/** \brief Packs nodes in the place of the samples that were gathered to them. A node's
 * normal is the mean of its samples', and its point of the cloud the nearest of these;
 * every point of the cloud that is valid is packed as its node.
 * \param[in] cloud with normals
 * \param[in] nodes of it, not empty
 * \param[in] workers as above
 */
OrientedPoints
packNodes (const PointView& cloud, const SampleNodes& nodes, const Workers& workers);

} // namespace crest
} // namespace pcl
