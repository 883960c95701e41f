// SPDX-License-Identifier: BSD-3-Clause
// Surfaces whose features are hardly wider than the spacing of samples.
#pragma once

#include "analytic_surface.h"

namespace oracle {

/** \brief The side of the square that a detailed surface covers. */
constexpr double DETAIL_SIDE = 80.0;

/** \brief Parallel waves that wind: neighbouring ridges are one wavelength apart, and
 * the surface turns by 41 degrees across each. */
AnalyticSurface
windingWaves (double wavelength);

/** \brief Two trains of waves across each other, the second with .7 of the height of
 * the first. */
AnalyticSurface
crossingWaves (double wavelength);

/** \brief Trains of 4, 5, 6, 8 and 12 units of length, each in a direction of its own.
 */
AnalyticSurface
waveMixture ();

/** \brief About as many even samples as are one unit apart, with exact normals.
 *
 * \param[out] parameters the (u, v) of each
 */
pcl::PointCloud<pcl::PointNormal>::Ptr
sampleOneApart (const AnalyticSurface& surface,
                unsigned seed,
                std::vector<Eigen::Vector2d>& parameters);

} // namespace oracle
