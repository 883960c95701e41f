// SPDX-License-Identifier: BSD-3-Clause
// Points that are far from all others.
#pragma once

#include <pcl_crest/input.h>

#include <Eigen/Core>

#include <vector>

namespace pcl {
namespace crest {

/** \brief A cloud without its strays, points more than a thousand times the width of
 * the bulk away from it, as files set them apart. Floats of a unit that reaches one of
 * them do not tell the others apart, and of a surface all points that it faces are its
 * neighbours.
 *
 * The bulk is what nine tenths of the finite points have of each axis. Strays stay
 * where they are in the order, but are not a number.
 */
class NearPoints {
public:
  /** \param[in] cloud has to outlive this */
  explicit NearPoints (const PointView& cloud);

  const PointView&
  view () const
  {
    return view_;
  }

private:
  /** none where there are no strays */
  std::vector<Eigen::Vector3f> positions_;
  PointView view_;
};

} // namespace crest
} // namespace pcl
