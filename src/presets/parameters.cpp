// SPDX-License-Identifier: BSD-3-Clause
#include "presets/pipeline.h"

#include <algorithm>
#include <cctype>
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

/** \brief What is set though another preset than the chosen one has it. */
std::string
complainOfForeign (const Parameters& p, const Pipeline& chosen)
{
  for (const Pipeline* const other : allPipelines()) {
    const std::string foreign = other != &chosen ? other->ownParameter (p) : "";
    if (foreign.empty())
      continue;
    std::string value = other->name();
    std::transform (value.begin(), value.end(), value.begin(), [] (char c) {
      return static_cast<char> (std::toupper (static_cast<unsigned char> (c)));
    });
    std::string message = foreign + " is set, but belongs to the preset ";
    message += other->name() + ": choose that with setPreset (Preset::" + value;
    message += ")";
    const std::string instead = chosen.ownAlternative();
    if (!instead.empty())
      message += ", or set " + instead + " of the preset " + chosen.name() + " instead";
    return message;
  }
  return {};
}

} // namespace

PerType<double>
absoluteMaximality (const Parameters& parameters, double extent)
{
  if (parameters.absolute_maximality || extent == 0.0)
    return parameters.maximality;
  constexpr double PAPER_EXTENT = 10.0;
  const double unit = extent / PAPER_EXTENT;
  return {parameters.maximality.ridge / (unit * unit),
          parameters.maximality.valley / (unit * unit)};
}

std::vector<Preset>
presets ()
{
  std::vector<Preset> presets;
  for (const Pipeline* const pipeline : allPipelines())
    presets.push_back (pipeline->preset());
  return presets;
}

std::string
nameOf (Preset preset)
{
  const Pipeline* const pipeline = findPipeline (preset);
  return pipeline != nullptr ? pipeline->name() : "";
}

int
minSize (const Parameters& parameters, CrestType type)
{
  const Pipeline* const pipeline = findPipeline (parameters.preset);
  return parameters.min_size[type].value_or (
      pipeline != nullptr ? pipeline->defaultMinSize() : 0);
}

std::string
explainInvalid (const Parameters& p)
{
  const Pipeline* const pipeline = findPipeline (p.preset);
  if (pipeline == nullptr)
    return complain (
        "the preset", static_cast<int> (p.preset), "one of the values of Preset");
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
  std::string foreign = complainOfForeign (p, *pipeline);
  if (!foreign.empty())
    return foreign;
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
