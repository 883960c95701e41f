// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_crest/parameters.h>

#include <cmath>
#include <sstream>

namespace pcl {
namespace crest {

namespace {

template <typename T>
std::string
complain (const std::string& name, const T& value, const std::string& wanted)
{
  std::ostringstream message;
  message << name << " is " << value << ", but must be " << wanted;
  return message.str();
}

/** \brief What is wrong with what is set for each type; which of them is named unless
 * it is both.
 */
template <typename T, typename Validity>
std::string
complainOfTypes (const std::string& name,
                 const PerType<T>& values,
                 const Validity& isValid,
                 const char* wanted)
{
  const bool ridge = isValid (values.ridge);
  const bool valley = isValid (values.valley);
  if (ridge && valley)
    return {};
  const char* const of_type = valley ? " of ridges" : ridge ? " of valleys" : "";
  return complain (name + of_type, ridge ? values.valley : values.ridge, wanted);
}

/** \brief What is set though the preset does not have it. */
std::string
findStranger (const Parameters& p)
{
  const Parameters unset;
  const bool paper = p.preset == Preset::PAPER;
  const auto differ = [] (const PerType<double>& a, const PerType<double>& b) {
    return a.ridge != b.ridge || a.valley != b.valley;
  };
  if (!paper && differ (p.maximality, unset.maximality))
    return "M";
  if (!paper && p.absolute_maximality)
    return "the absolute unit of M";
  if (!paper && p.prune != unset.prune)
    return "the largest branch to prune";
  if (paper && p.angle != unset.angle)
    return "the turning angle";
  if (paper && p.min_length != unset.min_length)
    return "the least length of a line";
  if (paper && p.confidence != unset.confidence)
    return "the confidence";
  if (paper && p.positions != unset.positions)
    return "where lines run";
  return {};
}

} // namespace

std::string
nameOf (Preset preset)
{
  return preset == Preset::PAPER ? "paper" : "auto";
}

int
minSize (const Parameters& parameters, CrestType type)
{
  constexpr int PAPER_SIZE = 10;
  return parameters.min_size[type].value_or (
      parameters.preset == Preset::PAPER ? PAPER_SIZE : 0);
}

std::string
explainInvalid (const Parameters& p)
{
  if (p.radius < 0.0 || !std::isfinite (p.radius))
    return complain ("the search radius", p.radius, "finite and not negative");
  if (p.radius == 0.0 && (p.k < 4 || p.k > MOST_NEIGHBORS))
    return complain ("k",
                     p.k,
                     "from 4 (the point and three neighbours) to " +
                         std::to_string (MOST_NEIGHBORS));
  if (p.points_per_quadrant < 1 || p.points_per_quadrant > 16)
    return complain (
        "the number of points per quadrant", p.points_per_quadrant, "from 1 to 16");
  if (!(p.max_normal_angle > 0.0 && p.max_normal_angle <= 180.0))
    return complain ("the largest angle between neighbouring normals",
                     p.max_normal_angle,
                     "above 0 and at most 180 degrees");
  const std::string stranger = findStranger (p);
  if (!stranger.empty())
    return stranger +
           (p.preset == Preset::AUTO
                ? " is set, but belongs to the preset paper: choose that with "
                  "setPreset "
                  "(Preset::PAPER), or set the turning angle, the least length or the "
                  "confidence of the preset auto instead"
                : " is set, but belongs to the preset auto: choose that with setPreset "
                  "(Preset::AUTO)");
  std::string wrong_maximality = complainOfTypes (
      "M",
      p.maximality,
      [] (double m) { return m >= 0.0 && std::isfinite (m); },
      "finite and not negative");
  if (!wrong_maximality.empty())
    return wrong_maximality;
  std::string wrong_size = complainOfTypes (
      "S",
      PerType<int>{minSize (p, CrestType::RIDGE), minSize (p, CrestType::VALLEY)},
      [] (int size) { return size >= 0; },
      "not negative");
  if (!wrong_size.empty())
    return wrong_size;
  if (!(p.min_strength >= 0.0 && std::isfinite (p.min_strength)))
    return complain (
        "the least strength of a line", p.min_strength, "finite and not negative");
  if (!(p.angle >= 0.0 && p.angle <= 180.0))
    return complain ("the turning angle", p.angle, "from 0 to 180 degrees");
  if (!(p.min_length >= 0.0 && std::isfinite (p.min_length)))
    return complain (
        "the least length of a line", p.min_length, "finite and not negative");
  if (!(p.confidence >= 0.0 && std::isfinite (p.confidence)))
    return complain ("the confidence", p.confidence, "finite and not negative");
  if (p.threads > MOST_THREADS)
    return complain (
        "the number of threads", p.threads, "at most " + std::to_string (MOST_THREADS));
  if (p.prune < 0)
    return complain ("the largest branch to prune", p.prune, "not negative");
  if (!p.wanted.ridge && !p.wanted.valley)
    return "neither ridges nor valleys are wanted: choose at least one";
  return {};
}

} // namespace crest
} // namespace pcl
