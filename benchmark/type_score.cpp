// SPDX-License-Identifier: BSD-3-Clause
#include "type_score.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdio>
#include <limits>
#include <set>

namespace accuracy {

using pcl::crest::CrestLine;
using pcl::crest::CrestType;
using pcl::crest::LineEnd;

TypeScore
scoreType (const std::vector<CrestLine>& lines,
           const pcl::PointCloud<pcl::PointNormal>& line_cloud,
           const std::vector<oracle::TruthSegment>& truth,
           CrestType type,
           double spacing,
           double tolerance)
{
  const oracle::LineScore score =
      oracle::scoreLines (lines, line_cloud, truth, type, tolerance * spacing);
  TypeScore result{};
  result.type = type;
  constexpr double UNDEFINED = std::numeric_limits<double>::quiet_NaN();
  result.precision = score.drawn_length > 0.0 ? score.precision : UNDEFINED;
  result.recall = score.salient_length > 0.0 ? score.recall : UNDEFINED;
  result.error = result.precision > 0.0 ? tolerance * score.error : UNDEFINED;
  result.drawn_length = score.drawn_length / spacing;
  result.salient_length = score.salient_length / spacing;
  for (const oracle::TruthSegment& s : truth)
    if (s.type == type)
      result.true_length += (s.b - s.a).norm() / spacing;
  std::set<pcl::index_t> junctions;
  for (const CrestLine& line : lines) {
    if (line.type != type)
      continue;
    ++result.lines;
    result.closed += line.closed ? 1 : 0;
    for (std::size_t i = 0; i < line.ends.size(); ++i) {
      if (line.ends[i][0] == LineEnd::JUNCTION)
        junctions.insert (line.polylines[i].front());
      if (line.ends[i][1] == LineEnd::JUNCTION)
        junctions.insert (line.polylines[i].back());
    }
  }
  result.junctions = junctions.size();
  return result;
}

std::string
nameOf (CrestType type)
{
  switch (type) {
  case CrestType::RIDGE:
    return "ridge";
  case CrestType::VALLEY:
    return "valley";
  default:
    return "both";
  }
}

nlohmann::json
toJson (const TypeScore& score)
{
  const auto known = [] (double value) {
    return std::isnan (value) ? nlohmann::json() : nlohmann::json (value);
  };
  return {{"precision", known (score.precision)},
          {"recall", known (score.recall)},
          {"error", known (score.error)},
          {"drawn_length", score.drawn_length},
          {"salient_length", score.salient_length},
          {"true_length", score.true_length},
          {"lines", score.lines},
          {"closed", score.closed},
          {"junctions", score.junctions}};
}

std::string
toRow (const TypeScore& score)
{
  char row[200];
  std::snprintf (row,
                 sizeof row,
                 "| %s | %.3f | %.3f | %.2f | %.2f | %.0f | %.0f | %zu | %zu | %zu |",
                 nameOf (score.type).c_str(),
                 score.precision,
                 score.recall,
                 score.error,
                 score.salient_length > 0.0 ? score.drawn_length / score.salient_length
                                            : 0.0,
                 score.drawn_length,
                 score.salient_length,
                 score.lines,
                 score.closed,
                 score.junctions);
  return row;
}

std::string
rowHead ()
{
  return "| type | P | R | err | ratio | drawn | salient | lines | closed | junctions "
         "|";
}

} // namespace accuracy
