// SPDX-License-Identifier: BSD-3-Clause
// The stages of the paper's section 4, with the scale of each crest and the
// significance of each line found by statistics, and sharp edges found beside the
// smooth crests.
#include "presets/automatic.h"

#include "base/large_arrays.h"
#include "base/stopwatch.h"
#include "creases/sharp_lines.h"
#include "creases/sharp_links.h"
#include "creases/sharp_profiles.h"
#include "crests/crest_feet.h"
#include "crests/crest_prominence.h"
#include "crests/profile_points.h"
#include "lines/branch_pruning.h"
#include "lines/crest_loops.h"
#include "lines/crest_significance.h"
#include "lines/line_measures.h"
#include "presets/trace_types.h"

#include <algorithm>

namespace pcl {
namespace crest {

namespace {

/** The part of all work that is done when the sharp edges are found. */
constexpr double CREASES_FOUND = 0.5;

struct AutomaticShape : SurfaceShape {
  SharpLines sharp_lines;
  /** what the curvature was taken from */
  std::vector<CrestProfile> profiles;
};

/** \brief What the lines of both types are traced from. */
struct CrestInputs {
  /** where the crest of each point is */
  OrientedPoints points;
  CrestEvidence evidence;
  std::vector<CrestType> likely_points;
};

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

/** \brief The longest branches to prune: those within the spread of a crest's position,
 * or too short for a line.
 */
std::vector<float>
branchLimits (const AutomaticShape& shape, double min_length)
{
  // Within its fit's radius a crest has one position: shorter branches are the spread
  // of that.
  constexpr float LONGEST_BRANCH = 1.5F;
  std::vector<float> limits = radii (shape.profiles, LONGEST_BRANCH);
  for (std::size_t i = 0; i < limits.size(); ++i)
    if (!shape.profiles[i].sharp)
      limits[i] = std::max (limits[i],
                            static_cast<float> (min_length) * shape.graph.spacing[i]);
  return limits;
}

/** \brief The points of smooth crests: sharp lines are complete as they are. */
template <typename Kind>
std::vector<Kind>
withoutSharp (const SharpLines& lines, std::vector<Kind> points, Kind none)
{
  for (std::size_t i = 0; i < lines.blocked.size(); ++i)
    if (lines.blocked[i] != 0)
      points[i] = none;
  return points;
}

/** \brief Sections 4.4 to 4.7 for one type. */
std::vector<CrestLine>
traceLinesOf (CrestType type,
              const CrestInputs& inputs,
              const AutomaticShape& shape,
              const Parameters& parameters,
              Stopwatch& watch)
{
  // Times the radius of a fit: shorter loops are the spread of a crest's position.
  constexpr float LONGEST_CUT_LOOP = 6.0F;
  const SharpLines& sharp = shape.sharp_lines;

  // 4.4: region growing, along crests
  const std::vector<Membership> members = withoutSharp (
      sharp,
      growAlongCrests (
          shape.graph,
          shape.profiles,
          withoutSharp (sharp, inputs.evidence.crest_points, CrestType::NONE),
          inputs.likely_points,
          type),
      Membership::OUTSIDE);
  watch.stageDone ("region growing");

  // 4.5: minimum spanning forest, around the sharp lines and their links to crests
  std::vector<CrestEdge> edges =
      admissibleEdges (inputs.points,
                       shape.graph,
                       shape.profiles,
                       crestEdges (inputs.points, shape.graph, members));
  const std::vector<CrestEdge> links =
      linksFromSharpEnds (inputs.points, shape.graph, sharp.edges[type], members);
  edges.insert (edges.end(), links.begin(), links.end());
  std::vector<CrestEdge> net =
      minimumSpanningForest (inputs.points.size(), edges, sharp.edges[type]);
  watch.stageDone ("spanning forest");
  net =
      closeLoops (inputs.points, edges, radii (shape.profiles, LONGEST_CUT_LOOP), net);
  watch.stageDone ("loops");

  // 4.6: branch pruning
  const std::vector<float> limits = branchLimits (shape, parameters.min_length);
  net = pruneShortBranches (inputs.points, std::move (net), limits);
  watch.stageDone ("pruning");

  // 4.7: crest lines, of those that mean something
  net = significantBranches (
      inputs.points, inputs.evidence, net, limits, parameters.angle);
  return significantLines (inputs.points,
                           inputs.evidence,
                           traceLines (inputs.points, net, type),
                           parameters);
}

const AutomaticShape&
automatic (const SurfaceShape& shape)
{
  return static_cast<const AutomaticShape&> (shape);
}

class AutomaticPipeline : public Pipeline {
public:
  Preset
  preset () const override
  {
    return Preset::AUTO;
  }

