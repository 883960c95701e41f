// SPDX-License-Identifier: BSD-3-Clause
#include "normals/ray_parity.h"

#include <Eigen/Geometry>

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
  using Box = Eigen::AlignedBox3f;
  std::vector<Box> boxes;
  discs_.resize ((fits.size() + CHILDREN - 1) / CHILDREN);
  boxes.resize (discs_.size());
  for (std::size_t i = 0; i < fits.size(); ++i) {
    const float radius = RADIUS * fits.spacing (i);
    Discs& discs = discs_[i / CHILDREN];
    const std::size_t child = i % CHILDREN;
    for (int axis = 0; axis < 3; ++axis) {
      discs.center[axis][child] = fits.feet[i][axis];
      discs.normal[axis][child] = fits.normals[i][axis];
    }
    discs.squared_radius[child] = radius * radius;
    const Eigen::Vector3f reach = Eigen::Vector3f::Constant (radius);
    boxes[i / CHILDREN].extend (Box (fits.feet[i] - reach, fits.feet[i] + reach));
  }
  do {
    std::vector<Boxes> level ((boxes.size() + CHILDREN - 1) / CHILDREN);
    std::vector<Box> around (level.size());
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      Boxes& group = level[i / CHILDREN];
      for (int axis = 0; axis < 3; ++axis) {
        group.low[axis][i % CHILDREN] = boxes[i].min()[axis];
        group.high[axis][i % CHILDREN] = boxes[i].max()[axis];
      }
      around[i / CHILDREN].extend (boxes[i]);
    }
    levels_.push_back (std::move (level));
    boxes = std::move (around);
  }
  while (boxes.size() > 1);
}

bool
RayParity::meet (const Ray& ray, const Discs& discs, std::vector<Hit>& hits)
{
  constexpr float ALONG = 0.05F;
  const float dx = ray.direction.x();
  const float dy = ray.direction.y();
  const float dz = ray.direction.z();
  // Along the ray, where it is nearest to the centers, and how far off it is there.
  float distances[CHILDREN];
  float offsets[CHILDREN];
#pragma omp simd
  for (std::size_t i = 0; i < CHILDREN; ++i) {
    const float x = discs.center[0][i] - ray.from.x();
    const float y = discs.center[1][i] - ray.from.y();
    const float z = discs.center[2][i] - ray.from.z();
    const float distance = x * dx + y * dy + z * dz;
    const float off_x = distance * dx - x;
    const float off_y = distance * dy - y;
    const float off_z = distance * dz - z;
    distances[i] = distance;
    offsets[i] = off_x * off_x + off_y * off_y + off_z * off_z;
  }
  bool runs_along_none = true;
  for (std::size_t i = 0; i < CHILDREN; ++i) {
    if (!(offsets[i] < discs.squared_radius[i]))
      continue;
    const Eigen::Vector3f normal (
        discs.normal[0][i], discs.normal[1][i], discs.normal[2][i]);
    const float cosine = normal.dot (ray.direction);
    if (std::abs (cosine) < ALONG) {
      if (distances[i] > 0.0F)
        runs_along_none = false;
      continue;
    }
    const Eigen::Vector3f arm =
        Eigen::Vector3f (discs.center[0][i], discs.center[1][i], discs.center[2][i]) -
        ray.from;
    const float distance = normal.dot (arm) / cosine;
    if (distance > 0.0F &&
        (distance * ray.direction - arm).squaredNorm() < discs.squared_radius[i])
      hits.push_back ({distance, std::abs (cosine)});
  }
  return runs_along_none;
}

unsigned
RayParity::meet (const Ray& ray, const Boxes& boxes)
{
  float in[CHILDREN] = {};
  float out[CHILDREN];
  std::fill_n (out, CHILDREN, std::numeric_limits<float>::infinity());
  for (int axis = 0; axis < 3; ++axis) {
    const float from = ray.from[axis];
    const float inverse = 1.0F / ray.direction[axis];
    const float* const low = boxes.low[axis];
    const float* const high = boxes.high[axis];
#pragma omp simd
    for (std::size_t i = 0; i < CHILDREN; ++i) {
      const float to_low = (low[i] - from) * inverse;
      const float to_high = (high[i] - from) * inverse;
      const float nearer = to_low < to_high ? to_low : to_high;
      const float farther = to_low < to_high ? to_high : to_low;
      in[i] = in[i] < nearer ? nearer : in[i];
      out[i] = farther < out[i] ? farther : out[i];
    }
  }
  unsigned met = 0;
  for (std::size_t i = 0; i < CHILDREN; ++i)
    met |= in[i] <= out[i] ? 1U << i : 0U;
  return met;
}

bool
RayParity::findHits (const Ray& ray, std::vector<Hit>& hits) const
{
  hits.clear();
  bool runs_along_none = true;
  struct Group {
    std::size_t level, number;
  };
  // All siblings wait on each of the levels, which are no more than 11.
  std::array<Group, 11 * CHILDREN> waiting;
  std::size_t count = 0;
  waiting[count++] = {levels_.size() - 1, 0};
  while (count != 0) {
    const Group group = waiting[--count];
    const std::size_t all =
        group.level == 0 ? discs_.size() : levels_[group.level - 1].size();
    unsigned met = meet (ray, levels_[group.level][group.number]);
    for (; met != 0; met &= met - 1) {
      const std::size_t below =
          group.number * CHILDREN + static_cast<std::size_t> (__builtin_ctz (met));
      // Boxes that are missing are at the origin.
      if (below >= all)
        break;
      if (group.level != 0)
        waiting[count++] = {group.level - 1, below};
      else if (!meet (ray, discs_[below], hits))
        runs_along_none = false;
    }
  }
  return runs_along_none;
}

RayParity::Sheets
RayParity::countSheets (const Ray& ray, float spacing) const
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
  if (!findHits (ray, hits))
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
    const Sheets sheets = countSheets ({from, direction}, spacing);
    side.inside += sheets.count % 2 != 0 ? sheets.certainty : -sheets.certainty;
    side.certainty += sheets.certainty;
  }
  return 0.5F * (back.inside / back.certainty - front.inside / front.certainty);
}

} // namespace crest
} // namespace pcl
