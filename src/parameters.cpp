// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_crest/parameters.h>

#include <cmath>
#include <sstream>

namespace pcl {
namespace crest {

namespace {

template <typename T>
std::string
complain (const char* name, const T& value, const char* wanted)
{
  std::ostringstream message;
  message << name << " is " << value << ", but must be " << wanted;
  return message.str();
}

} // namespace

std::string
explainInvalid (const Parameters& p)
{
  if (p.radius < 0.0 || !std::isfinite (p.radius))
    return complain ("the search radius", p.radius, "finite and not negative");
  // More than a thousand candidates for eight places are a mistake, and take hours.
  if (p.radius == 0.0 && (p.k < 4 || p.k > 1000))
    return complain ("k", p.k, "from 4 (the point and three neighbours) to 1000");
  if (p.points_per_quadrant < 1 || p.points_per_quadrant > 16)
    return complain (
        "the number of points per quadrant", p.points_per_quadrant, "from 1 to 16");
  if (!(p.max_normal_angle > 0.0 && p.max_normal_angle <= 180.0))
    return complain ("the largest angle between neighbouring normals",
                     p.max_normal_angle,
                     "above 0 and at most 180 degrees");
  for (const CrestType type : CREST_TYPES) {
    if (!(p.maximality[type] >= 0.0 && std::isfinite (p.maximality[type])))
      return complain ("M", p.maximality[type], "finite and not negative");
    if (p.min_size[type] < 0)
      return complain ("S", p.min_size[type], "not negative");
  }
  const PerType<double> unset = Parameters().maximality;
  if (p.preset == Preset::AUTO &&
      (p.maximality.ridge != unset.ridge || p.maximality.valley != unset.valley))
    return "M belongs to the preset paper: the preset auto has the turning angle, the "
           "least length and the confidence in its place";
  if (!(p.angle >= 0.0 && p.angle <= 180.0))
    return complain ("the turning angle", p.angle, "from 0 to 180 degrees");
  if (!(p.min_length >= 0.0 && std::isfinite (p.min_length)))
    return complain ("the least length of a line", p.min_length, "not negative");
  if (!(p.confidence >= 0.0 && std::isfinite (p.confidence)))
    return complain ("the confidence", p.confidence, "finite and not negative");
  // Far above any machine; OpenMP may end the process where it cannot have its threads.
  if (p.threads > 1024)
    return complain ("the number of threads", p.threads, "at most 1024");
  if (p.prune < 0)
    return complain ("the largest branch to prune", p.prune, "not negative");
  if (!p.wanted.ridge && !p.wanted.valley)
    return "neither ridges nor valleys are wanted: choose at least one";
  return {};
}

} // namespace crest
} // namespace pcl
