// SPDX-License-Identifier: BSD-3-Clause
// Where sharp edges fade into smooth crests, for the auto preset.
#pragma once

#include "creases/crease_lines.h"

namespace pcl {
namespace crest {

/** \brief Edges that may go on from the free ends of sharp lines: to the smooth crest
 * points within three spacings and 60 degrees ahead of them.
 *
 * \param[in] points where lines run
 * \param[in] graph of the samples
 * \param[in] sharp the edges of the sharp lines of one type
 * \param[in] membership of the smooth crests of the same type
 */
std::vector<CrestEdge>
linksFromSharpEnds (const OrientedPoints& points,
                    const SurfaceGraph& graph,
                    const std::vector<CrestEdge>& sharp,
                    const std::vector<Membership>& membership);

} // namespace crest
} // namespace pcl
