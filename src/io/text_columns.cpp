// SPDX-License-Identifier: BSD-3-Clause
#include "io/text_columns.h"

#include <boost/algorithm/string/join.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace pcl {
namespace crest {

namespace {

constexpr const char* TELL = ": -columns tells it, as in -columns x,y,z,-,nx,ny,nz";

/** \brief The numbers of some rows, all with the commonest number of columns; NaN where
 * there is no number.
 */
using Values = Eigen::ArrayXXd;

Values
readValues (const std::vector<std::string_view>& rows, const TextDialect& dialect)
{
  constexpr double NAN_VALUE = std::numeric_limits<double>::quiet_NaN();
  const std::size_t width = commonestWidth (rows, dialect.separator);
  Values values = Values::Constant (static_cast<Eigen::Index> (rows.size()),
                                    static_cast<Eigen::Index> (width),
                                    NAN_VALUE);
  std::vector<std::string_view> words;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    splitRow (rows[i], dialect.separator, words);
    for (std::size_t j = 0; j < std::min (width, words.size()); ++j)
      parseNumber (
          words[j],
          dialect,
          values (static_cast<Eigen::Index> (i), static_cast<Eigen::Index> (j)));
  }
  return values;
}

/** \brief Whether half of the words of a column, or more, are numbers. */
bool
isNumeric (const std::vector<std::string_view>& rows,
           const TextDialect& dialect,
           std::size_t column)
{
  std::vector<std::string_view> words;
  std::size_t numbers = 0;
  double ignored = 0.0;
  for (const std::string_view row : rows) {
    splitRow (row, dialect.separator, words);
    numbers += column < words.size() && parseNumber (words[column], dialect, ignored);
  }
  return 2 * numbers >= rows.size();
}

bool
isWhole (const Values& values, Eigen::Index column)
{
  return (values.col (column) == values.col (column).floor()).all();
}

/** \brief Whether the whole numbers count up by one in the rows that follow each other,
 * and upward in those that do not.
 */
bool
countsUp (const Values& values, std::size_t contiguous, Eigen::Index column)
{
  if (values.rows() < 2 || !isWhole (values, column))
    return false;
  for (Eigen::Index i = 1; i < values.rows(); ++i) {
    const double step = values (i, column) - values (i - 1, column);
    if (static_cast<std::size_t> (i) < contiguous ? step != 1.0 : !(step > 0.0))
      return false;
  }
  return true;
}

/** \brief Whether whole numbers that are all different, as those of points are, stand
 * before three columns of which none has whole numbers.
 */
bool
looksLikeNumbersOfPoints (const Values& values,
                          const std::vector<Eigen::Index>& numbers)
{
  constexpr Eigen::Index LEAST = 3;
  if (numbers.size() < 4 || values.rows() < LEAST || !isWhole (values, numbers[0]) ||
      std::any_of (numbers.begin() + 1, numbers.begin() + 4, [&] (Eigen::Index column) {
        return isWhole (values, column);
      }))
    return false;
  const auto first = values.col (numbers[0]);
  return std::set<double> (first.begin(), first.end()).size() ==
         static_cast<std::size_t> (values.rows());
}

/** \brief Whether most of the three columns' rows that are not zero have length 1. */
bool
areUnitVectors (const Values& values, Eigen::Index first)
{
  // Two decimals of each component are enough.
  constexpr double TOLERANCE = 0.02;
  Eigen::Index unit = 0;
  Eigen::Index other = 0;
  for (Eigen::Index i = 0; i < values.rows(); ++i) {
    const double length = values.block<1, 3> (i, first).matrix().norm();
    if (std::abs (length - 1.0) <= TOLERANCE)
      ++unit;
    else if (length > 0.0)
      ++other;
  }
  return unit > 0 && 20 * other <= unit;
}

bool
areColors (const Values& values, Eigen::Index first)
{
  const auto block = values.middleCols (first, 3);
  if (!(block >= 0.0).all())
    return false;
  const double most = block.maxCoeff();
  const bool whole = (block == block.floor()).all();
  return whole ? most > 1.0 && most <= 255.0 : most <= 1.0;
}

/** \brief Of the columns that are left, the starts of three beside each other for which
 * something holds.
 */
template <typename Predicate>
std::vector<Eigen::Index>
tripleStarts (const std::vector<bool>& is_left, const Predicate& holds)
{
  std::vector<Eigen::Index> starts;
  for (std::size_t i = 0; i + 2 < is_left.size(); ++i)
    if (is_left[i] && is_left[i + 1] && is_left[i + 2] &&
        holds (static_cast<Eigen::Index> (i)))
      starts.push_back (static_cast<Eigen::Index> (i));
  return starts;
}

void
assign (PointField first_field,
        Eigen::Index first_column,
        std::vector<TextColumn>& columns,
        std::vector<bool>& is_left)
{
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t column = static_cast<std::size_t> (first_column) + i;
    columns[column].field = static_cast<PointField> (placeOf (first_field) + i);
    is_left[column] = false;
  }
}

std::string
numbered (Eigen::Index first)
{
  return std::to_string (first + 1) + " to " + std::to_string (first + 3);
}

