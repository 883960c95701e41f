// SPDX-License-Identifier: BSD-3-Clause
#include "creases/creases.h"

#include "base/large_arrays.h"
#include "base/parallel.h"
#include "creases/crossing_planes.h"
#include "creases/face_end.h"
#include "creases/plate_rim.h"
#include "creases/quartic_residual.h"
#include "creases/two_planes.h"
#include "curvature/cubic_residuals.h"
#include "curvature/pyramid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

namespace pcl {
namespace crest {

namespace {

using Eigen::Vector3d;

constexpr double DEGREES = 180.0 / M_PI;
constexpr std::array<int, 4> WINDOWS{20, 30, 48, CREASE_NEIGHBORS};

/** What two planes have to leave of the smooth surface's residual, without the noise,
 * at most. */
constexpr double LARGEST_RATIO = 0.7;
/** Least logarithm of the residuals' ratio, noise included, times the number of
 * neighbours: two planes fit noise, too, by chance. */
constexpr double LEAST_EVIDENCE = 9.0;
/** Below, two planes are as good as one; above, they are two sheets. */
constexpr double LEAST_ANGLE = 7.0;
constexpr double LARGEST_ANGLE = 155.0;
/** In spacings: distance of an edge from its sample. */
constexpr double FARTHEST_FOOT = 1.0;
/** In spacings: distances that are zero up to rounding, and to what little curvature
 * the faces of an edge may have. */
constexpr double ZERO_RESIDUAL = 0.05;
constexpr double ZERO = ZERO_RESIDUAL * ZERO_RESIDUAL;
/** In squared spacings: the noise that a round edge has to exceed, where there is less.
 */
constexpr double LEAST_NOISE = 0.02 * 0.02;

/** Of each window the mean squared distance from a cubic. */
using SmoothResiduals = std::array<double, WINDOWS.size()>;

/** \brief Fits edges around one sample after the other. Lengths are in spacings, from
 * the sample.
 */
class CreaseFitter {
public:
  /** \param[in] points, graph the samples
   * \param[in] largest_residual that two planes may leave, in spacings
   * \param[in] smooth the cubics that edges have to beat; fit uses its first lane
   */
  CreaseFitter (const OrientedPoints& points,
                const SurfaceGraph& graph,
                double largest_residual,
                CubicResiduals& smooth)
  : points_ (points)
  , graph_ (graph)
  , largest_square_ (largest_residual * largest_residual)
  , smooth_ (smooth)
  {}

  [[nodiscard]] index_t
  sample () const
  {
    return sample_;
  }

  /** \brief Takes what a search has found, nearest first. */
  void
  setNeighbors (index_t sample, const std::vector<index_t>& found)
  {
    // Normals that are opposite belong to the other side of a plate.
    constexpr float OTHER_SIDE = -0.9F;
    const double scale = 1.0 / graph_.spacing[sample];
    const Eigen::Vector3f& n = points_.normals[sample];
    sample_ = sample;
    nearest_ = found;
    neighbors_.clear();
    for (const index_t q : found)
      if (n.dot (points_.normals[q]) > OTHER_SIDE)
        neighbors_.emplace_back (points_.edge (sample, q).squaredNorm(), q);
    // The batched search finds them in this order but for rounding.
    if (!std::is_sorted (neighbors_.begin(), neighbors_.end()))
      std::sort (neighbors_.begin(), neighbors_.end());
    neighbors_.erase (std::unique (neighbors_.begin(), neighbors_.end()),
                      neighbors_.end());
    if (neighbors_.size() > CREASE_NEIGHBORS)
      neighbors_.resize (CREASE_NEIGHBORS);
    positions_.resize (neighbors_.size());
    normals_.resize (neighbors_.size());
    for (std::size_t i = 0; i < neighbors_.size(); ++i) {
      const index_t q = neighbors_[i].second;
      positions_.set (i, scale * points_.edge (sample, q));
      normals_.set (i, points_.normals[q].cast<double>());
    }
  }

