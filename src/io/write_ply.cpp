// SPDX-License-Identifier: BSD-3-Clause
#include "io/placement.h"
#include "io/point_file.h"

#include <algorithm>
#include <array>

namespace pcl {
namespace crest {

namespace {

/** \brief PLY has no whole numbers of eight bytes: these become doubles. */
NumberType
plyType (NumberType type)
{
  return type == NumberType::INT64 || type == NumberType::UINT64 ? NumberType::FLOAT64
                                                                 : type;
}

const char*
nameOf (NumberType type)
{
  switch (plyType (type)) {
  case NumberType::INT8:
    return "char";
  case NumberType::UINT8:
    return "uchar";
  case NumberType::INT16:
    return "short";
  case NumberType::UINT16:
    return "ushort";
  case NumberType::INT32:
    return "int";
  case NumberType::UINT32:
    return "uint";
  case NumberType::FLOAT32:
    return "float";
  default:
    return "double";
  }
}

std::vector<Rgb>
labelColors (const pcl::PointCloud<pcl::Label>& labels)
{
  std::vector<Rgb> colors;
  colors.reserve (labels.size());
  for (const pcl::Label& label : labels)
    colors.push_back (colorOfLabel (label.label));
  return colors;
}

/** \brief Appends a number in little-endian order. */
void
appendNumbers (std::string& text, const char* bytes, NumberType type)
{
  if (type != plyType (type)) {
    const double number = decode (bytes, type, HOST_IS_BIG_ENDIAN);
    appendNumbers (text, reinterpret_cast<const char*> (&number), NumberType::FLOAT64);
    return;
  }
  text.append (bytes, sizeOf (type));
  if (HOST_IS_BIG_ENDIAN)
    std::reverse (text.end() - static_cast<std::ptrdiff_t> (sizeOf (type)), text.end());
}

} // namespace

std::string
toPly (const PointFile& file)
{
  const bool has_doubles = needsDoubles (file.placement);
  const NumberType type = has_doubles ? NumberType::FLOAT64 : NumberType::FLOAT32;
  std::vector<PointColumn> columns = normalColumns (file.cloud, {"nx", "ny", "nz"});
  std::vector<PointColumn> passing;
  if (file.fields != nullptr)
    passing = singleColumns (passingColumns (file, false));
  std::vector<Rgb> of_labels;
  const std::vector<Rgb>* colors = file.colors;
  if (colors == nullptr && file.labels != nullptr) {
    of_labels = labelColors (*file.labels);
    colors = &of_labels;
  }
  if (colors != nullptr) {
    constexpr std::array<const char*, 3> CHANNELS{"red", "green", "blue"};
    for (std::size_t c = 0; c < CHANNELS.size(); ++c) {
      columns.push_back (
          columnOf<Rgb> (CHANNELS[c], colors->data()->data() + c, NumberType::UINT8));
      // Of other types than bytes, which programs do not expect under these names.
      for (PointColumn& column : passing)
        if (column.name == CHANNELS[c])
          column.name = "input_" + column.name;
    }
  }
  columns.insert (columns.end(), file.columns.begin(), file.columns.end());
  columns.insert (columns.end(), passing.begin(), passing.end());

  std::string text =
      "ply\nformat binary_little_endian 1.0\n"
      "comment label 0 none, 1 ridge, 2 valley, 3 and 4 joined to a ridge "
      "or valley line, 5 invalid, 6 boundary\nelement vertex " +
      std::to_string (file.cloud.size()) + "\n";
  std::size_t point_size = 3 * sizeOf (type);
  const auto declare = [&text] (NumberType number, const std::string& name) {
    text += std::string ("property ") + nameOf (number) + " " + name + "\n";
  };
  for (const char* const name : {"x", "y", "z"})
    declare (type, name);
  for (const PointColumn& column : columns) {
    declare (column.type, column.name);
    point_size += sizeOf (column.type);
  }
  text += "end_header\n";
  text.reserve (text.size() + file.cloud.size() * point_size);
  FilePositions positions (file.cloud, file.placement);
  for (std::size_t i = 0; i < file.cloud.size(); ++i) {
    const Eigen::Vector3d position = positions (i);
    const Eigen::Vector3f rounded = position.cast<float>();
    for (Eigen::Index axis = 0; axis < 3; ++axis)
      appendNumbers (text,
                     has_doubles ? reinterpret_cast<const char*> (&position[axis])
                                 : reinterpret_cast<const char*> (&rounded[axis]),
                     type);
    for (const PointColumn& column : columns)
      appendNumbers (text, column.at (i), column.type);
  }
  return text;
}

} // namespace crest
} // namespace pcl
