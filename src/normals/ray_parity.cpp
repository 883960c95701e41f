// SPDX-License-Identifier: BSD-3-Clause
#include "normals/ray_parity.h"

#include <algorithm>
#include <array>
#include <limits>

namespace pcl {
namespace crest {

namespace {

constexpr int DIRECTIONS = 32;

/** \brief Directions spread evenly over the sphere, along a spiral of golden angles. */
std::array<Eigen::Vector3f, DIRECTIONS>
makeDirections ()
{
  constexpr double GOLDEN_ANGLE = 2.399963229728653;
  // Off the axes, along which so many surfaces run.
  constexpr double START = 0.3;
  std::array<Eigen::Vector3f, DIRECTIONS> directions;
  for (int i = 0; i < DIRECTIONS; ++i) {
    const double z = 1.0 - 2.0 * (i + 0.5) / DIRECTIONS;
    const double r = std::sqrt (1.0 - z * z);
    const double angle = i * GOLDEN_ANGLE + START;
    directions[i] =
        Eigen::Vector3d (r * std::cos (angle), r * std::sin (angle), z).cast<float>();
  }
  return directions;
}

} // namespace

RayParity::RayParity (const PlaneFits& fits) : fits_ (fits)
{
  // In spacings: so that the discs of a sheet leave no holes.
  constexpr float RADIUS = 1.7F;
  discs_.reserve (fits.size());
  for (std::size_t i = 0; i < fits.size(); ++i)
    discs_.push_back ({fits.feet[i], fits.normals[i], RADIUS * fits.spacing (i)});

  const auto group = [] (std::size_t count, const auto& boxOf) {
    std::vector<Box> boxes;
    for (std::size_t first = 0; first < count; first += CHILDREN) {
      Box box;
      box.low.setConstant (std::numeric_limits<float>::infinity());
      box.high = -box.low;
      for (std::size_t i = first; i < std::min (count, first + CHILDREN); ++i) {
        const Box child = boxOf (i);
        box.low = box.low.min (child.low);
        box.high = box.high.max (child.high);
      }
      boxes.push_back (box);
    }
    return boxes;
  };
  levels_.push_back (group (discs_.size(), [this] (std::size_t i) {
    const Disc& disc = discs_[i];
    return Box{disc.center.array() - disc.radius, disc.center.array() + disc.radius};
  }));
  while (levels_.back().size() > CHILDREN) {
    const std::vector<Box>& below = levels_.back();
    levels_.push_back (
        group (below.size(), [&below] (std::size_t i) { return below[i]; }));
  }
}

bool
RayParity::findHits (const Eigen::Vector3f& from,
                     const Eigen::Vector3f& direction,
                     std::vector<Hit>& hits) const
{
  constexpr float ALONG = 0.05F;
  hits.clear();
  bool runs_along_none = true;
  const auto meet = [&] (const Disc& disc) {
    const float cosine = disc.normal.dot (direction);
    const Eigen::Vector3f arm = disc.center - from;
    const float squared_radius = disc.radius * disc.radius;
    if (std::abs (cosine) < ALONG) {
      const float distance = arm.dot (direction);
      if (distance > 0.0F && arm.squaredNorm() - distance * distance < squared_radius)
        runs_along_none = false;
      return;
    }
    const float distance = disc.normal.dot (arm) / cosine;
    if (distance > 0.0F && (distance * direction - arm).squaredNorm() < squared_radius)
      hits.push_back ({distance, std::abs (cosine)});
  };

  struct Range {
    std::size_t level, first, last;
  };
  // All siblings wait on each of the levels, which are no more than 11.
  std::array<Range, 11 * CHILDREN> waiting;
  std::size_t count = 0;
  waiting[count++] = {levels_.size() - 1, 0, levels_.back().size()};
  const Eigen::Array3f inverse = direction.array().inverse();
  while (count != 0) {
    const Range range = waiting[--count];
    for (std::size_t b = range.first; b < range.last; ++b) {
      const Box& box = levels_[range.level][b];
      const Eigen::Array3f to_low = (box.low - from.array()) * inverse;
      const Eigen::Array3f to_high = (box.high - from.array()) * inverse;
      const float in = to_low.min (to_high).maxCoeff();
      const float out = to_low.max (to_high).minCoeff();
      if (out < std::max (in, 0.0F))
        continue;
      const std::size_t below =
          range.level == 0 ? discs_.size() : levels_[range.level - 1].size();
      const std::size_t first = b * CHILDREN;
      const std::size_t last = std::min (first + CHILDREN, below);
      if (range.level != 0)
        waiting[count++] = {range.level - 1, first, last};
      else
        std::for_each (discs_.begin() + static_cast<std::ptrdiff_t> (first),
                       discs_.begin() + static_cast<std::ptrdiff_t> (last),
                       meet);
    }
  }
  return runs_along_none;
}

RayParity::Sheets
RayParity::countSheets (const Eigen::Vector3f& from,
                        const Eigen::Vector3f& direction,
                        float spacing) const
{
  constexpr float DOUBT = 0.3F;
  constexpr float FLAT_DOUBT = 0.4F;
  constexpr float STEEP = 0.3F;
  // A sheet is hit by several of its discs.
  constexpr std::size_t FEW = 3;
  // In spacings across the sheet: gaps within the hits of one, and all of these.
  constexpr float GAP = 0.5F;
  constexpr float SHEET = 1.5F;
  thread_local std::vector<Hit> hits;
  Sheets sheets;
  if (!findHits (from, direction, hits))
    sheets.certainty *= DOUBT;
  std::sort (hits.begin(), hits.end(), [] (const Hit& a, const Hit& b) {
    return a.distance != b.distance ? a.distance < b.distance : a.cosine < b.cosine;
  });
  for (std::size_t i = 0; i < hits.size();) {
    const float width = spacing / std::max (STEEP, hits[i].cosine);
    std::size_t end = i + 1;
    while (end < hits.size() &&
           hits[end].distance - hits[end - 1].distance < GAP * width &&
           hits[end].distance - hits[i].distance < SHEET * width)
      ++end;
    if (end - i < FEW)
      sheets.certainty *= DOUBT;
    if (hits[i].cosine < STEEP)
      sheets.certainty *= FLAT_DOUBT;
    ++sheets.count;
    i = end;
  }
  return sheets;
}

float
RayParity::vote (std::size_t sample) const
{
  static const std::array<Eigen::Vector3f, DIRECTIONS> directions = makeDirections();
  // To each side; so many of 32 are there, whatever the normal.
  constexpr int RAYS = 6;
  constexpr float STEEP = 0.35F;
  // Prime to their number, so that neighbours begin elsewhere and all are tried.
  constexpr std::size_t STRIDE = 7;
  const Eigen::Vector3f& normal = fits_.normals[sample];
  const float spacing = fits_.spacing (sample);
  // Off the sample's own sheet, as far as noise may move that.
  const float start = std::max (0.5F * spacing, 3.0F * fits_.errors[sample]);

  struct Side {
    int rays = 0;
    float inside = 0.0F;
    float certainty = 1e-3F;
  };
  Side front;
  Side back;
  for (std::size_t k = 0; k < DIRECTIONS; ++k) {
    const Eigen::Vector3f& direction = directions[(STRIDE * k + sample) % DIRECTIONS];
    const float cosine = direction.dot (normal);
    Side& side = cosine < 0.0F ? back : front;
    if (std::abs (cosine) < STEEP || side.rays == RAYS)
      continue;
    ++side.rays;
    const Eigen::Vector3f from =
        fits_.feet[sample] + std::copysign (start, cosine) * normal;
    const Sheets sheets = countSheets (from, direction, spacing);
    side.inside += sheets.count % 2 != 0 ? sheets.certainty : -sheets.certainty;
    side.certainty += sheets.certainty;
  }
  return 0.5F * (back.inside / back.certainty - front.inside / front.certainty);
}

} // namespace crest
} // namespace pcl