  /** \brief Sets a lane of the cubics to the neighbours. */
  void
  describe (int lane) const
  {
    Vector3d normal = points_.normals[sample_].cast<double>();
    for (std::size_t i = 0; i < neighbors_.size(); ++i)
      normal += normals_[i];
    smooth_.set (lane,
                 normal.normalized(),
                 neighbors_.empty() ? 1.0 : positions_[neighbors_.size() - 1].norm(),
                 neighbors_.size(),
                 [this] (std::size_t i) { return positions_[i]; });
  }

  /** \param[in] smooth of the windows for which there are enough neighbours */
  Crease
  fit (const SmoothResiduals& smooth)
  {
    Crease best;
    smallest_ratio_ = 1.0;
    of_noise_window_ = 0.0;
    Scatter normals;
    all_ = Scatter();
    std::size_t added = 0;
    const auto one = [] (std::size_t) { return 1.0; };
    for (std::size_t w = 0; w < WINDOWS.size(); ++w) {
      const auto count = static_cast<std::size_t> (WINDOWS[w]);
      if (count > neighbors_.size())
        break;
      normals.add (normals_, added, count, one);
      all_.add (positions_, added, count, one);
      added = count;
      if (count == NOISE_WINDOW) {
        of_noise_window_ = smooth[w];
        in_noise_window_ = all_;
      }
      if (mayHaveFaces (count, smooth[w]))
        fitWindow (count, smooth[w], normals, best);
    }
    const bool two_faces = best.type != CrestType::NONE;
    const bool exact = two_faces && of_best_planes_ <= ZERO;
    if (!exact)
      takeBothSheets();
    if (!exact && largest_square_ < OF_FLAT_FACES) {
      Crease end = fitEnd();
      if (end.type != CrestType::NONE)
        return end;
    }
    if (!two_faces) {
      best = fitCrossing (smooth);
      return best.type != CrestType::NONE ? best : fitRim();
    }
    if (neighbors_.size() >= NOISE_WINDOW && isSpread (in_noise_window_))
      best.roundness = static_cast<float> (roundnessOf (best.normal.cast<double>()));
    return best;
  }

private:
  /** The window that tells the noise, as a cubic follows most of what else there is. */
  static constexpr std::size_t NOISE_WINDOW = 30;
  /** The part of its residual that is noise for certain, with 20 degrees of
   * freedom. */
  static constexpr double CERTAIN_NOISE = 0.4;
  /** What a cubic leaves, without the noise, where two planes leave LARGEST_RATIO. */
  static constexpr double LEAST_OF_CUBIC = ZERO * (1.0 / LARGEST_RATIO - 1.0);
  /** Where two planes may leave more, in squared spacings, noise leaves nothing flat.
   */
  static constexpr double OF_FLAT_FACES = 0.4 * 0.4;
  /** Three for each, and the choice between them. */
  static constexpr std::size_t PLANE_PARAMETERS = 7;

  /** \brief What is noise for certain in the residual of a window. */
  double
  noiseOf (std::size_t count) const
  {
    return count > NOISE_WINDOW ? CERTAIN_NOISE * of_noise_window_ : 0.0;
  }

  /** \brief The mean squared distance from two planes up to which they are better than
   * a cubic.
   */
  double
  largestResidual (std::size_t count, double of_cubic) const
  {
    const double noise = noiseOf (count);
    const double by_ratio =
        LARGEST_RATIO * (std::max (0.0, of_cubic - noise) + ZERO) - ZERO + noise;
    const double by_evidence =
        std::exp (-LEAST_EVIDENCE / static_cast<double> (count)) * (of_cubic + ZERO) -
        ZERO;
    return std::min ({largest_square_, by_ratio, by_evidence});
  }

  /** \brief What to take off the residual of a cubic because it is of heights: where
   * the surface slopes by half the angle, these exceed the distances from planes, those
   * of noise as well. That helps to see edges, but where much noise is let through it
   * would draw some along a pipe of seven spacings, unless a third is taken off.
   */
  static double
  excessOfHeights (double angle, double of_planes)
  {
    constexpr double MUCH = 0.35 * 0.35;
    constexpr double PART = 0.33;
    const double slope = std::tan (0.5 * angle / DEGREES);
    return PART * slope * slope * std::max (0.0, of_planes - MUCH);
  }

