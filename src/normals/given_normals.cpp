// SPDX-License-Identifier: BSD-3-Clause
#include "normals/given_normals.h"

#include <Eigen/Geometry>

#include "base/parallel.h"
#include "normals/consistent_signs.h"
#include "normals/part_sides.h"
#include "normals/scaled_hints.h"
#include "normals/sharp_normals.h"
#include "normals/sign_votes.h"
#include "search/leaf_search.h"
#include "search/position_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace pcl {
namespace crest {

namespace {

/** \brief The index of the sample at a place. */
std::size_t
indexAt (const PointTree& tree, std::size_t place)
{
  return static_cast<std::size_t> (tree.index (static_cast<std::int32_t> (place)));
}

/** \brief The axes that the given normals of the points at each position have together,
 * with the sign of the first; zero where none is usable.
 */
std::vector<Eigen::Vector3f>
axesOf (const PointView& cloud, const DistinctPoints& distinct)
{
  std::vector<Eigen::Vector3f> axes;
  axes.reserve (distinct.positions.size());
  for (std::size_t p = 0; p + 1 < distinct.begins.size(); ++p) {
    Eigen::Vector3f sum = Eigen::Vector3f::Zero();
    for (std::size_t i = distinct.begins[p]; i < distinct.begins[p + 1]; ++i) {
      const auto point = static_cast<std::size_t> (distinct.points[i].cloud_index);
      if (!isUsable (cloud.normalOf (point)))
        continue;
      const Eigen::Vector3f normal = unitNormalOf (cloud, point).cast<float>();
      sum += sum.dot (normal) < 0.0F ? (-normal).eval() : normal;
    }
    axes.push_back (sum.stableNormalized());
  }
  return axes;
}

/** \brief How many normals contradict that of the next sample along a curve.
 *
 * \param[in] order the samples along it
 */
std::size_t
countContradictions (const DistinctPoints& distinct,
                     const std::vector<Eigen::Vector3f>& axes,
                     const std::vector<index_t>& order)
{
  constexpr float CONTRADICTION = -0.5F;
  // The curve jumps: what counts is a step as short as one of those beside it.
  constexpr float SHORT = 4.0F;
  std::size_t found = 0;
  float before = std::numeric_limits<float>::infinity();
  for (std::size_t i = 0; i + 1 < order.size(); ++i) {
    const Eigen::Vector3f chord =
        distinct.positions[order[i + 1]] - distinct.positions[order[i]];
    const float step = chord.squaredNorm();
    if (step <= SHORT * before &&
        agreementOf (axes[order[i]], axes[order[i + 1]], chord, 0.0F) < CONTRADICTION)
      ++found;
    before = step;
  }
  return found;
}

/** \brief Whether more than a few normals contradict that of the next sample along a
 * curve. A patch that is turned over has a border, which grows with the root of the
 * number of samples. A border along a middle of the box, as of a half that was
 * mirrored, no curve through the cells of the box crosses in a short step: a second one
 * is turned against it.
 */
bool
seemContradictory (const DistinctPoints& distinct,
                   const std::vector<Eigen::Vector3f>& axes,
                   const Workers& workers)
{
  constexpr double LEAST = 2.0;
  constexpr double OF_ROOT = 0.05;
  const double few = LEAST + OF_ROOT * std::sqrt (static_cast<double> (axes.size()));
  std::vector<index_t> order (axes.size());
  std::iota (order.begin(), order.end(), 0);
  if (static_cast<double> (countContradictions (distinct, axes, order)) > few)
    return true;
  const Eigen::Matrix3f turn =
      Eigen::AngleAxisf (1.0F, Eigen::Vector3f (1.0F, 2.0F, 3.0F).normalized())
          .toRotationMatrix();
  std::vector<CurvePoint> turned;
  turned.reserve (axes.size());
  for (const index_t i : order)
    turned.push_back ({0, turn * distinct.positions[i], i});
  sortAlongCurve (turned, workers);
  for (std::size_t i = 0; i < order.size(); ++i)
    order[i] = turned[i].cloud_index;
  return static_cast<double> (countContradictions (distinct, axes, order)) > few;
}

/** \brief Whether normals look, on the whole, to the middle of the samples from all
 * around.
 */
bool
lookInward (const DistinctPoints& distinct, const std::vector<Eigen::Vector3f>& axes)
{
  constexpr double CLEARLY = 0.2;
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3f& position : distinct.positions)
    middle += position.cast<double>() / static_cast<double> (axes.size());
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double outward = 0.0;
  double count = 0.0;
  for (std::size_t i = 0; i < axes.size(); ++i) {
    const Eigen::Vector3d axis = axes[i].cast<double>();
    sum += axis;
    outward +=
        axis.dot ((distinct.positions[i].cast<double>() - middle).stableNormalized());
    count += axis.squaredNorm();
  }
  return sum.norm() < MOST_OPEN * count && outward < -CLEARLY * count;
}

/** \brief Whether many of the given normals stand across flat windows: whatever these
 * numbers are, they are no normals.
 */
bool
standAcross (const PointTree& tree,
             const PlaneFits& fits,
             const std::vector<Eigen::Vector3f>& axes)
{
  constexpr double MANY = 1.0 / 3.0;
  constexpr float FLAT = 0.1F;
  constexpr float ACROSS = 0.5F;
  double flat = 0.0;
  double across = 0.0;
  for (std::size_t place = 0; place < fits.size(); ++place) {
    const Eigen::Vector3f& axis = axes[indexAt (tree, place)];
    if (axis.isZero (0.0F) || fits.plain[place].isZero (0.0F) ||
        fits.sigmas[place] > FLAT * fits.radii[place])
      continue;
    flat += 1.0;
    across += std::abs (axis.dot (fits.plain[place])) < ACROSS ? 1.0 : 0.0;
  }
  return across > MANY * flat;
}

/** \brief Puts the given normals in the place of those of the windows.
 * \param[in] axes by the indices of the tree's points
 */
void
adopt (const PointTree& tree, const std::vector<Eigen::Vector3f>& axes, PlaneFits& fits)
{
  constexpr float ALONG = 0.7F;
  for (std::size_t place = 0; place < fits.size(); ++place) {
    const Eigen::Vector3f& axis = axes[indexAt (tree, place)];
    if (axis.isZero (0.0F))
      continue;
    const float cosine = axis.dot (fits.normals[place]);
    // Where a window is divided is known along its own normal.
    if (std::abs (cosine) < ALONG)
      fits.middles[place] = 0.0F;
    else if (cosine < 0.0F)
      fits.middles[place] = -fits.middles[place];
    fits.normals[place] = axis;
  }
}

/** \brief Where normals that are opposite as given, but not any more, stood back to
 * back, as on the two sides of a thin part: samples in groups of consecutive ones.
 * There noise hides from votes what the given signs know.
 *
 * \param[in] fits with the given normals
 * \param[in] turned of each of these
 */
std::vector<std::uint8_t>
findBackToBack (const PointTree& tree,
                const PlaneFits& fits,
                const std::vector<std::uint8_t>& turned,
                const Workers& workers)
{
  constexpr std::size_t GROUP = 256;
  static_assert (BLOCK_SIZE % GROUP == 0, "groups must not straddle blocks");
  constexpr float OPPOSITE = -0.7F;
  // Of the root mean square, more than chance brings about.
  constexpr double SIGNIFICANT = 0.25;
  // Of the distance of the two.
  constexpr double DEEP = 0.15;
  std::vector<std::uint8_t> back_to_back (fits.size(), 0);
  forEachBlock (
      fits.size(), workers, [&] (std::size_t, std::size_t first, std::size_t last) {
        LeafSearch search (tree, {PlaneFits::NEAREST});
        for (; first < last; first += GROUP) {
          const std::size_t end = std::min (first + GROUP, last);
          double pairs = 0.0;
          double depths = 0.0;
          double squared_depths = 0.0;
          double squared_chords = 0.0;
          for (std::size_t leaf = first; leaf < end; leaf += LEAF_SIZE) {
            const LeafNeighbors& found = search.searchLeaf (leaf / LEAF_SIZE);
            for (int i = 0; i < found.count; ++i) {
              const auto a =
                  static_cast<std::size_t> (found.first) + static_cast<std::size_t> (i);
              for (std::size_t j = found.offsets[i]; j < found.offsets[i + 1]; ++j) {
                const auto b = static_cast<std::size_t> (found.places[j]);
                if (turned[a] == turned[b] ||
                    fits.normals[a].dot (fits.normals[b]) > OPPOSITE)
                  continue;
                const Eigen::Vector3f chord = fits.positions[b] - fits.positions[a];
                const double depth =
                    0.5 * chord.dot (fits.normals[b] - fits.normals[a]);
                pairs += 1.0;
                depths += depth;
                squared_depths += depth * depth;
                squared_chords += chord.squaredNorm();
              }
            }
          }
          if (depths > SIGNIFICANT * std::sqrt (pairs * squared_depths) &&
              depths > DEEP * std::sqrt (pairs * squared_chords))
            std::fill (back_to_back.begin() + static_cast<std::ptrdiff_t> (first),
                       back_to_back.begin() + static_cast<std::ptrdiff_t> (end),
                       std::uint8_t{1});
        }
      });
  return back_to_back;
}

/** \brief What is so in most places of a part is so in all of it. */
void
spreadOverParts (const ConsistentSigns& signs, std::vector<std::uint8_t>& marks)
{
  std::vector<std::size_t> samples (signs.outward.size(), 0);
  std::vector<std::size_t> marked (signs.outward.size(), 0);
  for (std::size_t i = 0; i < marks.size(); ++i)
    if (signs.part[i] >= 0) {
      ++samples[signs.part[i]];
      marked[signs.part[i]] += marks[i];
    }
  for (std::size_t i = 0; i < marks.size(); ++i)
    if (signs.part[i] >= 0 && 2 * marked[signs.part[i]] > samples[signs.part[i]])
      marks[i] = 1;
}

/** \brief The side of a part, beside that which its samples have after they were made
 * consistent.
 */
struct GivenSide {
  bool turned = false;
  /** below SURE_SIGN where the given normals are divided and nothing else tells it */
  float trust = 1.0F;
};

/** \brief The sides that most of the given normals of each part have, or, where these
 * are few or divided, that estimated ones would have.
 */
std::vector<GivenSide>
sidesOf (const PointTree& tree,
         const std::vector<Eigen::Vector3f>& axes,
         const PlaneFits& fits,
         const ConsistentSigns& signs,
         const NormalHints& hints)
{
  constexpr double DIVIDED = 1.0 / 3.0;
  // Of the samples of a part how many have to have a normal to speak for all.
  constexpr double LEAST_SHARE = 0.1;
  std::vector<double> balance (signs.outward.size(), 0.0);
  std::vector<double> given (signs.outward.size(), 0.0);
  std::vector<double> samples (signs.outward.size(), 0.0);
  SignedParts parts{fits.normals, signs.part, signs.outward};
  for (std::size_t place = 0; place < tree.size; ++place) {
    const bool is_turned = signs.turned[place] != 0;
    if (is_turned)
      parts.normals[place] = -parts.normals[place];
    const index_t part = signs.part[place];
    if (part < 0)
      continue;
    samples[part] += 1.0;
    if (axes[indexAt (tree, place)].isZero (0.0F))
      continue;
    balance[part] += is_turned ? -1.0 : 1.0;
    given[part] += 1.0;
  }
  const PartSides estimated = decideSides (fits, parts, hints);
  std::vector<GivenSide> sides;
  for (std::size_t part = 0; part < balance.size(); ++part)
    if (given[part] >= LEAST_SHARE * samples[part] &&
        std::abs (balance[part]) > DIVIDED * given[part])
      sides.push_back ({balance[part] < 0.0});
    else
      sides.push_back (
          {estimated.of_parts[part].turned, estimated.of_parts[part].trust});
  return sides;
}

/** \brief What the surroundings say of the normals at a place. */
struct Verdict {
  /** that they should be, and how sure its sign is, and the side of its part */
  Eigen::Vector3f normal;
  float trust;
  float side_trust;
  /** whether it counts against a given one */
  bool is_sure;
};

/** \brief Enters what becomes of the normal of a point.
 *
 * \param[in] replaces whether no given normal counts
 */
void
judge (std::size_t point, const Verdict& verdict, bool replaces, NormalCheck& check)
{
  Eigen::Vector3f& given = check.normals[point];
  check.trust[point] = std::min (verdict.trust, verdict.side_trust);
  if (verdict.side_trust < SURE_SIGN)
    ++check.findings.guessed;
  if (replaces)
    given = verdict.normal;
  else if (!isUsable (given)) {
    if (!verdict.is_sure)
      return;
    given = verdict.normal;
    ++check.findings.filled;
  }
  else if (given.dot (verdict.normal) < 0.0F) {
    if (verdict.is_sure)
      given = -given;
    else
      check.trust[point] = std::min (check.trust[point], A_GUESS);
    ++(verdict.is_sure ? check.findings.turned : check.findings.doubtful);
  }
}

/** \brief Turns, fills and counts. Returns whether no given normal counted. */
bool
repair (const PointView& cloud,
        const DistinctPoints& distinct,
        std::vector<Eigen::Vector3f> axes,
        const NormalHints& hints,
        const Workers& workers,
        NormalCheck& check)
{
  constexpr int NEIGHBORS = 24;
  const std::shared_ptr<const PointTree> tree =
      treeOver (distinct.positions, workers.threads);
  PlaneFits fits = fitPlanes (*tree, NEIGHBORS, workers);
  sharpenNormals (*tree, fits, workers);
  const bool replaces = standAcross (*tree, fits, axes);
  if (replaces)
    axes.assign (axes.size(), Eigen::Vector3f::Zero());
  adopt (*tree, axes, fits);
  const ConsistentSigns signs =
      findConsistentSigns (findVotes (*tree, fits, workers), fits, workers);
  std::vector<std::uint8_t> back_to_back =
      findBackToBack (*tree, fits, signs.turned, workers);
  spreadOverParts (signs, back_to_back);
  const std::vector<GivenSide> sides =
      sidesOf (*tree, axes, fits, signs, hintsFor (hints, distinct, tree->unit));
  turnBy (signs, fits);
  // Those of windows average over edges what the nearest tell.
  std::vector<Eigen::Vector3f> normals = signedNormals (*tree, fits, workers);

  check.normals.resize (cloud.size);
  for (std::size_t i = 0; i < cloud.size; ++i)
    check.normals[i] = cloud.normalOf (i);
  check.trust.assign (cloud.size, 0.0F);
  for (std::size_t place = 0; place < tree->size; ++place) {
    const index_t part = signs.part[place];
    if (part < 0)
      continue;
    const std::size_t position = indexAt (*tree, place);
    if (!axes[position].isZero (0.0F))
      normals[place] = fits.normals[place];
    const Verdict verdict{sides[part].turned ? (-normals[place]).eval()
                                             : normals[place],
                          signs.trust[place],
                          sides[part].trust,
                          signs.trust[place] >= SURE_SIGN && back_to_back[place] == 0};
    for (std::size_t i = distinct.begins[position]; i < distinct.begins[position + 1];
         ++i)
      judge (static_cast<std::size_t> (distinct.points[i].cloud_index),
             verdict,
             replaces,
             check);
  }
  return replaces;
}

} // namespace

