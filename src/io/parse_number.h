// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string_view>

namespace pcl {
namespace crest {

/** \brief Whether a number in digits, not 0, is less than 1, but for its sign. */
inline bool
isBelowOne (std::string_view digits)
{
  const std::size_t mark = digits.find_first_of ("eE");
  std::string_view power = mark == std::string_view::npos ? std::string_view ("0")
                                                          : digits.substr (mark + 1);
  if (power[0] == '+')
    power.remove_prefix (1);
  constexpr std::int64_t BEYOND_ANY_TEXT = std::int64_t (1) << 62U;
  std::int64_t exponent = power[0] == '-' ? -BEYOND_ANY_TEXT : BEYOND_ANY_TEXT;
  std::from_chars (power.data(), power.data() + power.size(), exponent);
  const std::string_view mantissa = digits.substr (0, mark);
  const auto point =
      static_cast<std::int64_t> (std::min (mantissa.find ('.'), mantissa.size()));
  const auto first = static_cast<std::int64_t> (mantissa.find_first_of ("123456789"));
  return (first < point ? point - first - 1 : point - first) + exponent < 0;
}

/** \brief Reads a number that takes up the whole word, whatever the locale.
 *
 * A floating point number too large for its type becomes infinite, one too small zero,
 * as when it is computed; an integer that does not fit is no number.
 *
 * \return whether the word is a number; if not, the number is untouched
 */
template <typename T>
bool
parseNumber (std::string_view word, T& number)
{
  if (word.size() > 1 && word[0] == '+' && word[1] != '-')
    word.remove_prefix (1);
  T parsed{};
  const char* const end = word.data() + word.size();
  const std::from_chars_result result = std::from_chars (word.data(), end, parsed);
  if (result.ptr != end || result.ec == std::errc::invalid_argument)
    return false;
  if (result.ec == std::errc::result_out_of_range) {
    if constexpr (std::numeric_limits<T>::has_infinity) {
      parsed = isBelowOne (word) ? T (0) : std::numeric_limits<T>::infinity();
      if (word[0] == '-')
        parsed = -parsed;
    }
    else
      return false;
  }
  number = parsed;
  return true;
}

} // namespace crest
} // namespace pcl
