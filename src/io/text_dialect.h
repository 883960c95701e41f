// SPDX-License-Identifier: BSD-3-Clause
// How the rows of a text cloud are written, found from the rows themselves.
#pragma once

#include "io/parse_number.h"

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>
#include <vector>

namespace pcl {
namespace crest {

/** \brief What parts the words of a row, and whether decimals have a comma. */
struct TextDialect {
  /** '\t', ',', ';', or ' ' for any run of blanks and tabs */
  char separator = ' ';
  bool decimal_comma = false;
};

/** \brief Splits a row into words, free of blanks around them. A word may be empty, but
 * the one behind a separator at the end of the row is none.
 * \param[out] words views into the row
 */
void
splitRow (std::string_view row, char separator, std::vector<std::string_view>& words);

/** \brief Reads a number of a row; as crest::parseNumber. */
inline bool
parseNumber (std::string_view word, const TextDialect& dialect, double& number)
{
  if (!dialect.decimal_comma)
    return parseNumber (word, number);
  // Longer than any number is written.
  std::array<char, 64> with_point{};
  // "1," is a number and its separator, and "1.000,5" no number that is read here.
  if (word.size() > with_point.size() || word.find ('.') != std::string_view::npos ||
      (!word.empty() && word.back() == ','))
    return false;
  std::copy (word.begin(), word.end(), with_point.begin());
  const std::size_t comma = word.find (',');
  if (comma != std::string_view::npos)
    with_point[comma] = '.';
  return parseNumber (std::string_view (with_point.data(), word.size()), number);
}

/** \brief How many words most of the rows have, of which there is at least one; the
 * larger number where two are as common.
 */
std::size_t
commonestWidth (const std::vector<std::string_view>& rows, char separator);

/** \brief The dialect in which most of the rows have the same number of words, at least
 * three of which are numbers.
 * \param[in] rows some rows of the text
 * \param[in] columns how many words rows have to have; 0 if that is unknown
 * \return nothing if there is none in which half of the rows have
 */
std::optional<TextDialect>
findDialect (const std::vector<std::string_view>& rows, std::size_t columns);

/** \brief Whether commas may part whole numbers as well as whole numbers from their
 * decimals, as in 0,99976,-1,00925,0,00014.
 * \param[in] rows some rows of the text, whose separator is the comma
 */
bool
commasAreAmbiguous (const std::vector<std::string_view>& rows);

} // namespace crest
} // namespace pcl
