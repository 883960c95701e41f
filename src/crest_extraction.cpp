// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_crest/branch_pruning.h>
#include <pcl_crest/crest_extraction.h>
#include <pcl_crest/crest_feet.h>
#include <pcl_crest/crest_loops.h>
#include <pcl_crest/crest_prominence.h>
#include <pcl_crest/crest_significance.h>
#include <pcl_crest/line_measures.h>
#include <pcl_crest/line_smoothing.h>
#include <pcl_crest/sharp_links.h>
#include <pcl_crest/sharp_profiles.h>

#include "parallel.h"

#include <algorithm>
#include <iterator>
#include <tuple>

namespace pcl {
namespace crest {

namespace {

/** The parts of all work that are done when a stage ends. */
constexpr double PACKED = 0.01;
constexpr double CONNECTED = 0.15;
constexpr double CREASES_FOUND = 0.5;
constexpr double CURVED = 0.9;
constexpr double CLASSIFIED = 0.93;
constexpr double TRACED = 1.0;

void
beginStage (Progress* progress, const std::string& stage, double end)
{
  if (progress != nullptr)
    progress->beginStage (stage, end);
}

/** \brief Sections 4.4 to 4.7 for one type, as in the paper. */
std::vector<CrestLine>
linesOfPaper (const OrientedPoints& points,
              const SurfaceShape& shape,
              const std::vector<CrestType>& crest_points,
              CrestType type,
              const Parameters& parameters,
              Stopwatch& watch)
{
  const std::vector<Membership> members =
      growRegions (shape.graph, shape.curvature, crest_points, type);
  watch.stageDone ("region growing");
  std::vector<CrestEdge> forest = minimumSpanningForest (points, shape.graph, members);
  watch.stageDone ("spanning forest");
  const auto largest_branch = static_cast<std::size_t> (parameters.prune);
  forest = pruneBranches (points, std::move (forest), largest_branch);
  watch.stageDone ("pruning");
  return traceLines (points, shape.graph, members, forest, type, largest_branch);
}

/** \brief For each point the radius that it was fitted over, times a factor. */
std::vector<float>
radii (const std::vector<CrestProfile>& profiles, float factor)
{
  std::vector<float> result;
  result.reserve (profiles.size());
  for (const CrestProfile& profile : profiles)
    result.push_back (factor * profile.radius);
  return result;
}

/** \brief The points of smooth crests: sharp lines are complete as they are. */
std::vector<CrestType>
withoutSharp (const SharpLines& lines, std::vector<CrestType> crest_points)
{
  for (std::size_t i = 0; i < lines.blocked.size(); ++i)
    if (lines.blocked[i] != 0)
      crest_points[i] = CrestType::NONE;
  return crest_points;
}

/** \brief The same stages for points moved to their crests, which keep what profiles
 * and statistics bear out.
 */
std::vector<CrestLine>
significantLinesOf (const OrientedPoints& points,
                    const SurfaceShape& shape,
                    const CrestEvidence& evidence,
                    const std::vector<CrestType>& likely_points,
                    CrestType type,
                    const Parameters& parameters,
                    Stopwatch& watch)
{
  // Within its fit's radius a crest has one position: shorter branches and loops are
  // the spread of that.
  constexpr float LONGEST_BRANCH = 1.5F;
  constexpr float LONGEST_CUT_LOOP = 6.0F;

  std::vector<Membership> members =
      growAlongCrests (shape.graph,
                       shape.profiles,
                       withoutSharp (shape.sharp_lines, evidence.crest_points),
                       likely_points,
                       type);
  for (std::size_t i = 0; i < members.size(); ++i)
    if (shape.sharp_lines.blocked[i] != 0)
      members[i] = Membership::OUTSIDE;
  watch.stageDone ("region growing");
  std::vector<CrestEdge> edges = admissibleEdges (
      points, shape.graph, shape.profiles, crestEdges (points, shape.graph, members));
  const std::vector<CrestEdge>& sharp = shape.sharp_lines.edges[type];
  const std::vector<CrestEdge> links =
      linksFromSharpEnds (points, shape.graph, sharp, members);
  edges.insert (edges.end(), links.begin(), links.end());
  std::vector<CrestEdge> net = minimumSpanningForest (points.size(), edges, sharp);
  watch.stageDone ("spanning forest");
  net = closeLoops (points, edges, radii (shape.profiles, LONGEST_CUT_LOOP), net);
  watch.stageDone ("loops");
  // What is too short for a line is too short for a branch.
  std::vector<float> branch_limits = radii (shape.profiles, LONGEST_BRANCH);
  for (std::size_t i = 0; i < branch_limits.size(); ++i)
    if (!shape.profiles[i].sharp)
      branch_limits[i] = std::max (branch_limits[i],
                                   static_cast<float> (parameters.min_length) *
                                       shape.graph.spacing[i]);
  net = pruneShortBranches (points, std::move (net), branch_limits);
  watch.stageDone ("pruning");
  net = significantBranches (points, evidence, net, branch_limits, parameters.angle);
  return significantLines (
      points, evidence, traceLines (points, net, type), parameters);
}

/** \brief Enters the lines of the wanted types, which are traced side by side if there
 * are threads for it. The times of both are added up.
 * \param[in] trace returns the lines of a type, and books times
 */
template <typename Trace>
void
traceTypes (const Parameters& parameters, const Trace& trace, Crests& crests)
{
  PerType<std::vector<CrestLine>> lines;
  PerType<std::vector<StageTime>> times;
  ThreadFailure failure;
  const int threads = std::min (2, threadCount (parameters.threads));
#pragma omp parallel for schedule(static, 1) num_threads(threads)
  for (int i = 0; i < 2; ++i) {
    const CrestType type = CREST_TYPES[i];
    if (!parameters.wanted[type])
      continue;
    failure.guard ([&] {
      Stopwatch watch (times[type]);
      lines[type] = trace (type, watch);
      watch.stageDone ("lines");
    });
  }
  failure.rethrow();
  for (const CrestType type : CREST_TYPES) {
    crests.sizes[type] = lineSizes (lines[type]);
    std::move (
        lines[type].begin(), lines[type].end(), std::back_inserter (crests.lines));
    for (const StageTime& time : times[type])
      addTime (crests.times, time);
  }
}

/** \brief Section 4.2.
 * \param[in] wide_search makes the search for creases
 * \param[in,out] shape has the graph
 */
template <typename MakeSearch>
void
analyzeCurvature (const OrientedPoints& points,
                  const MakeSearch& wide_search,
                  const Parameters& parameters,
                  SurfaceShape& shape,
                  Stopwatch& watch,
                  Progress* progress)
{
  const Workers workers (parameters.threads, progress);
  if (parameters.preset == Preset::PAPER) {
    beginStage (progress, "curvature", CURVED);
    shape.curvature = estimateCurvature (points, shape.graph, workers);
    watch.stageDone ("curvature");
    shape.maximality =
        measureMaximality (points, shape.graph, shape.curvature, workers);
    watch.stageDone ("maximality");
  }
  else {
    beginStage (progress, "creases", CREASES_FOUND);
    const NeighborSearch search = wide_search();
    shape.sharp_lines =
        traceCreases (points,
                      shape.graph,
                      search,
                      findCreases (points, shape.graph, search, workers),
                      workers);
    watch.stageDone ("creases");
    beginStage (progress, "curvature", CURVED);
    shape.profiles =
        profileSharpCrests (points, shape.graph, shape.sharp_lines, workers);
    for (const CrestProfile& profile : shape.profiles)
      shape.curvature.push_back (profile.curvature);
    watch.stageDone ("curvature");
  }
}

} // namespace

SurfaceShape
analyzeSurface (const OrientedPoints& points,
                const Parameters& parameters,
                Progress* progress)
{
  SurfaceShape shape;
  Stopwatch watch (shape.times);
  beginStage (progress, "search tree", PACKED);
  if (!parameters.batched_search || parameters.radius > 0.0) {
    const NeighborSearch search = kdTreeSearch (points, parameters);
    watch.stageDone ("search tree");
    SurfaceShape rest = analyzeSurface (points, search, parameters, progress);
    rest.times.insert (rest.times.begin(), shape.times.begin(), shape.times.end());
    return rest;
  }
  std::shared_ptr<const PointTree> tree = batchedTree (points, parameters.threads);
  watch.stageDone ("search tree");
  beginStage (progress, "surface graph", CONNECTED);
  // Creases are searched for with the same tree.
  const std::shared_ptr<const PointTree> kept =
      parameters.preset == Preset::AUTO ? tree : nullptr;
  shape.graph = buildSurfaceGraph (points, std::move (tree), parameters, progress);
  watch.stageDone ("surface graph");
  const auto wide_search = [&] { return batchedSearch (kept, CREASE_NEIGHBORS); };
  analyzeCurvature (points, wide_search, parameters, shape, watch, progress);
  return shape;
}

SurfaceShape
analyzeSurface (const OrientedPoints& points,
                const NeighborSearch& search,
                const Parameters& parameters,
                Progress* progress)
{
  SurfaceShape shape;
  Stopwatch watch (shape.times);
  beginStage (progress, "surface graph", CONNECTED);
  shape.graph = buildSurfaceGraph (points, search, parameters, progress);
  watch.stageDone ("surface graph");
  const auto wide_search = [&points] {
    Parameters wide;
    wide.k = CREASE_NEIGHBORS;
    return kdTreeSearch (points, wide);
  };
  analyzeCurvature (points, wide_search, parameters, shape, watch, progress);
  return shape;
}

std::vector<CrestType>
findCrestPoints (const OrientedPoints& points,
                 const SurfaceShape& shape,
                 const Parameters& parameters,
                 Progress* progress)
{
  beginStage (progress, "crest points", CLASSIFIED);
  if (parameters.preset == Preset::PAPER)
    return classifyCrestPoints (
        shape.curvature, shape.maximality, absoluteMaximality (points, parameters));
  return classifyCrestPoints (shape.graph, shape.profiles, parameters.confidence);
}

Crests
traceCrests (const OrientedPoints& points,
             const SurfaceShape& shape,
             std::vector<CrestType> crest_points,
             const Parameters& parameters,
             Progress* progress)
{
  const Workers workers (parameters.threads, progress);
  Crests crests;
  crests.points = std::move (crest_points);
  Stopwatch watch (crests.times);
  if (parameters.preset == Preset::PAPER) {
    beginStage (progress, "lines", TRACED);
    traceTypes (
        parameters,
        [&] (CrestType type, Stopwatch& lines_watch) {
          return linesOfPaper (
              points, shape, crests.points, type, parameters, lines_watch);
        },
        crests);
    return crests;
  }
  const CrestEvidence evidence{
      shape.graph,
      shape.profiles,
      crests.points,
      measureProminence (points, shape.graph, shape.profiles, crests.points, workers)};
  const std::vector<CrestType> likely_points = withoutSharp (
      shape.sharp_lines,
      likelyCrestPoints (shape.graph, shape.profiles, parameters.confidence));
  OrientedPoints where = moveToCrests (points, shape.graph, shape.profiles);
  for (const SharpNode& node : shape.sharp_lines.nodes)
    where.positions[node.point] = node.crease.foot;
  watch.stageDone ("crest points");
  beginStage (progress, "lines", TRACED);
  traceTypes (
      parameters,
      [&] (CrestType type, Stopwatch& lines_watch) {
        return significantLinesOf (
            where, shape, evidence, likely_points, type, parameters, lines_watch);
      },
      crests);
  Stopwatch smoothing_watch (crests.times);
  crests.places = smoothLines (
      crests.lines, shape.profiles, shape.graph, where.positions, parameters.threads);
  measureProfiles (shape.profiles, crests.points, crests.lines);
  smoothing_watch.stageDone ("smoothing");
  return crests;
}

Crests
keepLines (const OrientedPoints& points,
           const SurfaceShape& shape,
           const Crests& traced,
           const Parameters& parameters)
{
  Crests crests;
  crests.points = traced.points;
  const PerType<int> min_size{minSize (parameters, CrestType::RIDGE),
                              minSize (parameters, CrestType::VALLEY)};
  for (const CrestType type : CREST_TYPES)
    if (parameters.wanted[type])
      crests.sizes[type] = traced.sizes[type];
  const bool moves =
      parameters.preset == Preset::AUTO && parameters.positions == Positions::CREST;
  // Lines need no normals to run and to be measured.
  OrientedPoints moved;
  if (moves)
    moved.positions = points.positions;
  for (std::size_t i = 0; i < traced.lines.size(); ++i) {
    const CrestLine& line = traced.lines[i];
    if (!parameters.wanted[line.type] || isSmall (line, min_size))
      continue;
    crests.lines.push_back (line);
    if (moves)
      movePoints (line, traced.places[i], moved.positions);
  }
  const OrientedPoints& where = moves ? moved : points;
  measureLines (where, shape.curvature, parameters.threads, crests.lines);
  crests.lines.erase (std::remove_if (crests.lines.begin(),
                                      crests.lines.end(),
                                      [&parameters] (const CrestLine& line) {
                                        return line.strength < parameters.min_strength;
                                      }),
                      crests.lines.end());
  classifyEnds (shape.graph, crests.lines);
  crests.positions = std::move (moved.positions);
  return crests;
}

std::vector<Label>
labelPoints (const SurfaceShape& shape,
             const Crests& crests,
             const Parameters& parameters)
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
  const auto labelBlock = [&] (std::size_t, std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      const CrestType type = crests.points[i];
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
