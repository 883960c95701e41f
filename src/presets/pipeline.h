// SPDX-License-Identifier: BSD-3-Clause
// The presets: pipelines from samples to lines, each in a file of its own that reads as
// the overview of the paper's section 4.
//
// In come samples and where their neighbours are found, out go their curvatures, crest
// points and lines. The steps are values, so that a threshold that changes repeats only
// what it is for: an analysis depends on none, crest points on M or the confidence,
// lines on how they are pruned, the selection on S and what else chooses among lines.
// To add a preset, add a file, its name to Preset, and its pipeline to pipelines.cpp;
// parameters of its own have to be named where those of the others are (Parameters,
// options, statistics).
#pragma once

#include "lines/line_smoothing.h"

namespace pcl {
namespace crest {

/** \brief What the first stages find out about the surface (sections 4.1 and 4.2). It
 * depends on none of the thresholds for crest points and lines. Presets add what their
 * later stages need of it.
 */
struct SurfaceShape {
  SurfaceShape() = default;
  SurfaceShape (const SurfaceShape&) = delete;
  SurfaceShape&
  operator= (const SurfaceShape&) = delete;
  virtual ~SurfaceShape() = default;

  SurfaceGraph graph;
  std::vector<PrincipalCurvature> curvature;
  std::vector<StageTime> times;
};

/** \brief The crests of a surface, all indices packed. */
struct Crests {
  /** section 4.3; of both types, whichever are wanted */
  std::vector<CrestType> points;
  /** ridges first, of each type the largest first */
  std::vector<CrestLine> lines;
  /** where each of the lines runs; empty if through the points themselves */
  std::vector<LinePlaces> places;
  /** the chart of section 4.7 for each type; empty for those not wanted */
  PerType<LineSizes> sizes;
  std::vector<StageTime> times;
};

/** \brief A preset: how it is called, and its stages. */
class Pipeline {
public:
  Pipeline() = default;
  Pipeline (const Pipeline&) = delete;
  Pipeline&
  operator= (const Pipeline&) = delete;
  virtual ~Pipeline() = default;

  virtual Preset
  preset () const = 0;

  /** \brief As in options and statistics. */
  virtual std::string
  name () const = 0;

  /** \brief Which of the parameters that this preset alone has is set, in words for the
   * user; empty if none is.
   */
  virtual std::string
  ownParameter (const Parameters& parameters) const = 0;

  /** \brief What may be set instead of what other presets have, in words that go on
   * from "or set"; empty if nothing does nearly the same.
   */
  virtual std::string
  ownAlternative () const
  {
    return {};
  }

  /** \brief S where none is set. */
  virtual int
  defaultMinSize () const = 0;

  /** \brief Whether samples that tell nothing by themselves are gathered to nodes. */
  virtual bool
  gathersSamples () const
  {
    return false;
  }

  /** \brief Sections 4.1 and 4.2.
   * \param[in] progress to tell how far it is, if not null; so in the others
   */
  virtual std::shared_ptr<SurfaceShape>
  analyzeSurface (const OrientedPoints& points,
                  NeighborSource neighbors,
                  const Parameters& parameters,
                  Progress* progress) const = 0;

  /** \brief Section 4.3.
   * \param[in] shape as analyzeSurface of this preset made it; so in the others
   */
  virtual std::vector<CrestType>
  findCrestPoints (const OrientedPoints& points,
                   const SurfaceShape& shape,
                   const Parameters& parameters,
                   Progress* progress) const = 0;

  /** \brief Frees what nothing needs behind findCrestPoints. */
  virtual void
  releaseForLines (OrientedPoints& /*points*/, SurfaceShape& /*shape*/) const
  {}

  /** \brief Sections 4.4 to 4.6, and all lines of 4.7, whose length and strength are
   * not measured yet. min_size, min_strength and positions are not used.
   */
  virtual Crests
  traceCrests (const OrientedPoints& points,
               const SurfaceShape& shape,
               std::vector<CrestType> crest_points,
               const Parameters& parameters,
               Progress* progress) const = 0;
};

/** \brief All presets, the default first. */
const std::vector<const Pipeline*>&
allPipelines ();

/** \brief The one of a name; null if there is none. */
const Pipeline*
findPipeline (Preset preset);

/** \brief Begins a stage, unless nobody wants to know.
 * \param[in] end the part of all work that is done when it ends
 */
inline void
beginStage (Progress* progress, const std::string& stage, double end)
{
  if (progress != nullptr)
    progress->beginStage (stage, end);
}

/** The parts of all work that are done when the stages of all presets end. */
constexpr double PACKED = 0.01;
constexpr double CONNECTED = 0.15;
constexpr double CURVED = 0.9;
constexpr double CLASSIFIED = 0.93;
constexpr double TRACED = 1.0;

} // namespace crest
} // namespace pcl