  /** \brief The line where two planes meet. */
  struct MeetingLine {
    /** between the normals, in degrees */
    double angle;
    Vector3d direction;
    /** nearest to the sample */
    Vector3d foot;
  };

  /** \brief Where two planes meet; none if that is far away, or they hardly meet.
   * \param[in] least_angle, largest_angle between the normals, in degrees
   */
  static std::optional<MeetingLine>
  meetingLine (const Plane& a, const Plane& b, double least_angle, double largest_angle)
  {
    const Vector3d& n = a.normal;
    const Vector3d& m = b.normal;
    const double angle =
        std::acos (std::max (-1.0, std::min (1.0, n.dot (m)))) * DEGREES;
    if (angle < least_angle || angle > largest_angle)
      return std::nullopt;
    // Where both planes' equations hold, nearest to the sample.
    const Vector3d line = n.cross (m);
    const Vector3d crossing =
        (n.dot (a.center) * m.cross (line) + m.dot (b.center) * line.cross (n)) /
        line.squaredNorm();
    const Vector3d direction = line.normalized();
    const Vector3d foot = crossing - crossing.dot (direction) * direction;
    if (foot.norm() > FARTHEST_FOOT)
      return std::nullopt;
    return MeetingLine{angle, direction, foot};
  }

  /** \brief A crease along a line, of a residual beside that of a cubic. */
  Crease
  creaseAlong (const MeetingLine& line,
               const Vector3d& normal,
               bool convex,
               std::size_t count,
               double of_planes,
               double of_smooth) const
  {
    const double noise = noiseOf (count);
    const double ratio = (std::max (0.0, of_planes - noise) + ZERO) /
                         (std::max (0.0, of_smooth - noise) + ZERO);
    Crease crease;
    crease.type = convex ? CrestType::RIDGE : CrestType::VALLEY;
    crease.foot = (points_.positions[sample_].cast<double>() +
                   graph_.spacing[sample_] * line.foot)
                      .cast<float>();
    crease.direction = line.direction.cast<float>();
    crease.normal = normal.cast<float>();
    crease.angle = static_cast<float> (line.angle);
    crease.ratio = static_cast<float> (ratio);
    return crease;
  }

  /** \param[in] of_cubic about the mean squared distance from a cubic
   * \param[in] normals those of the neighbours in the window
   */
  void
  fitWindow (std::size_t count, double of_cubic, const Scatter& normals, Crease& best)
  {
    // The planes of the first round are not the best ones yet.
    constexpr double FIRST_ROUND = 6.0;
    const double largest = FIRST_ROUND * largestResidual (count, of_cubic) *
                           static_cast<double> (count - PLANE_PARAMETERS);
    if (!planes_.split (normals_, count, normals) ||
        !planes_.fit (positions_, count, all_, largest))
      return;
    const auto line = meetingLine (planes_[0], planes_[1], LEAST_ANGLE, LARGEST_ANGLE);
    if (!line)
      return;
    const double of_planes = planes_.squaredDistances (positions_, count) /
                             static_cast<double> (count - PLANE_PARAMETERS);
    if (of_planes > largest_square_)
      return;
    const Vector3d normal = (planes_[0].normal + planes_[1].normal).normalized();
    if (seesThirdFace (count, normal))
      return;
    const double of_smooth =
        smoothResidual (count, normal) - excessOfHeights (line->angle, of_planes);
    const double noisy_ratio = (of_planes + ZERO) / (of_smooth + ZERO);
    if (of_planes > largestResidual (count, of_smooth) || noisy_ratio > smallest_ratio_)
      return;
    smallest_ratio_ = noisy_ratio;
    best = creaseAlong (*line, normal, planes_.convex(), count, of_planes, of_smooth);
    best_window_ = count;
    of_best_planes_ = of_planes;
  }

