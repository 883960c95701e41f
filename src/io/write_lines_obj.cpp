// SPDX-License-Identifier: BSD-3-Clause
#include "io/line_file.h"

namespace pcl {
namespace crest {

std::string
toObj (const LinePoints& points,
       const std::vector<CrestLine>& lines,
       const std::string& materials)
{
  std::string text = "mtllib " + materials + "\n";
  points.append (text, "v ");
  for (const CrestType type : CREST_TYPES) {
    bool first = true;
    for (const CrestLine& line : lines) {
      if (line.type != type)
        continue;
      if (first)
        text += std::string ("g ") + nameOf (type) + "\nusemtl " + nameOf (type) + "\n";
      first = false;
      for (const std::vector<index_t>& polyline : line.polylines) {
        text += 'l';
        for (const index_t point : polyline) {
          text += ' ';
          appendNumber (text, points.place (point) + 1);
        }
        text += '\n';
      }
    }
  }
  return text;
}

std::string
toMtl ()
{
  std::string text;
  for (const CrestType type : CREST_TYPES) {
    std::string color;
    for (const unsigned char channel : colorOf (type)) {
      color += ' ';
      appendNumber (color, static_cast<float> (channel) / 255.0F);
    }
    text += text.empty() ? "newmtl " : "\nnewmtl ";
    text += nameOf (type);
    for (const char* const light : {"\nKa", "\nKd"})
      text += light + color;
    text += "\nillum 0\n";
  }
  return text;
}

} // namespace crest
} // namespace pcl
