// SPDX-License-Identifier: BSD-3-Clause
// More surfaces with exact crest lines, for what the simple ones do not have: closed
// lines over an open surface, junctions, gentle, close, and uneven lines.
#pragma once

#include "analytic_surface.h"

namespace oracle {

/** \brief A ring-shaped ridge over a plane: three closed lines. */
AnalyticSurface
ringRidge ();
/** \brief Two trains of waves of a low amplitude, that cross. */
AnalyticSurface
gentleWaves ();
/** \brief A trefoil knot with an elliptic section: two closed ridges, and on the
 * inside of its bends valleys.
 */
AnalyticSurface
ellipticKnot ();
/** \brief Two ridges that cross and one that ends at another. */
AnalyticSurface
crossingRidges ();
/** \brief Four narrow ridges, each about 6 to 8 spacings from the next if there are
 * 20 000 samples.
 */
AnalyticSurface
parallelRidges ();
/** \brief A ridge that becomes lower along its way, and one that becomes wider. */
AnalyticSurface
unevenRidges ();
/** \brief |x|^4 + |y/.8|^4 + |z/.6|^4 = 1. */
AnalyticSurface
superellipsoid ();

/** \brief A spiral ridge of two turns on a shallow dome with a hole; its top has a
 * radius of about a spacing if there are 20 000 samples.
 */
AnalyticSurface
spiralRidge ();

} // namespace oracle
