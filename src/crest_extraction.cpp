// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_crest/branch_pruning.h>
#include <pcl_crest/crest_extraction.h>

#include <algorithm>
#include <iterator>
#include <tuple>

namespace pcl {
namespace crest {

SurfaceShape
analyzeSurface (const OrientedPoints& points,
                const NeighborSearch& search,
                const Parameters& parameters)
{
  SurfaceShape shape;
  Stopwatch watch (shape.times);
  shape.graph = buildSurfaceGraph (points, search, parameters);
  watch.stageDone ("surface graph");
  shape.curvature = estimateCurvature (points, shape.graph, parameters.threads);
  watch.stageDone ("curvature");
  return shape;
}

Crests
extractCrests (const OrientedPoints& points,
               const SurfaceShape& shape,
               const Parameters& parameters)
{
  Crests crests;
  Stopwatch watch (crests.times);
  crests.points = classifyCrestPoints (points,
                                       shape.graph,
                                       shape.curvature,
                                       absoluteMaximality (points, parameters),
                                       parameters.threads);
  watch.stageDone ("crest points");
  for (const CrestType type : CREST_TYPES) {
    if (!parameters.wanted[type])
      continue;
    const std::vector<Membership> members =
        growRegions (shape.graph, shape.curvature, crests.points, type);
    watch.stageDone ("region growing");
    const std::vector<CrestEdge> forest = minimumSpanningForest (
        points.size(), crestEdges (points, shape.graph, members));
    watch.stageDone ("spanning forest");
    const auto largest_branch = static_cast<std::size_t> (parameters.prune);
    const std::vector<CrestEdge> pruned =
        pruneBranches (points, forest, largest_branch);
    watch.stageDone ("pruning");
    std::vector<CrestLine> lines =
        traceLines (points, shape.graph, members, pruned, type, largest_branch);
    crests.sizes[type] = lineSizes (lines);
    lines = removeSmallLines (std::move (lines),
                              static_cast<std::size_t> (parameters.min_size[type]));
    std::move (lines.begin(), lines.end(), std::back_inserter (crests.lines));
    watch.stageDone ("lines");
  }
  return crests;
}

std::vector<Label>
labelPoints (const SurfaceShape& shape,
             const Crests& crests,
             const PerType<bool>& wanted)
{
  std::vector<Label> labels (crests.points.size(), LABEL_NONE);
  std::vector<const CrestLine*> smallest_first;
  for (const CrestLine& line : crests.lines)
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
  for (std::size_t i = 0; i < labels.size(); ++i) {
    const CrestType type = crests.points[i];
    if (!shape.curvature[i].valid)
      labels[i] = LABEL_INVALID;
    else if (type != CrestType::NONE && wanted[type])
      labels[i] = type == CrestType::RIDGE ? LABEL_RIDGE : LABEL_VALLEY;
  }
  return labels;
}

} // namespace crest
} // namespace pcl
