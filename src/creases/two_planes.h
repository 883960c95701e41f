// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/scatter.h"

#include <array>
#include <vector>

namespace pcl {
namespace crest {

/** \brief The two faces of an edge: planes fitted by total least squares (Pearson 1901)
 * to the points of either, alternating with the choice of the face of each point. One
 * object serves one set of points after the other.
 */
class TwoPlanes {
public:
  /** \brief Divides points across the axis along which their normals differ most.
   * Returns false if they hardly differ.
   * \param[in] normals of the points
   * \param[in] count of these the first that are meant
   * \param[in] scatter that of their normals
   */
  bool
  split (const Coordinates& normals, std::size_t count, const Scatter& scatter);

  /** \brief Fits the planes to their parts and the parts to the planes, in turn.
   * Returns false if a part is too small, or no plane.
   * \param[in] positions of the points that were divided
   * \param[in] count of these the first that are meant
   * \param[in] scatter that of their positions
   * \param[in] largest residual of both planes to go on with after the first round
   */
  bool
  fit (const Coordinates& positions,
       std::size_t count,
       const Scatter& scatter,
       double largest);

  const Plane&
  operator[] (std::size_t i) const
  {
    return planes_[i];
  }

  /** \brief Whether the solid is behind both planes, and not behind either. */
  [[nodiscard]] bool
  convex () const
  {
    return convex_;
  }

  /** \brief The sum of the squared distances of the points from their planes. */
  [[nodiscard]] double
  squaredDistances (const Coordinates& positions, std::size_t count) const;

private:
  /** \brief Gives each point to the plane whose side it is on; returns whether that
   * changes any.
   */
  bool
  takeSides (const Coordinates& positions, std::size_t count);

  std::array<Plane, 2> planes_;
  bool convex_ = true;
  /** of each point: 1 for the first plane, -1 for the second */
  std::vector<double> side_;
};

} // namespace crest
} // namespace pcl
