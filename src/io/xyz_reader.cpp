// SPDX-License-Identifier: BSD-3-Clause
// Text with a point a line: x y z, or x y z nx ny nz.
#include "io/file_content.h"

#include <cmath>

namespace pcl {
namespace crest {

FileContent
readXyz (const std::string& text)
{
  TextScanner scanner (text, '#');
  FileContent content;
  std::size_t columns = 0;
  bool like_colors = true;
  bool above_one = false;
  while (scanner.nextLine()) {
    const std::vector<std::string_view>& words = scanner.words();
    if (words[0].substr (0, 2) == "//")
      continue;
    if (columns == 0)
      columns = words.size();
    if (columns != 3 && columns != 6)
      scanner.fail ("expected 3 numbers (x y z) or 6 (x y z nx ny nz), found " +
                    std::to_string (columns) + " words");
    if (words.size() != columns)
      scanner.fail ("expected " + std::to_string (columns) +
                    " numbers as in the lines before, found " +
                    std::to_string (words.size()) + " words");
    double values[6];
    for (std::size_t i = 0; i < columns; ++i)
      values[i] = scanner.number<double> (words[i], "a number");
    for (std::size_t i = 3; i < columns; ++i) {
      like_colors = like_colors && values[i] >= 0.0 && values[i] <= 255.0 &&
                    values[i] == std::floor (values[i]);
      above_one = above_one || values[i] > 1.0;
    }
    content.points->push_back (makePoint (values, columns == 6));
  }
  content.has_normals = columns == 6 && !(like_colors && above_one);
  if (columns == 6 && !content.has_normals)
    content.notes.push_back ("Columns 4 to 6 are whole numbers from 0 to 255, that is "
                             "colors, and are not used as normals.");
  return content;
}

} // namespace crest
} // namespace pcl
