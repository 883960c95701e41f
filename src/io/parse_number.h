// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <charconv>
#include <limits>
#include <string_view>

namespace pcl {
namespace crest {

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
      const bool tiny = word.find ("e-") != std::string_view::npos ||
                        word.find ("E-") != std::string_view::npos;
      parsed = tiny ? T (0) : std::numeric_limits<T>::infinity();
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
