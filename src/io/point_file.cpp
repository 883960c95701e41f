// SPDX-License-Identifier: BSD-3-Clause
#include "io/point_file.h"

#include <boost/algorithm/string/case_conv.hpp>

#include "io/file_fields.h"

namespace pcl {
namespace crest {

std::vector<PointColumn>
normalColumns (const pcl::PointCloud<pcl::PointNormal>& cloud,
               const std::array<const char*, 3>& names)
{
  const pcl::PointNormal* const first = cloud.points.data();
  std::vector<PointColumn> columns;
  for (std::size_t axis = 0; axis < 3; ++axis)
    columns.push_back (columnOf<pcl::PointNormal> (
        names[axis], first->data_n + axis, NumberType::FLOAT32));
  return columns;
}

bool
isPackedColor (const PointColumn& column)
{
  const std::string name = boost::to_lower_copy (column.name);
  return (name == "rgb" || name == "rgba") && sizeOf (column.type) == 4 &&
         column.count == 1;
}

std::vector<PointColumn>
passingColumns (const PointFile& file, bool keeps_packed)
{
  std::vector<PointColumn> columns;
  for (const FileFields::Field& field : file.fields->fields) {
    PointColumn column{field.name,
                       typeOf (field),
                       field.count,
                       file.fields->records.data() + field.offset,
                       file.fields->record_size};
    if (file.colors != nullptr) {
      if (column.type == NumberType::UINT8 &&
          (field.name == "red" || field.name == "green" || field.name == "blue"))
        continue;
      if (isPackedColor (column) && !keeps_packed) {
        if (boost::to_lower_copy (column.name) == "rgba")
          columns.push_back ({"alpha",
                              NumberType::UINT8,
                              1,
                              column.first + (HOST_IS_BIG_ENDIAN ? 0 : 3),
                              column.stride});
        continue;
      }
    }
    columns.push_back (std::move (column));
  }
  return columns;
}

std::vector<PointColumn>
singleColumns (const std::vector<PointColumn>& columns)
{
  std::vector<PointColumn> singles;
  for (const PointColumn& column : columns) {
    if (column.count == 1) {
      singles.push_back (column);
      continue;
    }
    for (std::size_t i = 0; i < column.count; ++i) {
      PointColumn& single = singles.emplace_back (column);
      single.name += "_" + std::to_string (i);
      single.count = 1;
      single.first += i * sizeOf (column.type);
    }
  }
  return singles;
}

Eigen::Vector3d
FilePositions::operator() (std::size_t i)
{
  is_apart_ = next_apart_ != placement_.apart.end() &&
              static_cast<std::size_t> (next_apart_->index) == i;
  return is_apart_ ? (next_apart_++)->position
                   : placement_.pointToFile (cloud_[i].getVector3fMap());
}

} // namespace crest
} // namespace pcl
