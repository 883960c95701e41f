// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_crest/surface_analysis.h>

#include <sstream>

namespace pcl {
namespace crest {

std::string
explainOtherShape (const Parameters& made_with, const Parameters& wanted)
{
  const auto explain = [] (const std::string& name, auto made, auto now) {
    std::ostringstream text;
    text << name << " " << made << ", not " << now;
    return text.str();
  };
  const auto nameOf = [] (Preset preset) {
    return preset == Preset::AUTO ? "AUTO" : "PAPER";
  };
  const Parameters& m = made_with;
  if (m.preset != wanted.preset)
    return explain ("the preset", nameOf (m.preset), nameOf (wanted.preset));
  if (m.radius != wanted.radius)
    return explain ("the radius", m.radius, wanted.radius);
  if (m.radius == 0.0 && m.k != wanted.k)
    return explain ("k =", m.k, wanted.k);
  if (m.points_per_quadrant != wanted.points_per_quadrant)
    return explain (
        "points per quadrant", m.points_per_quadrant, wanted.points_per_quadrant);
  if (m.max_normal_angle != wanted.max_normal_angle)
    return explain (
        "a largest normal angle of", m.max_normal_angle, wanted.max_normal_angle);
  return {};
}

bool
haveSameTrace (const Parameters& a, const Parameters& b)
{
  return a.angle == b.angle && a.min_length == b.min_length &&
         a.confidence == b.confidence && a.prune == b.prune &&
         a.absolute_maximality == b.absolute_maximality &&
         a.maximality.ridge == b.maximality.ridge &&
         a.maximality.valley == b.maximality.valley;
}

} // namespace crest
} // namespace pcl
