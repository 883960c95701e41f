// SPDX-License-Identifier: BSD-3-Clause
// The plane of the face that a sample is on, found among points of several.
#pragma once

#include <Eigen/Core>

#include "base/scatter.h"

#include <optional>

namespace pcl {
namespace crest {

/** \brief The plane through a sample on which the most of its neighbours are, fitted to
 * these, if that are at least 10 and two more than on any plane that is another: of all
 * planes through the sample and two of its nearest (Fischler and Bolles 1981, but with
 * every pair in the place of random ones).
 *
 * \param[in] offsets of the neighbours from the sample, the nearest first
 *
 * \param[in] tolerance how far off the plane they may be
 *
 * \return its normal, of unit length
 */
std::optional<Eigen::Vector3f>
consensusPlane (const Coordinates& offsets, double tolerance);

} // namespace crest
} // namespace pcl
