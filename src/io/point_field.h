// SPDX-License-Identifier: BSD-3-Clause
// What programs call the numbers of a point, in every format that names them.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace pcl {
namespace crest {

/** \brief A number of a point; those up to BLUE are the ones that clouds keep. */
enum class PointField { X, Y, Z, NX, NY, NZ, RED, GREEN, BLUE, INTENSITY, NONE };

/** \brief How many fields clouds keep: places in a point's values. */
constexpr std::size_t KEPT_FIELDS = 9;

constexpr std::size_t
placeOf (PointField field)
{
  return static_cast<std::size_t> (field);
}

constexpr bool
isKept (PointField field)
{
  return placeOf (field) < KEPT_FIELDS;
}

/** \brief What a field is by its name, in upper or lower case, with or without
 * underscores, CloudCompare's "scalar_" in front or a unit in brackets behind.
 */
PointField
pointFieldOf (std::string_view name);

/** \brief The short name, as in "nx"; "-" of those that clouds do not keep. */
const char*
shortNameOf (PointField field);

} // namespace crest
} // namespace pcl
