// SPDX-License-Identifier: BSD-3-Clause
#include "presets/line_selection.h"

#include "base/parallel.h"
#include "lines/line_measures.h"

#include <algorithm>
#include <tuple>

namespace pcl {
namespace crest {

SelectedLines
selectLines (const OrientedPoints& points,
             const SurfaceShape& shape,
             const Crests& traced,
             const Parameters& parameters)
{
  const PerType<int> min_size{minSize (parameters, CrestType::RIDGE),
                              minSize (parameters, CrestType::VALLEY)};
  const bool moves = !traced.places.empty() && parameters.positions == Positions::CREST;
  // Lines need no normals to run and to be measured.
  OrientedPoints moved;
  if (moves)
    moved.positions = points.positions;
  std::vector<CrestLine> lines;
  for (std::size_t i = 0; i < traced.lines.size(); ++i) {
    const CrestLine& line = traced.lines[i];
    if (!parameters.wanted[line.type] || isSmall (line, min_size))
      continue;
    lines.push_back (line);
    if (moves)
      movePoints (line, traced.places[i], moved.positions);
  }
  measureLines (moves ? moved : points, shape.curvature, parameters.threads, lines);
  lines.erase (std::remove_if (lines.begin(),
                               lines.end(),
                               [&parameters] (const CrestLine& line) {
                                 return line.strength < parameters.min_strength;
                               }),
               lines.end());
  classifyEnds (shape.graph, lines);
  return {std::move (lines), std::move (moved.positions)};
}

std::vector<Label>
labelPoints (const SurfaceShape& shape,
             const std::vector<CrestType>& crest_points,
             const std::vector<CrestLine>& lines,
             const Parameters& parameters)
{
  std::vector<Label> labels (crest_points.size(), LABEL_NONE);
  std::vector<const CrestLine*> smallest_first;
  for (const CrestLine& line : lines)
    smallest_first.push_back (&line);
  std::sort (smallest_first.begin(),
             smallest_first.end(),
             [] (const CrestLine* a, const CrestLine* b) {
               return std::tie (a->size, a->length) < std::tie (b->size, b->length);
             });
  for (const CrestLine* line : smallest_first)
    for (const std::vector<index_t>& polyline : line->polylines)
      for (const index_t p : polyline)
        labels[p] =
            line->type == CrestType::RIDGE ? LABEL_RIDGE_GROWN : LABEL_VALLEY_GROWN;
  const auto labelBlock = [&] (std::size_t, std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      const CrestType type = crest_points[i];
      if (!shape.curvature[i].valid)
        labels[i] = LABEL_INVALID;
      else if (type != CrestType::NONE && parameters.wanted[type])
        labels[i] = type == CrestType::RIDGE ? LABEL_RIDGE : LABEL_VALLEY;
      else if (labels[i] == LABEL_NONE && parameters.boundaries &&
               shape.graph.boundary[i] != 0)
        labels[i] = LABEL_BOUNDARY;
    }
  };
  forEachBlock (labels.size(), parameters.threads, labelBlock);
  return labels;
}

} // namespace crest
} // namespace pcl
