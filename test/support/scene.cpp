// SPDX-License-Identifier: BSD-3-Clause
#include "scene.h"

#include "flat_face.h"
#include "prisms.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace oracle {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using pcl::crest::CrestType;

/** What is that near to another point of a scene of size 2 is the same. */
constexpr double NOTHING = 1e-6;

/** \brief How far the face goes on from a point of its border in a direction, if at
 * all.
 */
double
widthOf (const FlatFace& face, const Vector3d& p, const Vector3d& direction)
{
  constexpr double STEP = 0.005;
  double width = 0.0;
  while (face.contains (p + (width + NOTHING) * direction))
    width += STEP;
  return width;
}

/** \brief The faces that meet at a piece of an edge. */
std::vector<EdgeSide>
sidesOf (const std::vector<FlatFace>& faces, const TruthSegment& piece)
{
  std::vector<EdgeSide> sides;
  const Vector3d middle = 0.5 * (piece.a + piece.b);
  const Vector3d along = (piece.b - piece.a).normalized();
  for (const FlatFace& face : faces) {
    if (std::abs (face.normal.dot (middle - face.origin)) > NOTHING ||
        std::abs (face.normal.dot (along)) > NOTHING)
      continue;
    const Vector3d aside = face.normal.cross (along);
    for (const Vector3d& inward : {aside, Vector3d (-aside)}) {
      const double width = widthOf (face, middle, inward);
      if (width > 0.0)
        sides.push_back ({face.normal, inward, width});
    }
  }
  return sides;
}

/** \brief Four corners, turned by an angle. */
Outline
rectangle (const Vector2d& center, const Vector2d& half, double angle)
{
  const Eigen::Rotation2Dd turn (angle);
  Outline outline;
  for (const Vector2d& corner : {Vector2d (-1.0, -1.0),
                                 Vector2d (1.0, -1.0),
                                 Vector2d (1.0, 1.0),
                                 Vector2d (-1.0, 1.0)})
    outline.push_back (center + turn * corner.cwiseProduct (half));
  return outline;
}

/** \brief How wide the face is seen from a place, from the edge on. */
double
visibleWidth (const EdgeSide& side,
              const Vector3d& edge,
              const std::function<bool (const Vector3d&)>& sees)
{
  constexpr int STEPS = 40;
  for (int i = 0; i < STEPS; ++i)
    if (!sees (edge + (i + 0.5) / STEPS * side.width * side.inward))
      return side.width * i / STEPS;
  return side.width;
}

/** \brief A scene whose crests and bounds are not filled in. */
template <typename Surface>
Scene
startScene (const Surface& surface, RayCaster cast)
{
  Scene scene;
  scene.name = surface.name;
  scene.cast = std::move (cast);
  scene.sample = [surface] (std::size_t count, unsigned seed) {
    return oracle::sample (surface, count, seed);
  };
  return scene;
}

} // namespace

Scene
sceneOf (const SharpSolid& solid)
{
  Scene scene = startScene (solid, castSolid (solid));
  scene.low = scene.high = solid.edges.front().a;
  for (const SolidFace& face : solid.faces)
    for (const double x : {0.0, face.width})
      for (const double y : {0.0, face.height}) {
        scene.low = scene.low.cwiseMin (face.position (x, y));
        scene.high = scene.high.cwiseMax (face.position (x, y));
      }
  const std::vector<FlatFace> faces (solid.faces.begin(), solid.faces.end());
  for (const TruthSegment& piece : trueCrestLines (solid)) {
    const std::vector<EdgeSide> sides = sidesOf (faces, piece);
    double width = std::numeric_limits<double>::infinity();
    for (const EdgeSide& side : sides)
      width = std::min (width, side.width);
    scene.crests.push_back ({piece, sides, width});
  }
  return scene;
}

Scene
heightFieldScene (const AnalyticSurface& surface)
{
  Scene scene = startScene (surface, castHeightField (surface));
  scene.low = {surface.u_min, surface.v_min, -1.0};
  scene.high = {surface.u_max, surface.v_max, 1.0};
  for (const TruthSegment& piece : trueCrestLines (surface))
    scene.crests.push_back (
        {piece, {}, 2.0 * std::sqrt (2.0 * piece.curvature / piece.sharpness)});
  return scene;
}

