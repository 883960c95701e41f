// SPDX-License-Identifier: BSD-3-Clause
// Lines of one type against the truth, as the tables have it.
#pragma once

#include "support/crest_truth.h"
#include <nlohmann/json_fwd.hpp>

#include <string>

namespace accuracy {

/** \brief Lengths and distances in h, the spacing of the samples. */
struct TypeScore {
  pcl::crest::CrestType type;
  /** see oracle::LineScore; NaN, null in JSON, where there is nothing to take a part of
   */
  double precision, recall, error;
  double drawn_length, salient_length, true_length;
  std::size_t lines, closed, junctions;
};

/** \brief Scores the lines of a type.
 * \param[in] spacing h
 * \param[in] tolerance within how many h of a line is on it
 */
TypeScore
scoreType (const std::vector<pcl::crest::CrestLine>& lines,
           const pcl::PointCloud<pcl::PointNormal>& line_cloud,
           const std::vector<oracle::TruthSegment>& truth,
           pcl::crest::CrestType type,
           double spacing,
           double tolerance);

/** \brief "ridge", "valley", and "both" for NONE. */
std::string
nameOf (pcl::crest::CrestType type);

nlohmann::json
toJson (const TypeScore& score);

/** \brief The part of a row of the printed table that belongs to a type; its head. */
std::string
toRow (const TypeScore& score);
std::string
rowHead ();

} // namespace accuracy
