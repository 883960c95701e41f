// SPDX-License-Identifier: BSD-3-Clause
// An order of points that depends on where they are alone.
#pragma once

#include <pcl_crest/types.h>

#include <Eigen/Core>

#include "base/progress.h"

#include <cstdint>
#include <vector>

namespace pcl {
namespace crest {

/** \brief A point of a cloud on its way into order. */
struct CurvePoint {
  std::uint64_t code;
  Eigen::Vector3f position;
  index_t cloud_index;
};

/** \brief How large the sorted points are. */
struct CurveBox {
  Eigen::Vector3f low;
  Eigen::Vector3f high;

  /** \brief Largest side. */
  double
  extent () const
  {
    return (high.cast<double>() - low.cast<double>()).maxCoeff();
  }
};

/** \brief Sorts points along a Morton curve through their bounding box, coincident ones
 * next to each other by their index. Neighbours are close in it, and ties that later
 * stages break by it do not depend on the order of the cloud.
 * \param[in,out] points finite; their codes are set
 */
CurveBox
sortAlongCurve (std::vector<CurvePoint>& points, const Workers& workers);

/** \brief Where the sorted points of each place begin, and the end of all. */
std::vector<std::size_t>
beginsOfPlaces (const std::vector<CurvePoint>& points);

} // namespace crest
} // namespace pcl
