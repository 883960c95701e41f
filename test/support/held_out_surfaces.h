// SPDX-License-Identifier: BSD-3-Clause
// HELD OUT: nothing of the method, no constant and no threshold, may ever be chosen
// while looking at these. They tell what the figures of all others are worth.
#pragma once

#include "analytic_surface.h"

namespace oracle {

/** \brief A sphere with the swellings and hollows of two spherical harmonics. */
AnalyticSurface
heldOutHarmonics ();
/** \brief Winding ridges and hollows, skewed along their way. */
AnalyticSurface
heldOutDunes ();
/** \brief A hipped roof with rounded edges: straight lines that meet in threes. */
AnalyticSurface
heldOutRoof ();

} // namespace oracle
