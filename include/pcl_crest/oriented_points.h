// SPDX-License-Identifier: BSD-3-Clause
// The input of the method (paper, section 4): points that know their normals.
#pragma once

#include <pcl_crest/progress.h>
#include <pcl_crest/types.h>

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl {
namespace crest {

/** \brief Where a cloud keeps its positions and normals: three floats each, at
 * `position + i * stride` and `normal + i * stride`, strides in floats.
 */
struct PointView {
  const float* position;
  const float* normal;
  std::size_t stride;
  std::size_t size;
};

/** \brief Squared distances that differ by less than this part are equal. The equal
 * steps of a scanner or mesher are not quite equal in a file of six digits, nor in
 * floats, and less so after a change of unit: which is the shorter must not depend on
 * that.
 */
constexpr double EQUIDISTANT = 1e-3;

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
OrientedPoints
packOrientedPoints (const PointView& cloud, const Workers& workers = 1);

/** \brief A number that differs, for all that is likely, where a position or a normal
 * of two clouds does.
 * \param[in] workers as above
 */
std::uint64_t
fingerprint (const PointView& cloud, const Workers& workers = 1);

/** \brief Finds points of another cloud among those that a surface was packed from, by
 * their exact positions.
 * \param[in] cloud, indices the points to find
 * \param[in] surface, points a cloud and what packOrientedPoints made of it
 * \param[out] packed for each of the indices its packed point, or INVALID where it is
 * not finite or the surface has no valid point there
 *
 * \return the first of the indices whose finite position no point of the surface has,
 * or INVALID if there is none
 */
index_t
locatePoints (const PointView& cloud,
              const std::vector<index_t>& indices,
              const PointView& surface,
              const OrientedPoints& points,
              std::vector<index_t>& packed);

} // namespace crest
} // namespace pcl
