// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/scatter.h"

#include <array>
#include <vector>

namespace pcl {
namespace crest {

/** \brief Two planes that meet, whatever the signs of normals: where these contradict
 * each other across an edge, or where three sheets or more meet in it, as those of
 * solids that touch. Each point belongs to the plane that it is nearest to.
 */
class CrossingPlanes {
public:
  /** \brief Fits both planes. Returns false if the points do not lie on two sheets that
   * their normals are across, or neither ends where they meet.
   * \param[in] positions, normals of the points
   * \param[in] count of these the first that are meant
   * \param[in] products the sum of the products of their normals with themselves
   * \param[in] tolerance distance from a plane that is no side of it
   * \param[in] most_astray the part of normals that may look elsewhere than their plane
   */
  bool
  fit (const Coordinates& positions,
       const Coordinates& normals,
       std::size_t count,
       const Eigen::Matrix3d& products,
       double tolerance,
       double most_astray);

  /** \brief The planes, with the signs that most of their points' normals have; the
   * second is the one that ends at the first.
   */
  const Plane&
  operator[] (std::size_t i) const
  {
    return planes_[i];
  }

  /** \brief Whether the second plane is behind the first. */
  [[nodiscard]] bool
  convex () const
  {
    return convex_;
  }

  /** \brief The sum of the squared distances of the points from their planes. */
  [[nodiscard]] double
  squaredDistances () const
  {
    return planes_[0].residual + planes_[1].residual;
  }

private:
  std::array<Plane, 2> planes_;
  bool convex_ = true;
  /** of each point 1 for the first plane, -1 for the second */
  std::vector<double> side_;
};

} // namespace crest
} // namespace pcl
