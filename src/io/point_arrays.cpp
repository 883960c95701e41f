// SPDX-License-Identifier: BSD-3-Clause
#include "io/point_arrays.h"

#include "io/file_fields.h"

#include <algorithm>

namespace pcl {
namespace crest {

void
PointArrays::add (const std::string& name,
                  NumberType type,
                  std::size_t components,
                  std::size_t before,
                  std::vector<double> values)
{
  const auto known =
      std::find_if (arrays_.begin(), arrays_.end(), [&] (const Array& array) {
        return array.name == name && array.type == type &&
               array.components == components &&
               array.values.size() == before * components;
      });
  if (known != arrays_.end())
    known->values.insert (known->values.end(), values.begin(), values.end());
  else if (before == 0)
    arrays_.push_back ({name, type, components, std::move (values)});
}

void
PointArrays::pass (FileContent& content)
{
  const std::size_t points = content.points.size();
  arrays_.erase (std::remove_if (arrays_.begin(),
                                 arrays_.end(),
                                 [points] (const Array& array) {
                                   return array.values.size() !=
                                          points * array.components;
                                 }),
                 arrays_.end());
  const auto colors =
      std::find_if (arrays_.begin(), arrays_.end(), [] (const Array& array) {
        return array.type == NumberType::UINT8 &&
               (array.components == 3 || array.components == 4);
      });
  if (colors != arrays_.end()) {
    const std::size_t channels = colors->components;
    Array alpha{"alpha", NumberType::UINT8, 1, {}};
    for (auto value = colors->values.begin(); value != colors->values.end();
         value += static_cast<std::ptrdiff_t> (channels)) {
      content.colors.push_back ({static_cast<unsigned char> (value[0]),
                                 static_cast<unsigned char> (value[1]),
                                 static_cast<unsigned char> (value[2])});
      if (channels == 4)
        alpha.values.push_back (value[3]);
    }
    if (channels == 4)
      *colors = std::move (alpha);
    else
      arrays_.erase (colors);
  }
  for (const Array& array : arrays_)
    addField (content.fields, array.name, array.type, array.components);
  content.fields.records.reserve (points * content.fields.record_size);
  for (std::size_t i = 0; i < points; ++i) {
    char* to = addRecord (content.fields);
    for (const Array& array : arrays_)
      for (std::size_t c = 0; c < array.components; ++c, to += sizeOf (array.type))
        encodeNumber (array.values[i * array.components + c], array.type, to);
  }
  arrays_.clear();
}

} // namespace crest
} // namespace pcl
