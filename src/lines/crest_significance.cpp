// SPDX-License-Identifier: BSD-3-Clause
#include "lines/crest_significance.h"

#include "lines/branch_pruning.h"
#include "lines/forest.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace pcl {
namespace crest {

namespace {

/** Least part of the points of a line that are crest points, not grown. */
constexpr double LEAST_CREST_PART = 0.25;
/** Least mean prominence. */
constexpr double LEAST_PROMINENCE = 0.25;
/** Least mean fall halfway to where |k1| is half: with less it is a blend of constant
 * radius between two faces, which has no crest. */
constexpr double LEAST_SHOULDERS = 0.1;
/** Least mean relief, in spacings: smaller is what is left of noise where it differs
 * little from sample to sample, as that of registered or smoothed scans does. */
constexpr double LEAST_RELIEF = 0.4;
/** In degrees: who asks for a smaller turn than this asks for lower ripples, too. */
constexpr double FULL_RELIEF_ANGLE = 25.0;
constexpr double LARGEST_RELIEF = 10.0;
/** Least mean turn of the relief, as a part of that of the crest: the same on surfaces
 * that are curved already, where a ripple makes a crest that turns by a lot. */
constexpr double LEAST_RELIEF_TURN = 0.7;
/** Least part of a branch's points that may bear out a line where all do not: pruning
 * joins weak pieces to strong ones, but each try is one more chance for noise. */
constexpr double LEAST_PART = 0.9;
/** Certainty of a line against that of its points: a line is a lucky one of the very
 * many that noise could draw. */
constexpr double LINE_CONFIDENCE = 4.0;
/** The same where points share their noise with the next, which standard errors do not
 * know. */
constexpr double CONFIDENCE_IN_SHARED_NOISE = 8.0;
/** Least length of a line in widths of its crest. */
constexpr double LEAST_ELONGATION = 0.75;
/** The same where points are as certain as this. Among those of noise there are some
 * wide ones; of certain ones borders and crossings may cut off what is missing. */
constexpr double CERTAIN_Z = 10.0;
constexpr double LEAST_CERTAIN_ELONGATION = 0.4;
/** No point is believed to be more certain than this. */
constexpr double LARGEST_Z = 30.0;

/** \brief What a crest adds to the surface around it: a wave whose curvature is the
 * prominent part of k1, and whose k1'' is the crest's.
 */
struct Relief {
  /** how far the surface turns across the wave, in degrees */
  double turn;
  /** its height, in spacings: that of a cosine, k^2 / |k''| */
  double height;

  Relief (const CrestProfile& profile, double prominence, double spacing)
  : turn (turningAngle (profile.sharpness) * std::pow (prominence, 1.5))
  , height (LARGEST_RELIEF)
  {
    // A sharp edge has stood out against a smooth surface already.
    if (profile.sharp)
      return;
    const double steepness = std::abs (profile.curvature.k1) * profile.sharpness;
    if (steepness > 0.0)
      height = std::min (height, prominence * prominence / (steepness * spacing));
  }
};

/** \brief What the crest points on a branch or line say together. */
struct Summary {
  std::size_t points = 0;
  std::size_t crest_points = 0;
  double turning_angle = 0.0;
  double prominence = 0.0;
  double shoulders = 0.0;
  double with_shoulders = 0.0;
  double relief_turn = 0.0;
  double relief = 0.0;

  void
  add (const CrestEvidence& evidence, index_t point)
  {
    ++points;
    if (evidence.crest_points[point] == CrestType::NONE)
      return;
    ++crest_points;
    const CrestProfile& profile = evidence.profiles[point];
    const double p = std::clamp (evidence.prominence[point].fall, 0.0F, 1.0F);
    const Relief wave (profile, p, evidence.graph.spacing[point]);
    turning_angle += turningAngle (profile.sharpness);
    prominence += p;
    if (std::isfinite (evidence.prominence[point].shoulders)) {
      shoulders += evidence.prominence[point].shoulders;
      with_shoulders += 1.0;
    }
    relief_turn += wave.turn;
    relief += wave.height;
  }

  /** \brief Whether |k1| is the same as far as it goes, where enough crest points tell.
   */
  bool
  isBlend () const
  {
    constexpr double KNOWN = 0.2;
    return with_shoulders > KNOWN * static_cast<double> (crest_points) &&
           shoulders < LEAST_SHOULDERS * with_shoulders;
  }

