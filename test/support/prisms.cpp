// SPDX-License-Identifier: BSD-3-Clause
#include "prisms.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace oracle {

namespace {

using pcl::crest::CrestType;
constexpr double DEGREES = 180.0 / M_PI;

double
cross (const Eigen::Vector2d& a, const Eigen::Vector2d& b)
{
  return a.x() * b.y() - a.y() * b.x();
}

Eigen::Vector3d
at (const Eigen::Vector2d& p, double z)
{
  return {p.x(), p.y(), z};
}

/** \brief The bottom, or the top. */
SolidFace
endFace (const Outline& outline, double z, bool top)
{
  Eigen::Vector2d low = outline[0];
  Eigen::Vector2d high = outline[0];
  for (const Eigen::Vector2d& p : outline) {
    low = low.cwiseMin (p);
    high = high.cwiseMax (p);
  }
  return {
      high.x() - low.x(),
      high.y() - low.y(),
      [outline, low] (double x, double y) {
        return contains (outline, low + Eigen::Vector2d (x, y));
      },
      [low, z] (double x, double y) { return at (low + Eigen::Vector2d (x, y), z); },
      [top] (double, double) -> Eigen::Vector3d {
        return (top ? 1.0 : -1.0) * Eigen::Vector3d::UnitZ();
      }};
}

SolidFace
sideFace (const Eigen::Vector2d& a, const Eigen::Vector2d& b, double height)
{
  const Eigen::Vector2d along = (b - a).normalized();
  return {(b - a).norm(),
          height,
          [] (double, double) { return true; },
          [a, along] (double x, double y) { return at (a + x * along, y); },
          [along] (double, double) {
            return Eigen::Vector3d (along.y(), -along.x(), 0.0);
          }};
}

} // namespace

bool
contains (const Outline& outline, const Eigen::Vector2d& p)
{
  // A ray from within crosses the outline an odd number of times.
  bool inside = false;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Eigen::Vector2d& a = outline[i];
    const Eigen::Vector2d& b = outline[(i + 1) % outline.size()];
    if ((a.y() > p.y()) != (b.y() > p.y()) &&
        p.x() < a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x()))
      inside = !inside;
  }
  return inside;
}

SharpSolid
prism (const std::string& name, const Outline& outline, double height)
{
  SharpSolid solid;
  solid.name = name;
  solid.faces = {endFace (outline, 0.0, false), endFace (outline, height, true)};
  const std::size_t size = outline.size();
  for (std::size_t i = 0; i < size; ++i) {
    const Eigen::Vector2d& a = outline[i];
    const Eigen::Vector2d& b = outline[(i + 1) % size];
    solid.faces.push_back (sideFace (a, b, height));
    for (const double z : {0.0, height})
      solid.edges.push_back ({at (a, z), at (b, z), CrestType::RIDGE, 90.0});
    const Eigen::Vector2d before = a - outline[(i + size - 1) % size];
    const double turn = std::atan2 (cross (before, b - a), before.dot (b - a));
    solid.edges.push_back ({at (a, 0.0),
                            at (a, height),
                            turn > 0.0 ? CrestType::RIDGE : CrestType::VALLEY,
                            std::abs (turn) * DEGREES});
  }
  return solid;
}

Outline
gearOutline (int teeth)
{
  constexpr double ROOT = 0.8;
  Outline outline;
  for (int i = 0; i < teeth; ++i)
    for (const auto& [step, radius] : {std::pair (0.0, ROOT),
                                       std::pair (0.35, ROOT),
                                       std::pair (0.5, 1.0),
                                       std::pair (0.8, 1.0)}) {
      const double angle = 2.0 * M_PI * (i + step) / teeth;
      outline.emplace_back (radius * std::cos (angle), radius * std::sin (angle));
    }
  return outline;
}

Outline
starOutline ()
{
  const double golden = (1.0 + std::sqrt (5.0)) / 2.0;
  Outline outline;
  for (int i = 0; i < 10; ++i) {
    const double radius = i % 2 == 0 ? 1.0 : 1.0 / (golden * golden);
    outline.emplace_back (radius * std::cos (0.2 * M_PI * i),
                          radius * std::sin (0.2 * M_PI * i));
  }
  return outline;
}

Outline
stripOutline (const std::vector<Eigen::Vector2d>& line, double thickness)
{
  const auto leftOf = [&] (std::size_t i) {
    const Eigen::Vector2d along = (line[i + 1] - line[i]).normalized();
    return Eigen::Vector2d (-along.y(), along.x());
  };
  Outline right;
  Outline left;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const Eigen::Vector2d before = leftOf (i > 0 ? i - 1 : 0);
    const Eigen::Vector2d after = leftOf (i + 1 < line.size() ? i : i - 1);
    const Eigen::Vector2d aside =
        0.5 * thickness * (before + after) / (1.0 + before.dot (after));
    right.push_back (line[i] - aside);
    left.push_back (line[i] + aside);
  }
  right.insert (right.end(), left.rbegin(), left.rend());
  return right;
}

} // namespace oracle
