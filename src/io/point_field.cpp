// SPDX-License-Identifier: BSD-3-Clause
#include "io/point_field.h"

#include <cctype>
#include <string>
#include <utility>

namespace pcl {
namespace crest {

namespace {

constexpr std::pair<std::string_view, PointField> NAMES[] = {
    {"x", PointField::X},
    {"easting", PointField::X},
    {"east", PointField::X},
    {"points0", PointField::X}, // of ParaView's tables
    {"y", PointField::Y},
    {"northing", PointField::Y},
    {"north", PointField::Y},
    {"points1", PointField::Y},
    {"z", PointField::Z},
    {"elevation", PointField::Z},
    {"height", PointField::Z},
    {"altitude", PointField::Z},
    {"points2", PointField::Z},
    {"nx", PointField::NX},
    {"normalx", PointField::NX},
    {"normals0", PointField::NX},
    {"ny", PointField::NY},
    {"normaly", PointField::NY},
    {"normals1", PointField::NY},
    {"nz", PointField::NZ},
    {"normalz", PointField::NZ},
    {"normals2", PointField::NZ},
    {"r", PointField::RED},
    {"red", PointField::RED},
    {"rf", PointField::RED},
    {"diffusered", PointField::RED},
    {"g", PointField::GREEN},
    {"green", PointField::GREEN},
    {"gf", PointField::GREEN},
    {"diffusegreen", PointField::GREEN},
    {"b", PointField::BLUE},
    {"blue", PointField::BLUE},
    {"bf", PointField::BLUE},
    {"diffuseblue", PointField::BLUE},
    {"i", PointField::INTENSITY},
    {"intensity", PointField::INTENSITY},
    {"reflectance", PointField::INTENSITY},
};

/** \brief Lower case letters and digits alone. */
std::string
plain (std::string_view name)
{
  std::string letters;
  for (const unsigned char c : name.substr (0, name.find_first_of ("[(")))
    if (std::isalnum (c) != 0)
      letters += static_cast<char> (std::tolower (c));
  constexpr std::string_view PREFIX = "scalar";
  if (letters.compare (0, PREFIX.size(), PREFIX) == 0)
    letters.erase (0, PREFIX.size());
  return letters;
}

} // namespace

PointField
pointFieldOf (std::string_view name)
{
  const std::string wanted = plain (name);
  for (const auto& [known, field] : NAMES)
    if (known == wanted)
      return field;
  return PointField::NONE;
}

const char*
shortNameOf (PointField field)
{
  constexpr std::array<const char*, KEPT_FIELDS> SHORT_NAMES{
      "x", "y", "z", "nx", "ny", "nz", "r", "g", "b"};
  return isKept (field)                   ? SHORT_NAMES[placeOf (field)]
         : field == PointField::INTENSITY ? "intensity"
                                          : "-";
}

} // namespace crest
} // namespace pcl
