// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <charconv>
#include <string>

namespace pcl {
namespace crest {

/** \brief Appends a number, whatever the locale; a floating point number in as few
 * digits as give the same number when read again.
 */
template <typename T>
void
appendNumber (std::string& text, T number)
{
  char digits[40];
  const std::to_chars_result result =
      std::to_chars (digits, digits + sizeof (digits), number);
  text.append (digits, result.ptr);
}

} // namespace crest
} // namespace pcl
