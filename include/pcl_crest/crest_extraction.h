// SPDX-License-Identifier: BSD-3-Clause
// Paper, section 4: the overview, that is the stages in their order.
#pragma once

#include <pcl_crest/crease_lines.h>
#include <pcl_crest/crest_lines.h>
#include <pcl_crest/line_smoothing.h>
#include <pcl_crest/stopwatch.h>

namespace pcl {
namespace crest {

/** \brief What the first stages find out about the surface. It depends on none of
 * the thresholds for crest points and lines, so these can change without it.
 */
struct SurfaceShape {
  SurfaceGraph graph;
  std::vector<PrincipalCurvature> curvature;
  /** with the preset PAPER how far k1 is a maximum, else empty */
  std::vector<double> maximality;
  /** with the preset AUTO what the curvature was taken from, else empty */
  std::vector<CrestProfile> profiles;
  /** with the preset AUTO the sharp edges */
  SharpLines sharp_lines;
  std::vector<StageTime> times;
};

/** \brief The crests of a surface, all indices packed. */
struct Crests {
  /** section 4.3; of both types, whichever are wanted */
  std::vector<CrestType> points;
  /** the lines that are kept: ridges first, of each type the largest first */
  std::vector<CrestLine> lines;
  /** where each of the lines that traceCrests found runs; empty if through the points
   * themselves
   */
  std::vector<LinePlaces> places;
  /** for each packed point where the lines that keepLines kept run through it; empty if
   * through the points themselves
   */
  std::vector<Eigen::Vector3f> positions;
  /** the distribution before small lines were removed (4.7), for the types wanted */
  PerType<LineSizes> sizes;
  std::vector<StageTime> times;
};

/** \brief Sections 4.1 and 4.2, and of 4.3 what M is held against, with the search that
 * the parameters name.
 * \param[in] progress to tell how far it is, if not null; so in the others
 */
SurfaceShape
analyzeSurface (const OrientedPoints& points,
                const Parameters& parameters,
                Progress* progress = nullptr);

/** \brief The same with any search in the place of those of the parameters. */
SurfaceShape
analyzeSurface (const OrientedPoints& points,
                const NeighborSearch& search,
                const Parameters& parameters,
                Progress* progress = nullptr);

/** \brief Section 4.3. Behind it, the preset PAPER needs neither the normals of the
 * points nor the maximality of the shape any more.
 */
std::vector<CrestType>
findCrestPoints (const OrientedPoints& points,
                 const SurfaceShape& shape,
                 const Parameters& parameters,
                 Progress* progress = nullptr);

/** \brief Sections 4.4 to 4.6, and all lines of 4.7, whose length and strength are not
 * measured yet. min_size, min_strength and positions are not used.
 */
Crests
traceCrests (const OrientedPoints& points,
             const SurfaceShape& shape,
             std::vector<CrestType> crest_points,
             const Parameters& parameters,
             Progress* progress = nullptr);

/** \brief The rest of section 4.7: keeps the lines of the wanted types that have
 * min_size points, measures them, and removes those below min_strength.
 * \param[in] traced by traceCrests with these parameters but for the three above, of
 * at least the wanted types
 */
Crests
keepLines (const OrientedPoints& points,
           const SurfaceShape& shape,
           const Crests& traced,
           const Parameters& parameters);

/** \brief The label of each packed point. A point joined by growth that lies on lines
 * of both types belongs to the larger one, of equals to the longer.
 * \param[in] parameters wanted, boundaries and threads are used
 */
std::vector<Label>
labelPoints (const SurfaceShape& shape,
             const Crests& crests,
             const Parameters& parameters);

} // namespace crest
} // namespace pcl
