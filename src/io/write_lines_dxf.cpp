// SPDX-License-Identifier: BSD-3-Clause
// DXF of release 12 (AC1009), which every program reads, as it is 3-D polylines.
#include <boost/algorithm/string/case_conv.hpp>

#include "io/line_file.h"

#include <array>
#include <sstream>

namespace pcl {
namespace crest {

namespace {

/** \brief Appends a code of DXF and its value, a line each. */
void
append (std::string& text, int code, const std::string& value)
{
  text += std::to_string (code) + "\n" + value + "\n";
}

std::string
layerOf (CrestType type)
{
  return boost::to_upper_copy (std::string (nameOf (type)));
}

/** \brief Of AutoCAD's colors. */
std::string
colorNumber (CrestType type)
{
  return type == CrestType::RIDGE ? "5" : "1";
}

void
appendLayers (std::string& text)
{
  append (text, 0, "TABLE");
  append (text, 2, "LAYER");
  append (text, 70, std::to_string (CREST_TYPES.size()));
  for (const CrestType type : CREST_TYPES) {
    append (text, 0, "LAYER");
    append (text, 2, layerOf (type));
    append (text, 70, "0");
    append (text, 62, colorNumber (type));
    append (text, 6, "CONTINUOUS");
  }
  append (text, 0, "ENDTAB");
}

void
appendPolyline (std::string& text,
                const LinePoints& points,
                CrestType type,
                const std::vector<index_t>& polyline)
{
  constexpr int IS_CLOSED = 1;
  constexpr int IS_3D = 8;
  constexpr int IS_VERTEX_OF_3D = 32;
  const std::string layer = layerOf (type);
  const bool closed = polyline.size() > 2 && polyline.front() == polyline.back();
  append (text, 0, "POLYLINE");
  append (text, 8, layer);
  append (text, 66, "1");
  for (const int code : {10, 20, 30})
    append (text, code, "0.0");
  append (text, 70, std::to_string (closed ? IS_3D + IS_CLOSED : IS_3D));
  for (std::size_t i = 0; i + (closed ? 1 : 0) < polyline.size(); ++i) {
    append (text, 0, "VERTEX");
    append (text, 8, layer);
    std::string place;
    points.appendPoint (place, polyline[i]);
    std::istringstream coordinates (place);
    std::string coordinate;
    for (const int code : {10, 20, 30}) {
      coordinates >> coordinate;
      append (text, code, coordinate);
    }
    append (text, 70, std::to_string (IS_VERTEX_OF_3D));
  }
  append (text, 0, "SEQEND");
  append (text, 8, layer);
}

} // namespace

std::string
toDxf (const LinePoints& points, const std::vector<CrestLine>& lines)
{
  std::string text;
  const auto section = [&text] (const char* name) {
    append (text, 0, "SECTION");
    append (text, 2, name);
  };
  section ("HEADER");
  append (text, 9, "$ACADVER");
  append (text, 1, "AC1009");
  append (text, 0, "ENDSEC");
  section ("TABLES");
  appendLayers (text);
  append (text, 0, "ENDSEC");
  section ("ENTITIES");
  for (const CrestLine& line : lines)
    for (const std::vector<index_t>& polyline : line.polylines)
      appendPolyline (text, points, line.type, polyline);
  append (text, 0, "ENDSEC");
  append (text, 0, "EOF");
  return text;
}

} // namespace crest
} // namespace pcl
