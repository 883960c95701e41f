// SPDX-License-Identifier: BSD-3-Clause
// What profiles are at sharp edges, for the auto preset.
#pragma once

#include "creases/crease_lines.h"
#include "crests/crest_profile.h"

#include <memory>

namespace pcl {
namespace crest {

/** \brief Profiles of a surface with sharp lines: as profileCrests finds them on either
 * side, without looking across a line, and for the samples at lines themselves:
 *
 * - the nodes of lines get that of an edge of the line's angle, rounded off over two
 *   spacings, as no sampling can tell it from less: k1 = angle / (2 h), across the
 * edge. The strength of a sharp line thus is its angle times its length in double
 * spacings;
 * - others that are blocked get the curvature of the finest scale, but no crest;
 * - where a line of the same type runs the same way within .35 of a window's radius,
 *   there is no crest: wide windows see it round its ends, and blur it.
 *
 * \param[in] tree over the points
 */
std::vector<CrestProfile>
profileSharpCrests (const OrientedPoints& points,
                    const SurfaceGraph& graph,
                    const SharpLines& lines,
                    const std::shared_ptr<const PointTree>& tree,
                    const Workers& workers);

} // namespace crest
} // namespace pcl
