// SPDX-License-Identifier: BSD-3-Clause
// How well one list of numbers orders things as another does.
#pragma once

#include <vector>

namespace accuracy {

/** \brief Spearman's rank correlation of two lists of equal length; equal numbers share
 * the mean of their ranks. 1 is the same order, 0 none; NaN where all of a list are
 * equal.
 */
double
rankCorrelation (const std::vector<double>& a, const std::vector<double>& b);

} // namespace accuracy
