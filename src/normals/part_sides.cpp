// SPDX-License-Identifier: BSD-3-Clause
#include "normals/part_sides.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace pcl {
namespace crest {

namespace {

/** \brief Sums over a part, weighted by area up to a factor. */
struct PartSums {
  std::size_t samples = 0;
  double area = 0.0;
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  double volume = 0.0;
  double largest_volume = 0.0;
  double facing = 0.0;
  float outward = 0.0F;
  /** of its samples that noise moves, their area and the kurtosis of their heights, and
   * of all how large the errors of their places are in spacings */
  double noisy_area = 0.0;
  double kurtosis = 0.0;
  double error = 0.0;

  /** \brief Whether its normals add up to nothing much, as those of a closed surface
   * do.
   */
  bool
  facesAllWays () const
  {
    return normal.norm() < MOST_OPEN * area;
  }

  bool
  isClosed () const
  {
    constexpr double LEAST_VOLUME = 0.01;
    return facesAllWays() && std::abs (volume) > LEAST_VOLUME * largest_volume;
  }

  /** \brief Whether nearly all of a part shows the same side to the viewpoint. */
  bool
  showsOneSide () const
  {
    constexpr double CLEAR_VOTE = 0.5;
    return std::abs (facing) > CLEAR_VOTE * area;
  }
};

/** \brief Whether an open part may as well be a closed one so thin that noise joins
 * both its sheets: their heights, of two clumps, have a kurtosis below that of noise,
 * which is 3, unless there is more noise than thickness.
 */
bool
mayBeTwoSheets (const PartSums& part)
{
  constexpr double LEAST_KURTOSIS = 2.6;
  constexpr double LARGEST_ERROR = 0.4;
  return part.error > LARGEST_ERROR * part.area ||
         (part.noisy_area > 0.5 * part.area &&
          part.kurtosis < LEAST_KURTOSIS * part.noisy_area);
}

std::vector<PartSums>
sumUp (const PlaneFits& fits,
       const SignedParts& parts,
       const std::optional<Eigen::Vector3f>& viewpoint)
{
  std::vector<PartSums> sums (parts.outward.size());
  for (std::size_t i = 0; i < sums.size(); ++i)
    sums[i].outward = parts.outward[i];
  constexpr float NOISY = 0.2F;
  for (std::size_t i = 0; i < fits.size(); ++i) {
    const float spacing = fits.spacing (i);
    if (parts.part[i] < 0 || !(spacing > 0.0F))
      continue;
    PartSums& sum = sums[parts.part[i]];
    const double area = fits.reach[i];
    sum.error += area * fits.errors[i] / spacing;
    if (fits.errors[i] > NOISY * spacing) {
      sum.noisy_area += area;
      sum.kurtosis += area * fits.kurtosis[i];
    }
  }
  const auto forEachSample = [&] (const auto& add) {
    for (std::size_t i = 0; i < fits.size(); ++i)
      if (parts.part[i] >= 0)
        add (sums[parts.part[i]],
             static_cast<double> (fits.reach[i]),
             fits.positions[i].cast<double>().eval(),
             parts.normals[i].cast<double>().eval());
  };
  forEachSample ([] (PartSums& sum,
                     double area,
                     const Eigen::Vector3d& position,
                     const Eigen::Vector3d& normal) {
    ++sum.samples;
    sum.area += area;
    sum.center += area * position;
    sum.normal += area * normal;
  });
  for (PartSums& sum : sums)
    if (sum.area > 0.0)
      sum.center /= sum.area;
  forEachSample ([&] (PartSums& sum,
                      double area,
                      const Eigen::Vector3d& position,
                      const Eigen::Vector3d& normal) {
    const Eigen::Vector3d arm = position - sum.center;
    sum.volume += area * normal.dot (arm);
    sum.largest_volume += area * arm.norm();
    if (viewpoint)
      sum.facing +=
          std::copysign (area, normal.dot (viewpoint->cast<double>() - position));
  });
  return sums;
}

PartSide
sideOf (const PartSums& part, const NormalHints& hints)
{
  // From here on rays decide, which are right about cavities, too.
  constexpr float CLEAR_RAYS = 0.3F;
  if (part.area <= 0.0)
    return {};
  const float rays = std::abs (part.outward);
  if (part.facesAllWays() && rays > CLEAR_RAYS)
    return {NormalSide::OUTWARD,
            part.outward < 0.0F,
            std::min (1.0F, SURE_SIGN * rays / CLEAR_RAYS)};
  if (part.isClosed()) {
    // A tenth of what it may be is more than what wrong signs leave of it.
    constexpr double SURE_SHARE = 0.1;
    const double share = std::abs (part.volume) / part.largest_volume;
    const double trust = mayBeTwoSheets (part) ? 0.0 : share / SURE_SHARE;
    return {NormalSide::OUTWARD,
            part.volume < 0.0,
            static_cast<float> (std::min (1.0, trust))};
  }
  if (part.showsOneSide())
    return {NormalSide::VIEWPOINT,
            part.facing < 0.0,
            std::min (static_cast<float> (std::abs (part.facing) / part.area),
                      hints.viewpoint_assumed ? A_GUESS : 1.0F)};
  // Surely upward is what faces that way on the whole, and clearly more than down.
  const Eigen::Vector3d up =
      hints.up.value_or (Eigen::Vector3f::UnitZ()).cast<double>().stableNormalized();
  const double rise = part.normal.dot (up);
  const double net = part.normal.norm();
  double trust = net > 0.0 ? std::abs (rise) / net : 0.0;
  trust *= std::min (1.0, net / (MOST_OPEN * part.area));
  if (part.samples < LEAST_PART || mayBeTwoSheets (part))
    trust = 0.0;
  return {NormalSide::UP,
          rise < 0.0,
          std::min (static_cast<float> (trust), hints.up ? 1.0F : A_GUESS)};
}

} // namespace

PartSides
decideSides (const PlaneFits& fits, const SignedParts& parts, const NormalHints& hints)
{
  // Beside debris.
  constexpr double NEARLY_ALL = 0.9;
  constexpr double MOSTLY = 0.5;
  const std::vector<PartSums> sums = sumUp (fits, parts, hints.viewpoint);
  PartSides sides;
  double area = 0.0;
  double shown = 0.0;
  const PartSums* largest = nullptr;
  for (const PartSums& part : sums) {
    sides.of_parts.push_back (sideOf (part, hints));
    area += part.area;
    shown += std::abs (part.facing);
    if (largest == nullptr || part.area > largest->area)
      largest = &part;
  }
  const bool is_model_around = largest != nullptr &&
                               largest->area > NEARLY_ALL * area &&
                               largest->isClosed() && largest->showsOneSide();
  sides.may_be_view = !is_model_around && shown > MOSTLY * area;
  return sides;
}

} // namespace crest
} // namespace pcl
