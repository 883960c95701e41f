// SPDX-License-Identifier: BSD-3-Clause
#include "io/file_fields.h"

#include <boost/algorithm/string/join.hpp>

#include "io/parse_number.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstring>
#include <limits>
#include <set>
#include <type_traits>

namespace pcl {
namespace crest {

namespace {

/** \brief What labelled points have of their own in any of their formats. */
const std::set<std::string>&
ownNames ()
{
  static const std::set<std::string> names{"x",
                                           "y",
                                           "z",
                                           "normal_x",
                                           "normal_y",
                                           "normal_z",
                                           "nx",
                                           "ny",
                                           "nz",
                                           "curvature",
                                           "label",
                                           "line",
                                           "strength"};
  return names;
}

/** \brief The nearest number of a type; NaN as 0 if that is whole. */
template <typename T>
T
nearest (double value)
{
  if constexpr (std::is_integral_v<T>) {
    constexpr auto LEAST = static_cast<double> (std::numeric_limits<T>::lowest());
    constexpr auto MOST = static_cast<double> (std::numeric_limits<T>::max());
    if (value >= MOST)
      return std::numeric_limits<T>::max();
    if (value <= LEAST)
      return std::numeric_limits<T>::lowest();
    if (std::isnan (value))
      return T();
  }
  return static_cast<T> (value);
}

/** \brief Calls a function with a number of a type; false if that is none. */
template <typename Function>
bool
withTypeOf (NumberType type, const Function& function)
{
  switch (type) {
  // NOLINTNEXTLINE(bugprone-branch-clone): each with another type
  case NumberType::INT8:
    return function (std::int8_t());
  case NumberType::UINT8:
    return function (std::uint8_t());
  case NumberType::INT16:
    return function (std::int16_t());
  case NumberType::UINT16:
    return function (std::uint16_t());
  case NumberType::INT32:
    return function (std::int32_t());
  case NumberType::UINT32:
    return function (std::uint32_t());
  case NumberType::INT64:
    return function (std::int64_t());
  case NumberType::UINT64:
    return function (std::uint64_t());
  case NumberType::FLOAT32:
    return function (float());
  case NumberType::FLOAT64:
    return function (double());
  case NumberType::NONE:
    break;
  }
  return false;
}

} // namespace

NumberType
typeOf (const FileFields::Field& field)
{
  return numberTypeOf (field.type, field.size);
}

void
addField (FileFields& fields,
          const std::string& name,
          NumberType type,
          std::size_t count)
{
  if (type == NumberType::NONE || count == 0)
    return;
  FileFields::Field field;
  field.name = name.empty() ? "_" : name;
  std::replace_if (
      field.name.begin(),
      field.name.end(),
      [] (unsigned char c) { return std::isgraph (c) == 0; },
      '_');
  field.type = letterOf (type);
  field.size = sizeOf (type);
  field.count = count;
  field.offset = fields.record_size;
  fields.record_size += field.size * count;
  fields.fields.push_back (std::move (field));
}

bool
encodeWord (std::string_view word, NumberType type, char* bytes)
{
  return withTypeOf (type, [word, bytes] (auto number) {
    double value = 0.0;
    if (!parseNumber (word, number)) {
      if (!parseNumber (word, value))
        return false;
      number = nearest<decltype (number)> (value);
    }
    std::memcpy (bytes, &number, sizeof (number));
    return true;
  });
}

void
encodeNumber (double number, NumberType type, char* bytes)
{
  withTypeOf (type, [number, bytes] (auto encoded) {
    encoded = nearest<decltype (encoded)> (number);
    std::memcpy (bytes, &encoded, sizeof (encoded));
    return true;
  });
}

void
addColorFields (FileFields& fields)
{
  for (const char* const name : {"red", "green", "blue"})
    addField (fields, name, NumberType::UINT8);
}

std::string
renameFields (FileFields& fields)
{
  std::set<std::string> taken = ownNames();
  for (const FileFields::Field& field : fields.fields)
    taken.insert (field.name);
  std::set<std::string> seen = ownNames();
  std::vector<std::string> before;
  std::vector<std::string> after;
  for (FileFields::Field& field : fields.fields) {
    if (seen.insert (field.name).second)
      continue;
    before.push_back (field.name);
    constexpr char PREFIX[] = "input_";
    std::string name = PREFIX + field.name;
    while (!taken.insert (name).second)
      name.insert (0, PREFIX);
    field.name = name;
    seen.insert (name);
    after.push_back (field.name);
  }
  if (before.empty())
    return {};
  const bool one = before.size() == 1;
  return "The " + std::string (one ? "field " : "fields ") +
         boost::join (before, ", ") + " of the file " + (one ? "is" : "are") +
         " written as " + boost::join (after, ", ") +
         ": labelled points have their own of " + (one ? "this name." : "these names.");
}

} // namespace crest
} // namespace pcl
