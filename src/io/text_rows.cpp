// SPDX-License-Identifier: BSD-3-Clause
#include "io/text_rows.h"

#include <algorithm>

namespace pcl {
namespace crest {

namespace {

constexpr std::string_view BLANKS = " \t\v\f";
constexpr std::string_view SEPARATORS = " \t\v\f,;";

/** \brief Cuts a comment off a row; what it says where the row is nothing else. */
std::string_view
cutComment (std::string_view& row)
{
  const std::size_t first = std::min (row.find_first_not_of (BLANKS), row.size());
  row.remove_prefix (first);
  if (row.substr (0, 2) == "//") {
    const std::string_view comment = row.substr (2);
    row = {};
    return comment;
  }
  const std::size_t sign = row.find ('#');
  if (sign == std::string_view::npos)
    return {};
  const std::string_view comment = sign == 0 ? row.substr (1) : std::string_view();
  row = row.substr (0, sign);
  return comment;
}

/** \brief Whether any word of a row is a number, whatever parts them. */
bool
hasNumber (std::string_view row)
{
  while (!row.empty()) {
    const std::size_t end = std::min (row.find_first_of (SEPARATORS), row.size());
    double ignored = 0.0;
    if (parseNumber (row.substr (0, end), ignored))
      return true;
    row.remove_prefix (std::min (end + 1, row.size()));
  }
  return false;
}

} // namespace

RowScanner::RowScanner (const std::string& text)
: scanner_ (text, TextScanner::NO_COMMENTS)
{
  constexpr std::string_view BYTE_ORDER_MARK = "\xEF\xBB\xBF";
  if (text.compare (0, BYTE_ORDER_MARK.size(), BYTE_ORDER_MARK) == 0)
    scanner_.bytes (BYTE_ORDER_MARK.size(), "the byte-order mark");
}

bool
RowScanner::next()
{
  while (scanner_.remaining() > 0) {
    row_ = scanner_.rawLine();
    const std::string_view comment = cutComment (row_);
    if (!comment.empty())
      comment_ = comment;
    if (row_.find_first_not_of (BLANKS) != std::string_view::npos)
      return true;
  }
  return false;
}

std::optional<std::size_t>
announcedPoints (std::string_view row)
{
  const std::size_t first = std::min (row.find_first_not_of (SEPARATORS), row.size());
  row.remove_prefix (first);
  row = row.substr (0, row.find_last_not_of (SEPARATORS) + 1);
  std::size_t points = 0;
  if (parseNumber (row, points))
    return points;
  return {};
}

std::optional<TextHead>
readHead (RowScanner& rows)
{
  TextHead head;
  while (rows.next()) {
    const std::string_view row = rows.row();
    if (row.substr (0, 5) == "ncols" || row.substr (0, 5) == "NCOLS")
      rows.fail ("it is a grid of heights (ESRI ASCII), but a point a line is needed: "
                 "gdal_translate -of XYZ makes that of it");
    if (const auto points = announcedPoints (row))
      head.announced = points;
    else if (hasNumber (row)) {
      if (head.names.empty()) {
        head.names = rows.comment();
        head.names_are_comment = true;
      }
      return head;
    }
    else
      head.names = row;
  }
  return {};
}

std::vector<std::string_view>
sampleRows (const std::string& text, std::string_view first, std::size_t& contiguous)
{
  constexpr std::size_t CHUNKS = 16;
  constexpr std::size_t ROWS_OF_CHUNK = 256;
  std::vector<std::string_view> sample;
  const auto begin = static_cast<std::size_t> (first.data() - text.data());
  const std::size_t step = (text.size() - begin) / CHUNKS;
  std::size_t end = begin;
  contiguous = 0;
  for (std::size_t chunk = 0; chunk < CHUNKS; ++chunk) {
    std::size_t position = std::max (end, begin + chunk * step);
    // Into the middle of a line, of which nothing is known.
    if (position > end)
      position = std::min (text.find_first_of ("\r\n", position), text.size());
    for (std::size_t row = 0; row < ROWS_OF_CHUNK && position < text.size(); ++row) {
      end = std::min (text.find_first_of ("\r\n", position), text.size());
      std::string_view line (text.data() + position, end - position);
      cutComment (line);
      if (line.find_first_not_of (BLANKS) != std::string_view::npos &&
          !announcedPoints (line))
        sample.push_back (line);
      position = std::min (end + 1, text.size());
      end = position;
    }
    if (chunk == 0)
      contiguous = sample.size();
  }
  return sample;
}

} // namespace crest
} // namespace pcl
