// SPDX-License-Identifier: BSD-3-Clause
#include "view_options.h"

#include "io/parse_number.h"

#include <algorithm>
#include <sstream>

namespace pcl {
namespace crest {

namespace {

/** \brief A number from a range, of which the text tells. */
template <typename T>
OptionValue*
fromRange (const std::string& name, T least, T most, T& number)
{
  return value (name, [=, &number] (const std::string& text) {
    T taken;
    if (parseNumber (text, taken) && taken >= least && taken <= most) {
      number = taken;
      return std::string();
    }
    std::ostringstream wanted;
    wanted << "a number from " << least << " to " << most;
    return wanted.str();
  });
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
  auto add = options.add_options();
  add ("-color",
       oneOf<ColorMode> ("NAME",
                         {{"none", ColorMode::SHADED},
                          {"label", ColorMode::LABEL},
                          {"k1", ColorMode::K1},
                          {"k2", ColorMode::K2},
                          {"boundary", ColorMode::BOUNDARY},
                          {"rgb", ColorMode::FILE}},
                         view.color),
       "color points by: none, label, k1, k2, boundary, rgb (of the file)");
  add ("-ps",
       fromRange ("N", 1, LARGEST_POINT, view.point_size),
       "draw points as dots of N pixels, 1 to 64 (default: as a surface)");
  add ("-opaque",
       fromRange ("X", 0.0, 1.0, view.opacity),
       "opacity of the points, 0 to 1 (default 1)");
  add ("-lw",
       fromRange ("X", THINNEST_LINE, THICKEST_LINE, view.line_width),
       "width of the lines in pixels (default 2.5)");
  add ("-bc",
       value ("R,G,B",
              [&view] (const std::string& text) {
                return takeColor (text, view.background);
              }),
       "color of the background, each 0 to 1 (default 1,1,1)");
  add ("-ax",
       fromRange ("X", 0.0, 1e30, view.axes),
       "draw axes of this length at the origin, x red, y green, z blue");
  add ("-directions",
       flag (view.directions),
       "draw principal directions from the start");
  add ("-chart", flag (view.chart), "show the chart of line sizes from the start");
  add ("-sliders", flag (view.sliders), "show the sliders in the picture, too");
}

} // namespace crest
} // namespace pcl
