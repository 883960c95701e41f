// SPDX-License-Identifier: BSD-3-Clause
// A line a feature, as programs for maps read them: GeoJSON (RFC 7946, but in the
// coordinates of the cloud, whatever these are) and CSV with the geometry as WKT, which
// GDAL's driver and QGIS find by the name of its column.
#include <boost/algorithm/string/replace.hpp>

#include "io/line_file.h"

namespace pcl {
namespace crest {

namespace {

/** \brief Appends all polylines of a line.
 * \param[in] brackets those of lists
 * \param[in] space what parts coordinates
 * \param[in] of_points whether points have brackets, too
 */
void
appendPolylines (std::string& text,
                 const LinePoints& points,
                 const CrestLine& line,
                 const char (&brackets)[3],
                 char space,
                 bool of_points)
{
  text += brackets[0];
  for (const std::vector<index_t>& polyline : line.polylines) {
    if (text.back() == brackets[1])
      text += ',';
    text += brackets[0];
    for (std::size_t i = 0; i < polyline.size(); ++i) {
      if (i != 0)
        text += ',';
      std::string place;
      points.appendPoint (place, polyline[i]);
      for (char& c : place)
        c = c == ' ' ? space : c;
      text += of_points ? brackets[0] + place + brackets[1] : place;
    }
    text += brackets[1];
  }
  text += brackets[1];
}

} // namespace

std::string
toGeoJson (const LinePoints& points, const std::vector<CrestLine>& lines)
{
  std::string text = "{\"type\": \"FeatureCollection\", ";
  // As GDAL writes and reads it. Longitude and latitude of WGS 84 need no word.
  if (!points.crs().empty() && points.crs() != "EPSG:4326")
    text +=
        "\"crs\": {\"type\": \"name\", \"properties\": {\"name\": \"urn:ogc:def:crs:" +
        boost::replace_first_copy (points.crs(), ":", "::") + "\"}}, ";
  text += "\"features\": [";
  for (std::size_t i = 0; i < lines.size(); ++i) {
    text += std::string (i == 0 ? "\n" : ",\n") +
            "{\"type\": \"Feature\", \"id\": " + std::to_string (i) +
            ", \"properties\": {\"id\": " + std::to_string (i) + ", \"type\": \"" +
            nameOf (lines[i].type) + "\"";
    for (const Measure& measure : MEASURES) {
      text += std::string (", \"") + measure.name + "\": ";
      appendMeasure (text, measure, lines[i]);
    }
    text += "}, \"geometry\": {\"type\": \"MultiLineString\", \"coordinates\": ";
    appendPolylines (text, points, lines[i], "[]", ',', true);
    text += "}}";
  }
  return text + "\n]}\n";
}

std::string
toCsv (const LinePoints& points, const std::vector<CrestLine>& lines)
{
  std::string text = "id,type,length,strength,vertices,WKT\n";
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const CrestLine& line = lines[i];
    text += std::to_string (i) + "," + nameOf (line.type) + ",";
    appendNumber (text, line.length);
    text += ',';
    appendNumber (text, line.strength);
    text += "," + std::to_string (line.size) + ",\"MULTILINESTRING Z ";
    appendPolylines (text, points, line, "()", ' ', false);
    text += "\"\n";
  }
  return text;
}

} // namespace crest
} // namespace pcl