  std::string
  name () const override
  {
    return "auto";
  }

  std::string
  ownParameter (const Parameters& parameters) const override
  {
    const Parameters unset;
    if (parameters.angle != unset.angle)
      return "the turning angle";
    if (parameters.min_length != unset.min_length)
      return "the least length of a line";
    if (parameters.confidence != unset.confidence)
      return "the confidence";
    if (parameters.positions != unset.positions)
      return "where lines run";
    return {};
  }

  std::string
  ownAlternative () const override
  {
    return "the turning angle, the least length or the confidence";
  }

  int
  defaultMinSize () const override
  {
    return 0;
  }

  bool
  gathersSamples () const override
  {
    return true;
  }

  std::shared_ptr<SurfaceShape>
  analyzeSurface (const OrientedPoints& points,
                  NeighborSource neighbors,
                  const Parameters& parameters,
                  Progress* progress) const override
  {
    const auto shape = std::make_shared<AutomaticShape>();
    const Workers workers (parameters.threads, progress);
    Stopwatch watch (shape->times);

    // 4.1: generating topological information
    beginStage (progress, "surface graph", CONNECTED);
    std::shared_ptr<const PointTree> tree = neighbors.tree;
    shape->graph =
        buildSurfaceGraph (points, std::move (neighbors), parameters, progress);
    watch.stageDone ("surface graph");

    // Sharp edges, which no smooth surface fits.
    beginStage (progress, "creases", CREASES_FOUND);
    if (!tree)
      tree = treeOver (points.positions, parameters.threads);
    shape->sharp_lines = findSharpLines (points, shape->graph, tree, workers);
    watch.stageDone ("creases");

    // 4.2: curvature approximation, at the scale where it can be told
    beginStage (progress, "curvature", CURVED);
    shape->profiles =
        profileSharpCrests (points, shape->graph, shape->sharp_lines, tree, workers);
    reserveLarge (shape->curvature, points.size());
    for (std::size_t i = 0; i < points.size(); ++i)
      shape->curvature.push_back (
          surfaceCurvature (shape->profiles[i], shape->graph.spacing[i]));
    watch.stageDone ("curvature");
    return shape;
  }

  std::vector<CrestType>
  findCrestPoints (const OrientedPoints& /*points*/,
                   const SurfaceShape& shape,
                   const Parameters& parameters,
                   Progress* progress) const override
  {
    // 4.3: crest point classification
    beginStage (progress, "crest points", CLASSIFIED);
    return classifyCrestPoints (
        shape.graph, automatic (shape).profiles, parameters.confidence);
  }

  Crests
  traceCrests (const OrientedPoints& points,
               const SurfaceShape& surface_shape,
               std::vector<CrestType> crest_points,
               const Parameters& parameters,
               Progress* progress) const override
  {
    const AutomaticShape& shape = automatic (surface_shape);
    Crests crests;
    crests.points = std::move (crest_points);
    Stopwatch watch (crests.times);
    CrestInputs inputs{
        moveToCrests (points, shape.graph, shape.profiles),
        {shape.graph,
         shape.profiles,
         crests.points,
         measureProminence (points,
                            shape.graph,
                            shape.profiles,
                            crests.points,
                            Workers (parameters.threads, progress))},
        withoutSharp (
            shape.sharp_lines,
            likelyCrestPoints (shape.graph, shape.profiles, parameters.confidence),
            CrestType::NONE)};
    for (const SharpNode& node : shape.sharp_lines.nodes)
      inputs.points.positions[node.point] = node.crease.foot;
    watch.stageDone ("crest points");

    beginStage (progress, "lines", TRACED);
    const auto trace = [&] (CrestType type, Stopwatch& lines_watch) {
      return traceLinesOf (type, inputs, shape, parameters, lines_watch);
    };
    traceTypes (parameters, trace, crests);

    Stopwatch smoothing_watch (crests.times);
    crests.places = smoothLines (crests.lines,
                                 shape.profiles,
                                 shape.graph,
                                 inputs.points.positions,
                                 parameters.threads);
    measureProfiles (shape.profiles, crests.points, crests.lines);
    smoothing_watch.stageDone ("smoothing");
    return crests;
  }
};

} // namespace

const Pipeline&
automaticPipeline ()
{
  static const AutomaticPipeline pipeline;
  return pipeline;
}

} // namespace crest
} // namespace pcl