/** \brief The names of a row of them, parted as its points or otherwise. */
std::vector<std::string_view>
splitNames (std::string_view names, char separator, std::size_t width)
{
  std::vector<std::string_view> words;
  for (const char other : {separator, ';', '\t', ',', ' '}) {
    splitRow (names, other, words);
    if (words.size() == width)
      break;
  }
  return words;
}

} // namespace

bool
TextColumns::has (PointField field) const
{
  return std::any_of (columns.begin(), columns.end(), [field] (const TextColumn& c) {
    return c.field == field;
  });
}

std::string
TextColumns::describe() const
{
  std::vector<std::string> names;
  names.reserve (columns.size());
  for (const TextColumn& column : columns)
    names.emplace_back (shortNameOf (column.field));
  return boost::join (names, ",");
}

std::string
explainInvalidColumns (const std::vector<std::string>& names)
{
  std::set<PointField> given;
  for (const std::string& name : names) {
    const PointField field = pointFieldOf (name);
    if (field == PointField::NONE ? name != "-" : !given.insert (field).second)
      return field == PointField::NONE
                 ? "there is no column \"" + name +
                       "\": there are x y z nx ny nz r g b intensity and -"
                 : "the column " + name + " is given twice";
  }
  for (const PointField field : {PointField::X, PointField::Y, PointField::Z})
    if (given.count (field) == 0)
      return "the columns lack " + std::string (shortNameOf (field));
  return {};
}

TextColumns
columnsGiven (const std::vector<std::string>& names)
{
  TextColumns result;
  for (const std::string& name : names) {
    const PointField field = pointFieldOf (name);
    result.columns.push_back ({field, isKept (field)});
    if (field == PointField::INTENSITY)
      result.columns.back().passes_as = name;
  }
  return result;
}

TextColumns
columnsByName (const TextHead& head,
               const std::vector<std::string_view>& rows,
               const TextDialect& dialect)
{
  TextColumns result;
  if (head.names.empty())
    return result;
  const std::size_t width = commonestWidth (rows, dialect.separator);
  const std::vector<std::string_view> names =
      splitNames (head.names, dialect.separator, width);
  bool ambiguous = false;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const PointField field = pointFieldOf (names[i]);
    ambiguous = ambiguous || (isKept (field) && result.has (field));
    result.columns.push_back ({field, isKept (field) || isNumeric (rows, dialect, i)});
    if (!isKept (field) && result.columns.back().is_number)
      result.columns.back().passes_as = std::string (names[i]);
  }
  if (!ambiguous && names.size() == width && result.has (PointField::X) &&
      result.has (PointField::Y) && result.has (PointField::Z)) {
    result.found_by = "by their names";
    return result;
  }
  if (head.names_are_comment)
    return {};
  throw ReadError ("the " + std::to_string (width) + " columns have the names \"" +
                   TextScanner::shown (head.names) +
                   "\", which do not tell for each of x, y and z which one it is" +
                   TELL);
}

TextColumns
columnsByValue (const std::vector<std::string_view>& rows,
                std::size_t contiguous,
                const TextDialect& dialect)
{
  const Values values = readValues (rows, dialect);
  TextColumns result;
  result.columns.resize (static_cast<std::size_t> (values.cols()));
  std::vector<Eigen::Index> numbers;
  for (std::size_t i = 0; i < result.columns.size(); ++i) {
    result.columns[i].is_number = isNumeric (rows, dialect, i);
    if (result.columns[i].is_number)
      numbers.push_back (static_cast<Eigen::Index> (i));
  }
  if (numbers.size() > 3 && countsUp (values, contiguous, numbers[0]))
    numbers.erase (numbers.begin());
  else if (looksLikeNumbersOfPoints (values, numbers))
    throw ReadError ("column " + std::to_string (numbers[0] + 1) +
                     " may be x, or the number of the point" + TELL);
  if (numbers.size() < 3 || numbers[2] != numbers[0] + 2)
    throw ReadError ("its columns do not begin with three numbers beside each other, "
                     "x y z" +
                     std::string (TELL));

  std::vector<bool> is_left (result.columns.size(), false);
  for (const Eigen::Index column : numbers)
    is_left[static_cast<std::size_t> (column)] = true;
  assign (PointField::X, numbers[0], result.columns, is_left);
  const std::vector<Eigen::Index> normals = tripleStarts (
      is_left, [&] (Eigen::Index first) { return areUnitVectors (values, first); });
  if (normals.size() > 1)
    throw ReadError ("columns " + numbered (normals[0]) + " and " +
                     numbered (normals[1]) + " may be normals" + TELL);
  if (!normals.empty())
    assign (PointField::NX, normals[0], result.columns, is_left);
  const std::vector<Eigen::Index> colors = tripleStarts (
      is_left, [&] (Eigen::Index first) { return areColors (values, first); });
  // Colors decide nothing: where they are in doubt there are none.
  if (colors.size() == 1)
    assign (PointField::RED, colors[0], result.columns, is_left);
  if (result.columns.size() > 3)
    result.found_by = "by their values";
  return result;
}

} // namespace crest
} // namespace pcl