  /** \brief What the planes of the best crease leave, as a part of what a smooth
   * surface does: of a quartic where samples have little noise, which follows what is
   * as narrow as the smallest windows, else of a cubic, which is right for larger ones
   * alone.
   */
  double
  roundnessOf (const Vector3d& normal) const
  {
    // In squared spacings.
    constexpr double LITTLE_NOISE = 0.002;
    // Where samples are on a few lines, or on levels, a quartic goes through all of
    // them.
    constexpr double MOST = 2.0;
    const double of_quartic = quarticResidual (positions_, normal);
    if (of_quartic < LITTLE_NOISE)
      return std::min (MOST, of_best_planes_ / (of_quartic + LEAST_NOISE));
    return best_window_ > NOISE_WINDOW
               ? of_best_planes_ / (of_noise_window_ + LEAST_NOISE)
               : 0.0;
  }

  /** \brief The crease where two planes meet whatever the signs of normals, in the
   * smallest window that shows one.
   */
  Crease
  fitCrossing (const SmoothResiduals& smooth)
  {
    // Where these cross at less, the points near both tell nothing.
    constexpr double LEAST_CROSSING = 30.0;
    // What is no side of a plane, in spacings.
    constexpr double TOLERANCE = 0.3;
    constexpr double MOST_ASTRAY = 0.4;
    Eigen::Matrix3d products = Eigen::Matrix3d::Zero();
    std::size_t added = 0;
    for (std::size_t w = 0; w < WINDOWS.size(); ++w) {
      const auto count = static_cast<std::size_t> (WINDOWS[w]);
      if (count > neighbors_.size())
        break;
      for (; added < count; ++added)
        products += normals_[added] * normals_[added].transpose();
      if (!mayHaveFaces (count, smooth[w]) ||
          !crossing_.fit (
              positions_, normals_, count, products, TOLERANCE, MOST_ASTRAY))
        continue;
      const Plane& through = crossing_[0];
      const Plane& ending = crossing_[1];
      const auto line =
          meetingLine (through, ending, LEAST_CROSSING, 180.0 - LEAST_CROSSING);
      const double of_planes =
          crossing_.squaredDistances() / static_cast<double> (count - PLANE_PARAMETERS);
      if (line && of_planes <= largestResidual (count, smooth[w]))
        return creaseAlong (*line,
                            (through.normal + ending.normal).normalized(),
                            crossing_.convex(),
                            count,
                            of_planes,
                            smooth[w]);
    }
    return {};
  }

  /** \brief Takes the nearest of both sheets of a plate. */
  void
  takeBothSheets ()
  {
    constexpr std::size_t RIM_NEIGHBORS = 48;
    const std::size_t count = std::min (RIM_NEIGHBORS, nearest_.size());
    const double scale = 1.0 / graph_.spacing[sample_];
    of_sheets_.resize (count);
    normals_of_sheets_.resize (count);
    for (std::size_t i = 0; i < count; ++i) {
      of_sheets_.set (i, scale * points_.edge (sample_, nearest_[i]));
      normals_of_sheets_.set (i, points_.normals[nearest_[i]].cast<double>());
    }
  }

  /** \brief The crease where a flat face ends at what is no plane. */
  Crease
  fitEnd () const
  {
    const auto end = fitFaceEnd (of_sheets_, points_.normals[sample_].cast<double>());
    if (!end)
      return {};
    return creaseAlong ({end->angle, end->direction, end->foot},
                        end->normal,
                        end->convex,
                        of_sheets_.size(),
                        end->of_face,
                        end->of_all);
  }

  /** \brief The crease along the rim of a thin plate. */
  Crease
  fitRim () const
  {
    const auto rim = fitPlateRim (of_sheets_,
                                  normals_of_sheets_,
                                  points_.normals[sample_].cast<double>(),
                                  largest_square_);
    if (!rim)
      return {};
    constexpr double RIGHT_ANGLE = 90.0;
    return creaseAlong ({RIGHT_ANGLE, rim->direction, rim->foot},
                        rim->normal,
                        true,
                        of_sheets_.size(),
                        rim->of_sheets,
                        rim->of_one_plane);
  }

