// SPDX-License-Identifier: BSD-3-Clause
// Stylianou and Chrysanthou, section 4, stage by stage.
#include "presets/paper.h"

#include "base/stopwatch.h"
#include "crests/crest_points.h"
#include "lines/branch_pruning.h"
#include "presets/trace_types.h"

namespace pcl {
namespace crest {

namespace {

struct PaperShape : SurfaceShape {
  /** how far k1 is a maximum: what M is held against */
  std::vector<double> maximality;
};

/** \brief Sections 4.4 to 4.7 for one type. */
std::vector<CrestLine>
traceLinesOf (CrestType type,
              const OrientedPoints& points,
              const SurfaceShape& shape,
              const std::vector<CrestType>& crest_points,
              std::size_t largest_branch,
              Stopwatch& watch)
{
  // 4.4: region growing
  const std::vector<Membership> members =
      growRegions (shape.graph, shape.curvature, crest_points, type);
  watch.stageDone ("region growing");

  // 4.5: minimum spanning forest
  std::vector<CrestEdge> forest = minimumSpanningForest (points, shape.graph, members);
  watch.stageDone ("spanning forest");

  // 4.6: branch pruning
  forest = pruneBranches (points, std::move (forest), largest_branch);
  watch.stageDone ("pruning");

  // 4.7: crest lines
  return traceLines (points, shape.graph, members, forest, type, largest_branch);
}

class PaperPipeline : public Pipeline {
public:
  Preset
  preset () const override
  {
    return Preset::PAPER;
  }

  std::string
  name () const override
  {
    return "paper";
  }

  std::string
  ownParameter (const Parameters& parameters) const override
  {
    const Parameters unset;
    if (parameters.maximality.ridge != unset.maximality.ridge ||
        parameters.maximality.valley != unset.maximality.valley)
      return "M";
    if (parameters.absolute_maximality)
      return "the absolute unit of M";
    if (parameters.prune != unset.prune)
      return "the largest branch to prune";
    return {};
  }

  int
  defaultMinSize () const override
  {
    return 10;
  }

  std::shared_ptr<SurfaceShape>
  analyzeSurface (const OrientedPoints& points,
                  NeighborSource neighbors,
                  const Parameters& parameters,
                  Progress* progress) const override
  {
    const auto shape = std::make_shared<PaperShape>();
    const Workers workers (parameters.threads, progress);
    Stopwatch watch (shape->times);

    // 4.1: generating topological information
    beginStage (progress, "surface graph", CONNECTED);
    shape->graph =
        buildSurfaceGraph (points, std::move (neighbors), parameters, progress);
    watch.stageDone ("surface graph");

    // 4.2: curvature approximation
    beginStage (progress, "curvature", CURVED);
    shape->curvature = estimateCurvature (points, shape->graph, workers);
    watch.stageDone ("curvature");

    // 4.3, as far as it does not depend on M
    shape->maximality =
        measureMaximality (points, shape->graph, shape->curvature, workers);
    watch.stageDone ("maximality");
    return shape;
  }

  std::vector<CrestType>
  findCrestPoints (const OrientedPoints& points,
                   const SurfaceShape& shape,
                   const Parameters& parameters,
                   Progress* progress) const override
  {
    // 4.3: crest point classification
    beginStage (progress, "crest points", CLASSIFIED);
    return classifyCrestPoints (shape.curvature,
                                static_cast<const PaperShape&> (shape).maximality,
                                absoluteMaximality (parameters, points.extent));
  }

  void
  releaseForLines (OrientedPoints& points, SurfaceShape& shape) const override
  {
    points.normals = std::vector<Eigen::Vector3f>();
    static_cast<PaperShape&> (shape).maximality = std::vector<double>();
  }

  Crests
  traceCrests (const OrientedPoints& points,
               const SurfaceShape& shape,
               std::vector<CrestType> crest_points,
               const Parameters& parameters,
               Progress* progress) const override
  {
    beginStage (progress, "lines", TRACED);
    Crests crests;
    crests.points = std::move (crest_points);
    const auto trace = [&] (CrestType type, Stopwatch& watch) {
      return traceLinesOf (type,
                           points,
                           shape,
                           crests.points,
                           static_cast<std::size_t> (parameters.prune),
                           watch);
    };
    traceTypes (parameters, trace, crests);
    return crests;
  }
};

} // namespace

const Pipeline&
paperPipeline ()
{
  static const PaperPipeline pipeline;
  return pipeline;
}

} // namespace crest
} // namespace pcl
