// SPDX-License-Identifier: BSD-3-Clause
#include "io/line_file.h"

#include "io/placement.h"

#include <algorithm>
#include <utility>

namespace pcl {
namespace crest {

LinePoints::LinePoints (const pcl::PointCloud<pcl::PointNormal>& cloud,
                        const std::vector<CrestLine>& lines,
                        const Placement& placement,
                        std::string crs)
: cloud_ (cloud), placement_ (placement), crs_ (std::move (crs))
{
  for (const CrestLine& line : lines)
    for (const std::vector<index_t>& polyline : line.polylines)
      used_.insert (used_.end(), polyline.begin(), polyline.end());
  std::sort (used_.begin(), used_.end());
  used_.erase (std::unique (used_.begin(), used_.end()), used_.end());
  colors_.resize (used_.size());
  for (auto line = lines.rbegin(); line != lines.rend(); ++line)
    for (const std::vector<index_t>& polyline : line->polylines)
      for (const index_t point : polyline)
        colors_[place (point)] = colorOf (line->type);
}

std::size_t
LinePoints::place (index_t point) const
{
  return static_cast<std::size_t> (
      std::lower_bound (used_.begin(), used_.end(), point) - used_.begin());
}

bool
LinePoints::hasDoubles() const
{
  return needsDoubles (placement_);
}

Eigen::Vector3d
LinePoints::position (index_t point) const
{
  return placement_.toFile (cloud_[point].getVector3fMap());
}

void
LinePoints::appendPoint (std::string& text, index_t point) const
{
  appendPlace (text, cloud_[point].getVector3fMap(), placement_);
}

void
LinePoints::append (std::string& text,
                    const char* prefix,
                    std::string (*behind) (const Rgb& color)) const
{
  for (std::size_t i = 0; i < used_.size(); ++i) {
    text += prefix;
    appendPoint (text, used_[i]);
    if (behind != nullptr)
      text += " " + behind (colors_[i]);
    text += '\n';
  }
}

std::string
colorText (const Rgb& color)
{
  return std::to_string (color[0]) + " " + std::to_string (color[1]) + " " +
         std::to_string (color[2]);
}

} // namespace crest
} // namespace pcl