  /** \brief Whether a cubic leaves enough of a window to look for faces. In the frame
   * of the edge it will be a little different. No faces leave less than what is noise
   * for certain.
   */
  bool
  mayHaveFaces (std::size_t count, double of_cubic) const
  {
    return of_cubic - noiseOf (count) > 0.5 * LEAST_OF_CUBIC &&
           noiseOf (count) < largest_square_;
  }

  /** \brief Whether neighbours lie around the sample rather than on a line or two of a
   * scan, of which a cubic leaves little whatever the noise from line to line. The same
   * is said of what is folded by much more than 90 degrees: that is sharp enough.
   */
  static bool
  isSpread (const Scatter& positions)
  {
    // The square of width over length.
    constexpr double LEAST_WIDTH = 0.5;
    const Vector3d squares = positions.axes();
    return squares[1] > LEAST_WIDTH * squares[2];
  }

  /** \brief Whether some normals are on the other side of those of an edge's faces: of
   * the far face of a plate, or of a slot.
   */
  bool
  seesThirdFace (std::size_t count, const Vector3d& normal) const
  {
    constexpr double STRAY_COSINE = -0.3;
    constexpr double STRAY_PART = 0.1;
    std::size_t strays = 0;
    for (std::size_t i = 0; i < count; ++i)
      strays += normals_[i].dot (normal) < STRAY_COSINE ? 1 : 0;
    return static_cast<double> (strays) > STRAY_PART * static_cast<double> (count);
  }

  /** \brief Mean squared distance of the window from a cubic height function, for its
   * degrees of freedom.
   */
  double
  smoothResidual (std::size_t count, const Vector3d& normal) const
  {
    smooth_.set (
        0, normal, positions_[count - 1].norm(), count, [this] (std::size_t i) {
          return positions_[i];
        });
    smooth_.fit (static_cast<int> (count));
    return smooth_.meanSquare (0);
  }

  const OrientedPoints& points_;
  const SurfaceGraph& graph_;
  /** mean squared distance of the neighbours from two planes, in squared spacings */
  const double largest_square_;
  CubicResiduals& smooth_;
  index_t sample_ = 0;
  /** what was found, and squared distances and points of those that are no far side */
  std::vector<index_t> nearest_;
  std::vector<std::pair<double, index_t>> neighbors_;
  Coordinates positions_;
  Coordinates normals_;
  /** positions and normals of the nearest that were found */
  Coordinates of_sheets_;
  Coordinates normals_of_sheets_;
  /** of those in the window */
  Scatter all_;
  TwoPlanes planes_;
  CrossingPlanes crossing_;
  /** of the sample: mean squared distance of its noise window from a cubic, and the
   * smallest ratio so far */
  double of_noise_window_ = 0.0;
  double smallest_ratio_ = 1.0;
  /** of the best crease so far its window, and what its planes leave */
  std::size_t best_window_ = 0;
  double of_best_planes_ = 0.0;
  /** positions, as far as there are as many */
  Scatter in_noise_window_;
};

/** \brief Whether normals around a sample differ at all, or may do so across a gap in
 * the graph.
 */
bool
isWorthATry (const OrientedPoints& points, const SurfaceGraph& graph, index_t sample)
{
  // cos (2.6 degrees)
  constexpr float SAME_NORMAL = 0.999F;
  const Eigen::Vector3f& n = points.normals[sample];
  for (const index_t q : graph.star (sample)) {
    if (graph.boundary[q] != 0 || n.dot (points.normals[q]) < SAME_NORMAL)
      return true;
    for (const index_t r : graph.star (q))
      if (n.dot (points.normals[r]) < SAME_NORMAL)
        return true;
  }
  return graph.boundary[sample] != 0;
}

/** \brief Tests some samples at a time. */
class CreaseFinder : public LaneBatch<CreaseFinder> {
public:
  CreaseFinder (const OrientedPoints& points,
                const SurfaceGraph& graph,
                double largest_residual,
                std::vector<Crease>& creases)
  : creases_ (creases)
  , fitters_ (LANES, CreaseFitter (points, graph, largest_residual, smooth_))
  {}

