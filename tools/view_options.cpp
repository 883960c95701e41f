// SPDX-License-Identifier: BSD-3-Clause
#include "view_options.h"

#include "io/parse_number.h"

#include <algorithm>
#include <array>
#include <sstream>

namespace pcl {
namespace crest {

namespace {

constexpr std::array<const char*, 6> COLOR_MODES{
    "none", "label", "k1", "k2", "boundary", "rgb"};

/** \brief Takes a number from a range, of which the text tells. */
template <typename T>
Options::Take
fromRange (T least, T most, T& number)
{
  return [=, &number] (const std::string& value) {
    T taken;
    if (parseNumber (value, taken) && taken >= least && taken <= most) {
      number = taken;
      return std::string();
    }
    std::ostringstream wanted;
    wanted << "a number from " << least << " to " << most;
    return wanted.str();
  };
}

std::string
takeColor (const std::string& value, Eigen::Vector3d& color)
{
  std::istringstream stream (value);
  std::vector<double> taken;
  for (std::string part; std::getline (stream, part, ',');) {
    double number;
    if (parseNumber (part, number) && number >= 0.0 && number <= 1.0)
      taken.push_back (number);
  }
  if (taken.size() != 3 || std::count (value.begin(), value.end(), ',') != 2)
    return "red, green and blue from 0 to 1, as in 0,0,0.5";
  color = {taken[0], taken[1], taken[2]};
  return {};
}

} // namespace

Eigen::Vector3d
inkOn (const Eigen::Vector3d& background)
{
  return Eigen::Vector3d::Constant (background.mean() > 0.5 ? 0.0 : 1.0);
}

void
addViewOptions (Options& options, ViewOptions& view)
{
  options.add ("-color",
               "NAME",
               "color points by: none, label, k1, k2, boundary, rgb (of the file)",
               [&view] (const std::string& value) {
                 const auto* const mode =
                     std::find (COLOR_MODES.begin(), COLOR_MODES.end(), value);
                 if (mode == COLOR_MODES.end())
                   return std::string ("none, label, k1, k2, boundary or rgb");
                 view.color = static_cast<ColorMode> (mode - COLOR_MODES.begin());
                 return std::string();
               });
  options.add ("-ps",
               "N",
               "draw points as dots of N pixels, 1 to 64 (default: as a surface)",
               fromRange (1, LARGEST_POINT, view.point_size));
  options.add ("-opaque",
               "X",
               "opacity of the points, 0 to 1 (default 1)",
               fromRange (0.0, 1.0, view.opacity));
  options.add ("-lw",
               "X",
               "width of the lines in pixels (default 2.5)",
               fromRange (THINNEST_LINE, THICKEST_LINE, view.line_width));
  options.add ("-bc",
               "R,G,B",
               "color of the background, each 0 to 1 (default 1,1,1)",
               [&view] (const std::string& value) {
                 return takeColor (value, view.background);
               });
  options.add ("-ax",
               "X",
               "draw axes of this length at the origin, x red, y green, z blue",
               fromRange (0.0, 1e30, view.axes));
  options.addFlag (
      "-directions", "draw principal directions from the start", view.directions);
  options.addFlag ("-chart", "show the chart of line sizes from the start", view.chart);
  options.addFlag ("-sliders", "show the sliders in the picture, too", view.sliders);
}

} // namespace crest
} // namespace pcl
