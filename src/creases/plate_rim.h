// SPDX-License-Identifier: BSD-3-Clause
// The rim of a plate that is too thin for the edges on either side of it.
#pragma once

#include "base/scatter.h"

#include <optional>

namespace pcl {
namespace crest {

/** \brief The edge of one of the two sheets of a plate, where the plate ends; lengths
 * and the origin are those of the points.
 */
struct PlateRim {
  /** point of the edge nearest to the origin */
  Eigen::Vector3d foot;
  /** unit vectors: along the rim; in the middle of the sheet's normal and the way out
   * of the plate, which is across the normal */
  Eigen::Vector3d direction;
  Eigen::Vector3d normal;
  /** mean squared distance of the points from the sheets, and from one plane for both
   */
  double of_sheets;
  double of_one_plane;
};

/** \brief The edge of the sheet that a sample is part of, where that is one of the two
 * of a plate: back to back, 2.25 spacings apart at most, and both end within a spacing
 * of the sample, where nothing else goes on. The rim of such a plate has too few
 * samples for a plane of its own, so that no two planes show its edges.
 *
 * \param[in] positions, normals of the neighbours, from the sample, in spacings
 *
 * \param[in] own the normal of the sample
 *
 * \param[in] most mean squared distance of the points from their sheet
 */
std::optional<PlateRim>
fitPlateRim (const Coordinates& positions,
             const Coordinates& normals,
             const Eigen::Vector3d& own,
             double most);

} // namespace crest
} // namespace pcl