  /** \brief Tests a sample together with others, at the latest when finish is called.
   * \param[in] found its neighbours
   */
  void
  add (index_t sample, const std::vector<index_t>& found)
  {
    fitters_[queued_].setNeighbors (sample, found);
    fitters_[queued_].describe (queued_);
    push();
  }

private:
  friend LaneBatch<CreaseFinder>;

  void
  run ()
  {
    std::array<SmoothResiduals, LANES> residuals;
    for (std::size_t w = 0; w < WINDOWS.size(); ++w) {
      smooth_.fit (WINDOWS[w]);
      for (int lane = 0; lane < queued_; ++lane)
        residuals[lane][w] = smooth_.meanSquare (lane);
    }
    for (int lane = 0; lane < queued_; ++lane)
      creases_[fitters_[lane].sample()] = fitters_[lane].fit (residuals[lane]);
  }

  std::vector<Crease>& creases_;
  CubicResiduals smooth_{CREASE_NEIGHBORS};
  std::vector<CreaseFitter> fitters_;
};

/** \brief Tests samples, and enters their creases. */
void
testSamples (const OrientedPoints& points,
             const SurfaceGraph& graph,
             const NeighborSearch& search,
             double largest_residual,
             const std::vector<index_t>& samples,
             const Workers& workers,
             std::vector<Crease>& creases)
{
  forEachBlock (
      samples.size(), workers, [&] (std::size_t, std::size_t first, std::size_t last) {
        CreaseFinder finder (points, graph, largest_residual, creases);
        std::vector<index_t> found;
        for (std::size_t i = first; i < last; ++i) {
          if (!isWorthATry (points, graph, samples[i]))
            continue;
          search (samples[i], found);
          finder.add (samples[i], found);
        }
        finder.finish();
      });
}

/** \brief The samples within two rings of those that have a crease, but for what is
 * tested already, ascending.
 * \param[in] samples to look around
 * \param[in,out] tested gets 1 for what is returned
 */
std::vector<index_t>
aroundCreases (const SurfaceGraph& graph,
               const std::vector<index_t>& samples,
               const std::vector<Crease>& creases,
               std::vector<std::uint8_t>& tested)
{
  std::vector<index_t> around;
  const auto add = [&] (index_t sample) {
    if (tested[sample] == 0)
      around.push_back (sample);
    tested[sample] = 1;
  };
  for (const index_t sample : samples)
    if (creases[sample].type != CrestType::NONE)
      for (const index_t q : graph.star (sample)) {
        add (q);
        for (const index_t r : graph.star (q))
          add (r);
      }
  std::sort (around.begin(), around.end());
  return around;
}

} // namespace

std::vector<Crease>
findCreases (const OrientedPoints& points,
             const SurfaceGraph& graph,
             const NeighborSearch& search,
             double largest_residual,
             const Workers& workers)
{
  // As many as suffice for the longest edges between centres that see it, wherever the
  // cloud is cut to tiles.
  constexpr int ROUNDS = 8;
  std::vector<Crease> creases = makeLarge (points.size(), Crease());
  std::vector<std::uint8_t> tested =
      chooseCentres (points.positions, points.normals, graph, workers);
  std::vector<index_t> samples;
  for (std::size_t i = 0; i < tested.size(); ++i)
    if (tested[i] != 0)
      samples.push_back (static_cast<index_t> (i));
  for (int round = 0; round < ROUNDS && !samples.empty(); ++round) {
    // The centres are about half of the work.
    if (workers.progress != nullptr)
      workers.progress->beginPart (std::min (round, 1), 2);
    testSamples (points, graph, search, largest_residual, samples, workers, creases);
    samples = aroundCreases (graph, samples, creases, tested);
  }
  return creases;
}

} // namespace crest
} // namespace pcl
