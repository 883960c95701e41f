// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io/parse_number.h"

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace pcl {
namespace crest {

/** \brief What is wrong with the content of a file. Stays inside the library: readCloud
 * turns it into its message.
 */
class ReadError : public std::runtime_error {
public:
  explicit ReadError (const std::string& what, std::size_t line = 0)
  : std::runtime_error (what), line_ (line)
  {}

  /** \brief The line where it is, from 1; 0 where lines mean nothing. */
  std::size_t
  line () const
  {
    return line_;
  }

private:
  std::size_t line_;
};

/** \brief Whether it parts words within a line. */
inline bool
isBlank (char c)
{
  return c == ' ' || c == '\t' || c == '\v' || c == '\f';
}

/** \brief Appends the words of a line that blanks part; views into the line. */
void
splitAtBlanks (std::string_view line, std::vector<std::string_view>& words);

/** \brief Walks through a text by lines or by words, and through blocks of bytes
 * within it. Lines may end in LF, CR LF or CR.
 */
class TextScanner {
public:
  static constexpr char NO_COMMENTS = '\0';

  /** \brief \param[in] text must outlive the scanner
   * \param[in] comment starts a comment that ends with its line
   */
  TextScanner (const std::string& text, char comment) : text_ (text), comment_ (comment)
  {}

  /** \brief Goes to the next line with a word in it; false at the end of the text. */
  bool
  nextLine ();

  /** \brief Adds the words of the line that follows to those of this one, in place of
   * a backslash at its end.
   */
  bool
  continueLine ();

  /** \brief The words of the line that nextLine went to. */
  const std::vector<std::string_view>&
  words () const
  {
    return words_;
  }

  /** \brief The next line as it is, which may be empty. */
  std::string_view
  rawLine ();

  /** \brief The next word, wherever lines end; empty at the end of the text. */
  std::string_view
  nextWord ();

  /** \brief The bytes that follow; an error naming what they are if there are fewer. */
  std::string_view
  bytes (std::size_t count, const std::string& what);

  /** \brief How many bytes follow. */
  std::size_t
  remaining () const
  {
    return text_.size() - position_;
  }

  /** \brief The number that a word is; an error naming what was expected if none. */
  template <typename T>
  T
  number (std::string_view word, const std::string& what) const
  {
    T value{};
    if (!parseNumber (word, value))
      fail (word.empty() ? "the file ends where " + what + " was expected"
                         : "expected " + what + ", found \"" + shown (word) + "\"");
    return value;
  }

  /** \brief From here on errors name no line: the file goes on in binary. */
  void
  forgetLines ()
  {
    has_lines_ = false;
  }

  [[noreturn]] void
  fail (const std::string& what) const
  {
    throw ReadError (what, has_lines_ ? line_ : 0);
  }

  /** \brief A word of the file as messages can show it: short and printable. */
  static std::string
  shown (std::string_view word);

private:
  void
  skipLineEnd ();

  const std::string& text_;
  char comment_;
  std::size_t position_ = 0;
  /** the line of what was read last */
  std::size_t line_ = 0;
  /** how many lines have ended before position_ */
  std::size_t ended_ = 0;
  bool has_lines_ = true;
  std::vector<std::string_view> words_;
};

} // namespace crest
} // namespace pcl
