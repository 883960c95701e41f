// SPDX-License-Identifier: BSD-3-Clause
#include "io/line_file.h"

namespace pcl {
namespace crest {

std::string
toPly (const LinePoints& points, const std::vector<CrestLine>& lines)
{
  std::string edges;
  std::string polylines;
  std::string measures;
  std::size_t polyline_count = 0;
  std::size_t edge_count = 0;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const CrestLine& line = lines[i];
    const std::string color = colorText (colorOf (line.type));
    for (std::size_t p = 0; p < line.polylines.size(); ++p) {
      const std::vector<index_t>& polyline = line.polylines[p];
      for (std::size_t j = 1; j < polyline.size(); ++j) {
        appendNumber (edges, points.place (polyline[j - 1]));
        edges += ' ';
        appendNumber (edges, points.place (polyline[j]));
        edges += ' ' + color + ' ';
        appendNumber (edges, static_cast<int> (line.type));
        edges += ' ';
        appendNumber (edges, i);
        edges += ' ';
        appendNumber (edges, polyline_count);
        edges += '\n';
        ++edge_count;
      }
      appendNumber (polylines, i);
      for (const LineEnd end : line.ends[p]) {
        polylines += ' ';
        appendNumber (polylines, static_cast<int> (end));
      }
      polylines += '\n';
      ++polyline_count;
    }
    appendNumber (measures, static_cast<int> (line.type));
    for (const Measure& measure : MEASURES) {
      measures += ' ';
      appendMeasure (measures, measure, line);
    }
    measures += '\n';
  }
  const std::string type = points.hasDoubles() ? "double" : "float";
  const std::string colors =
      "property uchar red\nproperty uchar green\nproperty uchar blue\n";
  std::string text = "ply\nformat ascii 1.0\ncomment type 1 is a ridge, 2 a valley\n"
                     "comment ends: 0 free, 1 junction, 2 boundary, 3 closed\n"
                     "element vertex " +
                     std::to_string (points.size()) + "\nproperty " + type +
                     " x\nproperty " + type + " y\nproperty " + type + " z\n" + colors +
                     "element edge " + std::to_string (edge_count) +
                     "\nproperty int vertex1\nproperty int vertex2\n" + colors +
                     "property uchar type\nproperty int line\nproperty int polyline\n"
                     "element polyline " +
                     std::to_string (polyline_count) +
                     "\nproperty int line\nproperty uchar first_end\n"
                     "property uchar last_end\nelement line " +
                     std::to_string (lines.size()) + "\nproperty uchar type\n";
  for (const Measure& measure : MEASURES)
    text += std::string ("property ") + (measure.whole ? "int " : "double ") +
            measure.name + "\n";
  text += "end_header\n";
  points.append (text, "", &colorText);
  return text + edges + polylines + measures;
}

} // namespace crest
} // namespace pcl
