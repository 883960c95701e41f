// SPDX-License-Identifier: BSD-3-Clause
// Text with a point a line, in whatever dialect and with whatever columns.
#include <boost/algorithm/string/join.hpp>

#include "io/color_bytes.h"
#include "io/file_content.h"
#include "io/file_fields.h"
#include "io/text_columns.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>

namespace pcl {
namespace crest {

namespace {

class XyzReader {
public:
  XyzReader (const std::string& text, const std::vector<std::string>& columns)
  : text_ (text), rows_ (text)
  {
    const std::optional<TextHead> head = readHead (rows_);
    if (!head)
      return;
    announced_ = head->announced;
    std::size_t contiguous = 0;
    const std::vector<std::string_view> sample =
        sampleRows (text, rows_.row(), contiguous);
    findDialectOf (sample, columns);
    if (!columns.empty())
      columns_ = columnsGiven (columns);
    else {
      columns_ = columnsByName (*head, sample, dialect_);
      if (columns_.columns.empty())
        columns_ = columnsByValue (sample, contiguous, dialect_);
    }
    readPoints();
  }

  FileContent
  take ()
  {
    return std::move (content_);
  }

private:
  void
  findDialectOf (const std::vector<std::string_view>& sample,
                 const std::vector<std::string>& columns)
  {
    const auto dialect = findDialect (sample, columns.size());
    if (!dialect)
      rows_.fail (
          columns.empty()
              ? "expected at least 3 numbers, x y z, parted by blanks, tabs, commas or "
                "semicolons, found \"" +
                    TextScanner::shown (rows_.row()) + "\""
              : "expected the " + std::to_string (columns.size()) + " columns " +
                    boost::join (columns, ",") + " of -columns, found \"" +
                    TextScanner::shown (rows_.row()) + "\"");
    dialect_ = *dialect;
    if (columns.empty() && dialect_.separator == ',' && commasAreAmbiguous (sample))
      rows_.fail ("its commas may part the columns, or decimals from whole numbers: "
                  "-columns says that they part the columns; else part these by "
                  "semicolons");
  }

  void
  readPoints ()
  {
    content_.has_normals = columns_.has (PointField::NX) &&
                           columns_.has (PointField::NY) &&
                           columns_.has (PointField::NZ);
    const bool has_colors = columns_.has (PointField::RED) &&
                            columns_.has (PointField::GREEN) &&
                            columns_.has (PointField::BLUE);
    note();
    if (has_colors)
      addColorFields (content_.fields);
    for (const TextColumn& column : columns_.columns)
      if (!column.passes_as.empty())
        // PCL has intensities as floats.
        addField (content_.fields,
                  column.passes_as,
                  column.field == PointField::INTENSITY ? NumberType::FLOAT32
                                                        : NumberType::FLOAT64);
    // No row is shorter than "0 0 0" and the end of the line before it.
    const std::size_t most =
        1 + std::min<std::size_t> (rows_.remaining() / 6,
                                   std::count (text_.begin(), text_.end(), '\n') +
                                       std::count (text_.begin(), text_.end(), '\r'));
    content_.points.reserve (most);
    std::vector<std::array<float, 3>> colors;
    if (has_colors)
      colors.reserve (most);
    // Of several clouds in one file each has a row that announces its points.
    std::size_t end_of_cloud = announced_.value_or (0);
    do {
      if (announced_ && content_.points.size() == end_of_cloud) {
        const auto more = announcedPoints (rows_.row());
        if (!more)
          rows_.fail ("expected " + std::to_string (*announced_) +
                      " points, as the row above them announces, found more");
        announced_ = more;
        end_of_cloud += *more;
        continue;
      }
      readRow (addRecord (content_.fields) + (has_colors ? COLOR_SIZE : 0));
      content_.points.add (values_.data(), content_.has_normals);
      if (has_colors)
        colors.push_back ({static_cast<float> (values_[placeOf (PointField::RED)]),
                           static_cast<float> (values_[placeOf (PointField::GREEN)]),
                           static_cast<float> (values_[placeOf (PointField::BLUE)])});
    }
    while (rows_.next());
    if (announced_ && content_.points.size() != end_of_cloud)
      rows_.fail ("the file ends after " + std::to_string (content_.points.size()) +
                  " of the " + std::to_string (end_of_cloud) +
                  " points that it announces");
    setColors (colors);
  }

  /** \brief Says what the columns are, where that is not as plain as can be. */
  void
  note ()
  {
    std::string note;
    if (!columns_.found_by.empty())
      note = "The columns are " + columns_.describe() + ", " + columns_.found_by +
             (content_.has_normals ? "" : ", without normals");
    if (dialect_.decimal_comma)
      note += note.empty() ? "Decimals have commas" : "; decimals have commas";
    if (!note.empty())
      content_.notes.push_back (note + ".");
  }

  /** \param[out] record where numbers that pass through belong */
  void
  readRow (char* record)
  {
    splitRow (rows_.row(), dialect_.separator, words_);
    const std::size_t width = columns_.columns.size();
    // The last word may be as empty as any.
    if (words_.size() + 1 == width && dialect_.separator != ' ')
      words_.emplace_back();
    if (words_.size() != width)
      rows_.fail ("expected " + std::to_string (width) +
                  " columns as in the other lines, found " +
                  std::to_string (words_.size()));
    for (std::size_t i = 0; i < width; ++i) {
      const TextColumn& column = columns_.columns[i];
      if (!column.is_number)
        continue;
      double& value = values_[std::min (placeOf (column.field), KEPT_FIELDS)];
      if (words_[i].empty() && !isKept (column.field))
        value = std::numeric_limits<double>::quiet_NaN();
      else if (!parseNumber (words_[i], dialect_, value))
        rows_.fail ("expected a number in column " + std::to_string (i + 1) +
                    ", found \"" + TextScanner::shown (words_[i]) + "\"");
      if (!column.passes_as.empty())
        record = pass (value, column.field, record);
    }
  }

  /** \brief Writes a number that passes through; where the next one belongs. */
  static char*
  pass (double value, PointField field, char* record)
  {
    if (field != PointField::INTENSITY) {
      std::memcpy (record, &value, sizeof (value));
      return record + sizeof (value);
    }
    const auto intensity = static_cast<float> (value);
    std::memcpy (record, &intensity, sizeof (intensity));
    return record + sizeof (intensity);
  }

  void
  setColors (const std::vector<std::array<float, 3>>& colors)
  {
    content_.colors = colorBytes (colors);
    for (std::size_t i = 0; i < colors.size(); ++i)
      std::memcpy (content_.fields.records.data() + i * content_.fields.record_size,
                   content_.colors[i].data(),
                   COLOR_SIZE);
  }

  static constexpr std::size_t COLOR_SIZE = 3;

  const std::string& text_;
  RowScanner rows_;
  std::optional<std::size_t> announced_;
  TextDialect dialect_;
  TextColumns columns_;
  std::vector<std::string_view> words_;
  /** of a row, by their fields; one more for those that are not kept */
  std::array<double, KEPT_FIELDS + 1> values_{};
  FileContent content_;
};

} // namespace

FileContent
readXyz (const std::string& text, const std::vector<std::string>& columns)
{
  return XyzReader (text, columns).take();
}

} // namespace crest
} // namespace pcl
