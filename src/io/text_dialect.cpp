// SPDX-License-Identifier: BSD-3-Clause
#include "io/text_dialect.h"

#include "io/text_scanner.h"

#include <cctype>
#include <functional>
#include <map>

namespace pcl {
namespace crest {

namespace {

constexpr std::size_t LEAST_COLUMNS = 3;

std::string_view
trimmed (std::string_view word)
{
  while (!word.empty() && isBlank (word.front()))
    word.remove_prefix (1);
  while (!word.empty() && isBlank (word.back()))
    word.remove_suffix (1);
  return word;
}

/** \brief How many of the rows have the commonest number of words, or the wanted one,
 * and at least three numbers among them.
 */
std::size_t
countFittingRows (const std::vector<std::string_view>& rows,
                  const TextDialect& dialect,
                  std::size_t columns)
{
  if (columns == 0)
    columns = commonestWidth (rows, dialect.separator);
  if (columns < LEAST_COLUMNS)
    return 0;
  std::vector<std::string_view> words;
  std::size_t fitting = 0;
  for (const std::string_view row : rows) {
    splitRow (row, dialect.separator, words);
    double ignored = 0.0;
    const auto numbers =
        std::count_if (words.begin(), words.end(), [&] (std::string_view word) {
          return parseNumber (word, dialect, ignored);
        });
    fitting +=
        words.size() == columns && static_cast<std::size_t> (numbers) >= LEAST_COLUMNS;
  }
  return fitting;
}

bool
isWhole (std::string_view word)
{
  if (!word.empty() && (word.front() == '-' || word.front() == '+'))
    word.remove_prefix (1);
  return !word.empty() && std::all_of (word.begin(), word.end(), [] (unsigned char c) {
    return std::isdigit (c) != 0;
  });
}

} // namespace

void
splitRow (std::string_view row, char separator, std::vector<std::string_view>& words)
{
  words.clear();
  if (separator == ' ') {
    splitAtBlanks (row, words);
    return;
  }
  row = trimmed (row);
  while (!row.empty()) {
    const std::size_t end = std::min (row.find (separator), row.size());
    words.push_back (trimmed (row.substr (0, end)));
    row.remove_prefix (std::min (end + 1, row.size()));
  }
}

std::size_t
commonestWidth (const std::vector<std::string_view>& rows, char separator)
{
  std::map<std::size_t, std::size_t, std::greater<>> rows_of_width;
  std::vector<std::string_view> words;
  for (const std::string_view row : rows) {
    splitRow (row, separator, words);
    ++rows_of_width[words.size()];
  }
  return std::max_element (
             rows_of_width.begin(),
             rows_of_width.end(),
             [] (const auto& a, const auto& b) { return a.second < b.second; })
      ->first;
}

std::optional<TextDialect>
findDialect (const std::vector<std::string_view>& rows, std::size_t columns)
{
  // Of those that fit as many rows the first: what reads the same in two of them, as
  // whole numbers do with either decimal, reads so in the first.
  constexpr std::array<TextDialect, 7> DIALECTS{{{';', false},
                                                 {';', true},
                                                 {'\t', false},
                                                 {'\t', true},
                                                 {',', false},
                                                 {' ', false},
                                                 {' ', true}}};
  std::optional<TextDialect> best;
  if (rows.empty())
    return best;
  std::size_t most = (rows.size() - 1) / 2;
  for (const TextDialect& dialect : DIALECTS) {
    const std::size_t fitting = countFittingRows (rows, dialect, columns);
    if (fitting > most) {
      most = fitting;
      best = dialect;
    }
  }
  return best;
}

bool
commasAreAmbiguous (const std::vector<std::string_view>& rows)
{
  std::vector<std::string_view> words;
  bool leading_zero = false;
  bool same_length = true;
  std::size_t length = 0;
  for (const std::string_view row : rows) {
    splitRow (row, ',', words);
    if (words.size() < 2 * LEAST_COLUMNS || words.size() % 2 != 0 ||
        !std::all_of (words.begin(), words.end(), isWhole))
      return false;
    for (std::size_t i = 1; i < words.size(); i += 2) {
      const std::string_view decimals = words[i];
      if (std::isdigit (static_cast<unsigned char> (decimals.front())) == 0)
        return false;
      leading_zero = leading_zero || (decimals.size() > 1 && decimals.front() == '0');
      length = length == 0 ? decimals.size() : length;
      same_length = same_length && decimals.size() == length;
    }
  }
  return leading_zero || (same_length && length > 1);
}

} // namespace crest
} // namespace pcl
