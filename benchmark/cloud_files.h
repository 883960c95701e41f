// SPDX-License-Identifier: BSD-3-Clause
// Clouds and truths as files, to look at and to try other programs on.
#pragma once

#include "support/crest_truth.h"

#include <string>

namespace accuracy {

/** \brief Writes an ASCII PLY with normals. */
bool
writeCloud (const pcl::PointCloud<pcl::PointNormal>& cloud, const std::string& file);

/** \brief Writes an ASCII PCD with the place of the sensor. */
bool
writeScan (const pcl::PointCloud<pcl::PointXYZ>& cloud, const std::string& file);

/** \brief Writes an OBJ with a line element for each segment, in the groups ridge and
 * valley, and ridge_salient and valley_salient for those of oracle::salientLines.
 */
bool
writeTruth (const std::vector<oracle::TruthSegment>& truth, const std::string& file);

} // namespace accuracy