NormalCheck
checkNormals (const PointView& cloud, const NormalHints& hints, const Workers& workers)
{
  constexpr float UNIT = 0.01F;
  NormalCheck check;
  std::size_t usable = 0;
  for (std::size_t i = 0; i < cloud.size; ++i) {
    if (!cloud.positionOf (i).allFinite())
      continue;
    const Eigen::Vector3f normal = cloud.normalOf (i);
    if (!isUsable (normal)) {
      ++check.findings.missing;
      continue;
    }
    ++usable;
    if (std::abs (normal.stableNorm() - 1.0F) > UNIT)
      ++check.findings.not_unit;
  }
  const DistinctPoints distinct = takeDistinct (cloud, workers.threads);
  const std::vector<Eigen::Vector3f> axes = axesOf (cloud, distinct);
  const bool is_suspect =
      check.findings.missing != 0 || seemContradictory (distinct, axes, workers);
  if (is_suspect && repair (cloud, distinct, axes, hints, workers, check))
    check.findings.across = usable;
  else if (lookInward (distinct, axes))
    check.findings.inward = usable;
  return check;
}

bool
hasNormals (const PointView& cloud)
{
  for (std::size_t i = 0; i < cloud.size; ++i)
    if (cloud.positionOf (i).allFinite() && isUsable (cloud.normalOf (i)))
      return true;
  return false;
}

std::string
explainFindings (const NormalFindings& findings)
{
  std::string words;
  const auto add = [&words] (std::size_t count, const std::string& what) {
    if (count != 0)
      words += (words.empty() ? "Normals: " : "; ") + std::to_string (count) + what;
  };
  add (findings.across,
       " that stand across the surface around them, as numbers of another meaning do: "
       "all "
       "estimated in their place");
  if (findings.across == 0) {
    add (findings.not_unit, " not of unit length, used as directions");
    add (findings.filled, " zero or not finite, estimated in their place");
    add (findings.missing - findings.filled,
         " zero or not finite, without a sure one in their place: left out");
  }
  add (findings.turned, " against those around them, turned over");
  add (findings.doubtful,
       " perhaps on the wrong side, used as they are, as it is not sure");
  add (findings.guessed,
       " of parts without a majority for a side: it is a guess, and ridges and valleys "
       "may be swapped there");
  add (
      findings.inward,
      " look from all around to the middle: right for a room, but of a body ridges and "
      "valleys are swapped");
  return words;
}

} // namespace crest
} // namespace pcl