  bool
  bearsOut (double angle) const
  {
    const auto count = static_cast<double> (crest_points);
    return crest_points > 0 && turning_angle >= angle * count &&
           prominence >= LEAST_PROMINENCE * count && !isBlend() &&
           relief_turn >= LEAST_RELIEF_TURN * angle * count &&
           relief >= LEAST_RELIEF * std::min (1.0, angle / FULL_RELIEF_ANGLE) * count &&
           count >= LEAST_CREST_PART * static_cast<double> (points);
  }
};

/** \brief How many points from the start of a branch bear it out, as many as can be, if
 * nearly all of it do; else none.
 * \param[in] first, last of the branch, in either direction
 */
template <typename Iterator>
std::size_t
significantStart (const CrestEvidence& evidence,
                  Iterator first,
                  Iterator last,
                  double angle)
{
  const double least = LEAST_PART * static_cast<double> (std::distance (first, last));
  Summary summary;
  std::size_t longest = 0;
  for (; first != last; ++first) {
    summary.add (evidence, *first);
    if (static_cast<double> (summary.points) >= least && summary.bearsOut (angle))
      longest = summary.points;
  }
  return longest;
}

/** \brief The first point and the end of what is significant of a branch. A loop has no
 * ends to be weak.
 */
std::pair<std::size_t, std::size_t>
significantPart (const CrestEvidence& evidence,
                 const std::vector<index_t>& branch,
                 double angle)
{
  const std::size_t from_start =
      significantStart (evidence, branch.begin(), branch.end(), angle);
  if (from_start == branch.size())
    return {0, from_start};
  if (branch.front() == branch.back())
    return {0, 0};
  const std::size_t to_end =
      significantStart (evidence, branch.rbegin(), branch.rend(), angle);
  if (from_start >= to_end)
    return {0, from_start};
  return {branch.size() - to_end, branch.size()};
}

/** \brief Whether a branch between junctions is a rung between two lines: as short as
 * what is pruned, its chord across the crest at one of them, and borne out by them
 * alone.
 */
bool
isRung (const OrientedPoints& points,
        const CrestEvidence& evidence,
        const std::vector<index_t>& branch,
        const std::vector<float>& limits,
        double angle)
{
  if (polylineLength (points, branch) >
      std::max (limits[branch.front()], limits[branch.back()]))
    return false;
  constexpr float ACROSS = 0.7F;
  const Eigen::Vector3f chord =
      points.edge (branch.front(), branch.back()).normalized().cast<float>();
  const auto leavesAcross = [&] (index_t junction) {
    return std::abs (chord.dot (evidence.profiles[junction].curvature.t1)) > ACROSS;
  };
  // Single edges are admissible ones.
  if (branch.size() == 2 ||
      !(leavesAcross (branch.front()) || leavesAcross (branch.back())))
    return false;
  Summary between;
  for (std::size_t i = 1; i + 1 < branch.size(); ++i)
    between.add (evidence, branch[i]);
  return !between.bearsOut (angle);
}

/** \brief Removes growth from ends. */
void
trimGrowth (const CrestEvidence& evidence, Forest& graph)
{
  for (int v = 0; v < graph.size(); ++v)
    for (int end = v; graph.degree (end) == 1 &&
                      evidence.crest_points[graph.packed (end)] == CrestType::NONE;) {
      const int w = graph.neighbors (end)[0];
      graph.removeEdge (end, w);
      end = w;
    }
}

/** \brief The points of a line, each once. */
std::vector<index_t>
pointsOf (const CrestLine& line)
{
  std::vector<index_t> points;
  for (const std::vector<index_t>& polyline : line.polylines)
    points.insert (points.end(), polyline.begin(), polyline.end());
  std::sort (points.begin(), points.end());
  points.erase (std::unique (points.begin(), points.end()), points.end());
  return points;
}

/** \brief The length of a line in widths of its crest: where |k1| has dropped to zero
 * on the profile's parabola, to both sides.
 */
double
elongation (const OrientedPoints& points,
            const CrestEvidence& evidence,
            const CrestLine& line,
            const Summary& summary)
{
  double sum = 0.0;
  const auto add = [&] (index_t p, double length) {
    const CrestProfile& profile = evidence.profiles[p];
    if (evidence.crest_points[p] != CrestType::NONE && profile.sharpness > 0.0F)
      sum += length * std::abs (profile.curvature.k1) /
             (2.0 * std::sqrt (2.0 / profile.sharpness));
  };
  for (const std::vector<index_t>& polyline : line.polylines)
    for (std::size_t i = 1; i < polyline.size(); ++i) {
      const index_t p = polyline[i - 1];
      const index_t q = polyline[i];
      const double length = points.edge (p, q).norm();
      add (p, 0.5 * length);
      add (q, 0.5 * length);
    }
  // What was grown has no profile of its own: it counts as the crest points do.
  return sum * static_cast<double> (summary.points) /
         static_cast<double> (summary.crest_points);
}

} // namespace

std::vector<CrestEdge>
significantBranches (const OrientedPoints& points,
                     const CrestEvidence& evidence,
                     std::vector<CrestEdge> edges,
                     const std::vector<float>& limits,
                     double angle)
{
  // Removing one branch joins others to longer ones, which are judged again.
  constexpr int ROUNDS = 3;
  for (int round = 0; round < ROUNDS; ++round) {
    Forest graph (edges);
    std::vector<std::pair<int, int>> removed;
    std::vector<bool> seen (static_cast<std::size_t> (graph.size()), false);
    for (int v = 0; v < graph.size(); ++v) {
      if (seen[v])
        continue;
      for (const std::vector<int>& branch :
           graph.branches (graph.component (v, seen))) {
        const std::vector<index_t> on_branch = graph.packed (branch);
        const bool bridge =
            graph.degree (branch.front()) > 2 && graph.degree (branch.back()) > 2;
        const bool rung = bridge && isRung (points, evidence, on_branch, limits, angle);
        const auto [first, end] = rung ? std::pair<std::size_t, std::size_t> (0, 0)
                                       : significantPart (evidence, on_branch, angle);
        for (std::size_t i = 1; i < branch.size(); ++i)
          if (i <= first || i >= end)
            removed.emplace_back (branch[i - 1], branch[i]);
      }
    }
    for (const auto& [v, w] : removed)
      graph.removeEdge (v, w);
    edges = pruneShortBranches (points, graph.remaining (edges), limits);
    if (removed.empty())
      break;
  }
  Forest graph (edges);
  trimGrowth (evidence, graph);
  return pruneShortBranches (points, graph.remaining (edges), limits);
}

std::vector<CrestLine>
significantLines (const OrientedPoints& points,
                  const CrestEvidence& evidence,
                  std::vector<CrestLine> lines,
                  const Parameters& parameters)
{
  const double least_certainty =
      (points.share_noise ? CONFIDENCE_IN_SHARED_NOISE : LINE_CONFIDENCE) *
      parameters.confidence;
  const auto insignificant = [&] (const CrestLine& line) {
    const std::vector<index_t> on_line = pointsOf (line);
    Summary summary;
    double z = 0.0;
    double radius = 0.0;
    double spacing = 0.0;
    for (const index_t p : on_line) {
      summary.add (evidence, p);
      if (evidence.crest_points[p] != CrestType::NONE)
        z += std::min<double> (evidence.profiles[p].peak_z, LARGEST_Z);
      radius += evidence.profiles[p].radius;
      spacing += evidence.graph.spacing[p];
    }
    if (!summary.bearsOut (parameters.angle))
      return true;
    const auto count = static_cast<double> (on_line.size());
    radius /= count;
    spacing /= count;
    z /= static_cast<double> (summary.crest_points);
    // Fits overlap: about one in each radius is independent of the others.
    const double certainty = z * std::sqrt (1.0 + line.length / radius);
    return line.length < std::max (radius, parameters.min_length * spacing) ||
           certainty < least_certainty ||
           elongation (points, evidence, line, summary) <
               (z > CERTAIN_Z ? LEAST_CERTAIN_ELONGATION : LEAST_ELONGATION);
  };
  lines.erase (std::remove_if (lines.begin(), lines.end(), insignificant), lines.end());
  return lines;
}

} // namespace crest
} // namespace pcl
