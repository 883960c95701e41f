// SPDX-License-Identifier: BSD-3-Clause
#include "ray_caster.h"

#include "flat_face.h"

#include <algorithm>
#include <cmath>

namespace oracle {

namespace {

using Eigen::Vector3d;

/** \brief The part of a ray where it is within a box. */
struct Interval {
  double first = 0.0;
  double last = std::numeric_limits<double>::infinity();

  Interval (const Vector3d& origin,
            const Vector3d& direction,
            const Vector3d& low,
            const Vector3d& high)
  {
    for (int axis = 0; axis < 3; ++axis) {
      // Division by zero gives infinities of the right signs.
      const double a = (low[axis] - origin[axis]) / direction[axis];
      const double b = (high[axis] - origin[axis]) / direction[axis];
      first = std::max (first, std::min (a, b));
      last = std::min (last, std::max (a, b));
    }
  }
};

} // namespace

RayCaster
castPlanes (const std::vector<Plane>& planes, bool nearest)
{
  return [=] (const Vector3d& origin, const Vector3d& direction) {
    Hit hit;
    for (const Plane& plane : planes) {
      const double distance =
          (plane.offset - plane.normal.dot (origin)) / plane.normal.dot (direction);
      if (!std::isfinite (hit.distance) || (distance < hit.distance) == nearest)
        hit = {distance, plane.normal};
    }
    return hit;
  };
}

RayCaster
castSolid (const SharpSolid& solid)
{
  const std::vector<FlatFace> faces (solid.faces.begin(), solid.faces.end());
  return [faces] (const Vector3d& origin, const Vector3d& direction) {
    Hit hit;
    for (const FlatFace& face : faces) {
      const double distance =
          face.normal.dot (face.origin - origin) / face.normal.dot (direction);
      if (distance > 0.0 && distance < hit.distance &&
          face.contains (origin + distance * direction))
        hit = {distance, face.normal};
    }
    return hit;
  };
}

RayCaster
castHeightField (const AnalyticSurface& surface)
{
  constexpr double STEP = 0.01;
  Vector3d low (surface.u_min, surface.v_min, 0.0);
  Vector3d high (surface.u_max, surface.v_max, 0.0);
  for (double u = low.x(); u < high.x(); u += STEP)
    for (double v = low.y(); v < high.y(); v += STEP) {
      const double z = surface.position (u, v).z();
      low.z() = std::min (low.z(), z - STEP);
      high.z() = std::max (high.z(), z + STEP);
    }
  const auto heightAt = [position = surface.position] (double u, double v) {
    return position (u, v).z();
  };
  return [=] (const Vector3d& origin, const Vector3d& direction) {
    const auto above = [&] (double t) {
      const Vector3d p = origin + t * direction;
      return p.z() - heightAt (p.x(), p.y());
    };
    const Interval in_box (origin, direction, low, high);
    Hit hit;
    if (!(in_box.first < in_box.last))
      return hit;
    double before = in_box.first;
    const bool is_above = above (before) > 0.0;
    while (before < in_box.last) {
      double after = std::min (before + STEP, in_box.last);
      if ((above (after) > 0.0) == is_above) {
        before = after;
        continue;
      }
      constexpr int HALVINGS = 40;
      for (int i = 0; i < HALVINGS; ++i) {
        const double middle = 0.5 * (before + after);
        ((above (middle) > 0.0) == is_above ? before : after) = middle;
      }
      const Vector3d p = origin + after * direction;
      constexpr double SHORT = 1e-5;
      hit.distance = after;
      hit.normal =
          Vector3d (heightAt (p.x() - SHORT, p.y()) - heightAt (p.x() + SHORT, p.y()),
                    heightAt (p.x(), p.y() - SHORT) - heightAt (p.x(), p.y() + SHORT),
                    2.0 * SHORT)
              .normalized();
      return hit;
    }
    return hit;
  };
}

} // namespace oracle