SharpSolid
blocks ()
{
  struct Block {
    Outline outline;
    double height;
  };
  Outline hexagon;
  for (int i = 0; i < 6; ++i)
    hexagon.emplace_back (-0.4 + 0.3 * std::cos (M_PI * i / 3.0 + 0.2),
                          -0.45 + 0.3 * std::sin (M_PI * i / 3.0 + 0.2));
  const std::vector<Block> all{
      {rectangle ({0.5, 0.45}, {0.28, 0.2}, 0.35), 0.35},
      {rectangle ({0.5, -0.45}, {0.3, 0.18}, -0.25), 0.06},
      {stripOutline ({{-0.85, 0.3}, {-0.35, 0.38}, {-0.45, 0.88}}, 0.24), 0.5},
      {hexagon, 0.2}};

  SharpSolid solid;
  solid.name = "blocks";
  for (const Block& block : all) {
    const SharpSolid one = prism ("", block.outline, block.height);
    for (const SolidFace& face : one.faces)
      if (face.normal (0.0, 0.0).z() > -0.5)
        solid.faces.push_back (face);
    for (SharpEdge edge : one.edges) {
      if (edge.a.z() == 0.0 && edge.b.z() == 0.0)
        edge.type = CrestType::VALLEY;
      solid.edges.push_back (edge);
    }
  }
  solid.faces.push_back (
      {2.0,
       2.0,
       [all] (double x, double y) {
         return std::none_of (all.begin(), all.end(), [&] (const Block& block) {
           return contains (block.outline, Vector2d (x - 1.0, y - 1.0));
         });
       },
       [] (double x, double y) { return Vector3d (x - 1.0, y - 1.0, 0.0); },
       [] (double, double) -> Vector3d { return Vector3d::UnitZ(); }});
  return solid;
}

Scene
scaled (const Scene& scene, double factor)
{
  Scene result = scene;
  result.cast = [cast = scene.cast, factor] (const Vector3d& origin,
                                             const Vector3d& direction) {
    Hit hit = cast (origin / factor, direction);
    hit.distance *= factor;
    return hit;
  };
  result.sample = [sample = scene.sample, factor] (std::size_t count, unsigned seed) {
    auto cloud = sample (count, seed);
    for (pcl::PointNormal& point : *cloud)
      point.getVector3fMap() *= static_cast<float> (factor);
    return cloud;
  };
  for (SceneCrest& crest : result.crests) {
    crest.segment.a *= factor;
    crest.segment.b *= factor;
    crest.segment.curvature /= factor;
    crest.segment.sharpness /= factor * factor * factor;
    crest.width *= factor;
    for (EdgeSide& side : crest.sides)
      side.width *= factor;
  }
  result.low *= factor;
  result.high *= factor;
  return result;
}

Eigen::Isometry3d
lookAt (const Vector3d& eye, const Vector3d& target)
{
  const Vector3d ahead = (target - eye).normalized();
  const Vector3d right = ahead.cross (Vector3d::UnitZ()).normalized();
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() << right, ahead.cross (right), ahead;
  pose.translation() = eye;
  return pose;
}

std::vector<TruthSegment>
visibleCrests (const Scene& scene,
               const std::optional<View>& view,
               double spacing,
               double least_spacings)
{
  const auto sees = [&] (const Vector3d& p) {
    if (!view)
      return true;
    const Vector3d way = p - view->pose.translation();
    if (!view->covers (view->pose.linear().transpose() * way.normalized()))
      return false;
    constexpr double NEAR = 1e-3;
    return scene.cast (view->pose.translation(), way.normalized()).distance >
           (1.0 - NEAR) * way.norm();
  };
  const auto spacingAt = [&] (const Vector3d& p, const Vector3d& normal) {
    if (!view)
      return spacing;
    const Vector3d way = p - view->pose.translation();
    const double apart = way.squaredNorm() * view->step / std::abs (way.dot (normal));
    return std::max (spacing, apart);
  };
  std::vector<TruthSegment> truth;
  for (const SceneCrest& crest : scene.crests) {
    const Vector3d middle = 0.5 * (crest.segment.a + crest.segment.b);
    bool is_wide = false;
    if (crest.sides.empty()) {
      const Vector3d normal =
          view ? scene
                     .cast (view->pose.translation(),
                            (middle - view->pose.translation()).normalized())
                     .normal
               : Vector3d::UnitZ();
      is_wide =
          sees (middle) && crest.width >= least_spacings * spacingAt (middle, normal);
    }
    else
      is_wide = std::all_of (
          crest.sides.begin(), crest.sides.end(), [&] (const EdgeSide& side) {
            // Beside an edge the tolerance of sight reaches around it.
            const bool looks_away =
                view && side.normal.dot (view->pose.translation() - middle) < 0.0;
            return !looks_away && visibleWidth (side, middle, sees) >=
                                      least_spacings * spacingAt (middle, side.normal);
          });
    truth.push_back (crest.segment);
    if (!is_wide)
      truth.back().sharpness = 0.0;
  }
  return truth;
}

} // namespace oracle
