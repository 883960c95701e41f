// SPDX-License-Identifier: BSD-3-Clause
#include "io/format_number.h"
#include "io/placement.h"
#include "io/point_file.h"

#include <algorithm>

namespace pcl {
namespace crest {

namespace {

/** \brief Colors as PCL packs them into the bits of a number. */
std::vector<std::uint32_t>
packColors (const std::vector<Rgb>& colors)
{
  std::vector<std::uint32_t> packed;
  packed.reserve (colors.size());
  for (const Rgb& color : colors)
    packed.push_back (static_cast<std::uint32_t> (color[0]) << 16U |
                      static_cast<std::uint32_t> (color[1]) << 8U | color[2]);
  return packed;
}

void
appendViewpoint (std::string& text, const PointFile& file)
{
  const Eigen::Vector3f origin = file.cloud.sensor_origin_.head<3>();
  text += ' ';
  // PCL's default, which tells nothing of a sensor, is the same everywhere.
  appendPlace (text, origin, origin.isZero (0.0F) ? Placement() : file.placement);
  const Eigen::Quaternionf& q = file.cloud.sensor_orientation_;
  for (const float number : {q.w(), q.x(), q.y(), q.z()}) {
    text += ' ';
    appendNumber (text, number);
  }
}

} // namespace

std::string
toPcd (const PointFile& file)
{
  const bool has_doubles = needsDoubles (file.placement);
  const NumberType type = has_doubles ? NumberType::FLOAT64 : NumberType::FLOAT32;
  std::vector<PointColumn> all{{"x", type}, {"y", type}, {"z", type}};
  const auto add = [&all] (const std::vector<PointColumn>& columns) {
    all.insert (all.end(), columns.begin(), columns.end());
  };
  add (normalColumns (file.cloud, {"normal_x", "normal_y", "normal_z"}));
  add (file.columns);
  std::vector<PointColumn> passing;
  if (file.fields != nullptr)
    passing = passingColumns (file, true);
  std::vector<std::uint32_t> packed;
  if (file.colors != nullptr &&
      std::none_of (passing.begin(), passing.end(), isPackedColor)) {
    packed = packColors (*file.colors);
    add ({columnOf<std::uint32_t> ("rgb", packed.data(), NumberType::FLOAT32)});
  }
  add (passing);

  std::string text = "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\n";
  const auto line = [&text, &all] (const char* key, const auto& value) {
    text += key;
    for (const PointColumn& column : all) {
      text += ' ';
      text += value (column);
    }
    text += '\n';
  };
  line ("FIELDS", [] (const PointColumn& c) { return c.name; });
  line ("SIZE", [] (const PointColumn& c) { return std::to_string (sizeOf (c.type)); });
  line ("TYPE", [] (const PointColumn& c) { return letterOf (c.type); });
  line ("COUNT", [] (const PointColumn& c) { return std::to_string (c.count); });
  text += "WIDTH " + std::to_string (file.cloud.width) + "\nHEIGHT " +
          std::to_string (file.cloud.height) + "\nVIEWPOINT";
  appendViewpoint (text, file);
  text += "\nPOINTS " + std::to_string (file.cloud.size()) + "\nDATA binary\n";
  std::size_t point_size = 0;
  for (const PointColumn& column : all)
    point_size += sizeOf (column.type) * column.count;
  text.reserve (text.size() + file.cloud.size() * point_size);

  FilePositions positions (file.cloud, file.placement);
  for (std::size_t i = 0; i < file.cloud.size(); ++i) {
    const Eigen::Vector3d position = positions (i);
    const Eigen::Vector3f rounded = position.cast<float>();
    text.append (has_doubles ? reinterpret_cast<const char*> (position.data())
                             : reinterpret_cast<const char*> (rounded.data()),
                 3 * sizeOf (type));
    for (std::size_t j = 3; j < all.size(); ++j)
      text.append (all[j].at (i), sizeOf (all[j].type) * all[j].count);
  }
  return text;
}

} // namespace crest
} // namespace pcl
