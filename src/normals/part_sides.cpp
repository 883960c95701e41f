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
  double area = 0.0;
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  double volume = 0.0;
  double largest_volume = 0.0;
  double facing = 0.0;
  float outward = 0.0F;

  bool
  isClosed () const
  {
    // Net normals of a closed surface vanish; a quarter leaves room for scans with
    // holes and uneven sampling. A hemisphere has one half, a height field nearly one.
    constexpr double MOST_OPEN = 0.25;
    constexpr double LEAST_VOLUME = 0.01;
    return normal.norm() < MOST_OPEN * area &&
           std::abs (volume) > LEAST_VOLUME * largest_volume;
  }

  /** \brief Whether nearly all of a part shows the same side to the viewpoint. */
  bool
  showsOneSide () const
  {
    constexpr double CLEAR_VOTE = 0.5;
    return std::abs (facing) > CLEAR_VOTE * area;
  }
};

std::vector<PartSums>
sumUp (const PlaneFits& fits,
       const SignedParts& parts,
       const std::optional<Eigen::Vector3f>& viewpoint)
{
  std::vector<PartSums> sums (parts.outward.size());
  for (std::size_t i = 0; i < sums.size(); ++i)
    sums[i].outward = parts.outward[i];
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
sideOf (const PartSums& part, const Eigen::Vector3d& up)
{
  // From here on rays decide, which are right about cavities, too.
  constexpr float CLEAR_RAYS = 0.3F;
  const bool rays_decide = std::abs (part.outward) > CLEAR_RAYS;
  if (part.area <= 0.0)
    return {};
  if (part.isClosed() && rays_decide)
    return {NormalSide::OUTWARD, part.outward < 0.0F, std::abs (part.outward)};
  if (part.isClosed()) {
    // Of a ball's volume, which is the largest of its area.
    const double share = std::abs (part.volume) / part.largest_volume;
    return {NormalSide::OUTWARD, part.volume < 0.0, static_cast<float> (share)};
  }
  if (part.showsOneSide())
    return {NormalSide::VIEWPOINT,
            part.facing < 0.0,
            static_cast<float> (std::abs (part.facing) / part.area)};
  const double rise = part.normal.dot (up) / part.area;
  return {NormalSide::UP, rise < 0.0, static_cast<float> (std::abs (rise))};
}

} // namespace

std::vector<PartSide>
decideSides (const PlaneFits& fits,
             const SignedParts& parts,
             const NormalHints& hints,
             bool& is_model_around)
{
  const std::vector<PartSums> sums = sumUp (fits, parts, hints.viewpoint);
  const auto has_area = [] (const PartSums& part) { return part.area > 0.0; };
  const auto first = std::find_if (sums.begin(), sums.end(), has_area);
  is_model_around = std::count_if (sums.begin(), sums.end(), has_area) == 1 &&
                    first->isClosed() && first->showsOneSide();
  std::vector<PartSide> sides;
  for (const PartSums& part : sums)
    sides.push_back (sideOf (part, hints.up.cast<double>().stableNormalized()));
  return sides;
}

} // namespace crest
} // namespace pcl
