// SPDX-License-Identifier: BSD-3-Clause
// All parameters of the method, with their defaults and units, in one place.
#pragma once

#include <pcl_crest/types.h>

#include <optional>
#include <string>
#include <vector>

namespace pcl {
namespace crest {

/** \brief A threshold that ridges and valleys have each their own value of, because
 * their curvatures are distributed differently (paper, section 5).
 */
template <typename T>
struct PerType {
  T ridge;
  T valley;

  const T&
  operator[] (CrestType type) const
  {
    return type == CrestType::RIDGE ? ridge : valley;
  }
  T&
  operator[] (CrestType type)
  {
    return type == CrestType::RIDGE ? ridge : valley;
  }
};

/** \brief What the method does where the paper and what people draw differ. */
enum class Preset : std::uint8_t {
  /** the paper's method: one fixed scale, the threshold M */
  PAPER,
  /** the paper's stages with the scale and the significance found by statistics */
  AUTO
};

/** \brief Where lines run. */
enum class Positions : std::uint8_t {
  /** where curvature has its maximum, between the samples */
  CREST,
  /** from sample to sample */
  SAMPLES
};

/** \brief The most neighbours that the filter chooses from, by k or within a radius:
 * more than a thousand for eight places are a mistake, and take hours. */
constexpr int MOST_NEIGHBORS = 1000;

/** More threads than any machine has: OpenMP may end the process where it cannot have
 * its threads. */
constexpr unsigned MOST_THREADS = 1024;

/** \brief The parameters of the crest line extraction. The Feature's setters and the
 * tools' options fill this struct; no default is stated anywhere else.
 */
struct Parameters {
  /** Which of the thresholds below are in use: maximality, absolute_maximality and
   * prune belong to PAPER, angle, min_length, confidence and positions to AUTO, and all
   * others to both. One of the other preset that is not at its default is a mistake. */
  Preset preset = Preset::AUTO;

  /** k of the k closest neighbours that the quadrant filter chooses from (4.1); the
   * query point counts as one of them, as in every PCL feature. Ignored where radius
   * is positive. docs/method.md has the measurement behind the default. */
  int k = 24;

  /** Search radius in the cloud's unit; 0 searches for k neighbours instead. One that
   * holds more than MOST_NEIGHBORS around a point is a mistake. */
  double radius = 0.0;

  /** Whether the k neighbours are found by the library's own search, leaf by leaf,
   * several times as fast as PCL's KdTree; the result is the same. A radius search, and
   * one set by the user, are not concerned. Where there is no PCL, it is used anyway.
   */
  bool batched_search = false;

  /** Neighbours kept in each quadrant of the tangent plane, one for each interval of
   * 90 / points_per_quadrant degrees (4.1). */
  int points_per_quadrant = 2;

  /** Largest angle between the normals of two neighbours, in degrees: a larger jump
   * means another sheet of the surface (4.1). */
  double max_normal_angle = 90.0;

  /** M of section 4.3: how much k1^2 has to exceed that of the neighbours on either
   * side. Unit: 1 / length^2, the unit of length being a tenth of the largest side of
   * the cloud's bounding box, or the cloud's own unit where absolute_maximality. */
  PerType<double> maximality{0.01, 0.01};

  /** Whether maximality is in 1 / (the cloud's unit)^2. */
  bool absolute_maximality = false;

  /** Branches of up to this many points are pruned (4.6). */
  int prune = 10;

  /** S of section 4.7: lines of fewer points are removed. Unset it is 10 for PAPER and
   * 0 for AUTO, which judges length by min_length (see minSize). */
  PerType<std::optional<int>> min_size;

  /** Lines of less strength are removed: the integral of |k1| along a line, a number
   * without unit (Yoshizawa et al. 2005). */
  double min_strength = 0.0;

  /** How far the surface at least turns across a line, on its average, in degrees.
   * Below 25, lines may be lower, too. */
  double angle = 25.0;

  /** Least length of a line, in spacings of the samples along it. */
  double min_length = 5.0;

  /** How many standard errors the curvature of a crest point has to fall off to both
   * sides; lines as a whole have to be as many times more certain. */
  double confidence = 2.0;

  /** Where the lines of AUTO run; those of PAPER run from sample to sample. */
  Positions positions = Positions::CREST;

  /** Which types to label and to draw lines of. */
  PerType<bool> wanted{true, true};

  /** Whether to label the points where the surface ends (4.1). */
  bool boundaries = false;

  /** Threads of all stages; 0 takes all processors. The result does not depend on it.
   */
  unsigned threads = 0;
};

/** \brief The threshold M in 1 / (the cloud's unit)^2.
 *
 * M compares squared curvatures, so that a bare number means something only with its
 * unit of length. The paper names none; its figure 8 comes out with the cloud scaled to
 * a largest bounding box side of 10, which is therefore the unit unless
 * absolute_maximality: the labels are then the same in metres and in millimetres.
 *
 * \param[in] parameters maximality and absolute_maximality are used
 * \param[in] extent largest side of the bounding box of the cloud's valid points
 */
PCL_CREST_EXPORT PerType<double>
absoluteMaximality (const Parameters& parameters, double extent);

/** \brief All presets, the default first. */
PCL_CREST_EXPORT std::vector<Preset>
presets ();

/** \brief The name of a preset for users, in options and files: "auto" or "paper". */
PCL_CREST_EXPORT std::string
nameOf (Preset preset);

/** \brief S for one type, as it is set or as the preset has it. */
PCL_CREST_EXPORT int
minSize (const Parameters& parameters, CrestType type);

/** \brief What is wrong with the parameters, in words for the user: the parameter, its
 * value, and what would be right. Empty if all is well.
 */
PCL_CREST_EXPORT std::string
explainInvalid (const Parameters& parameters);

} // namespace crest
} // namespace pcl
