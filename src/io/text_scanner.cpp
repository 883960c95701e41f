// SPDX-License-Identifier: BSD-3-Clause
#include "io/text_scanner.h"

namespace pcl {
namespace crest {

namespace {

bool
isLineEnd (char c)
{
  return c == '\n' || c == '\r';
}

} // namespace

void
splitAtBlanks (std::string_view line, std::vector<std::string_view>& words)
{
  std::size_t i = 0;
  while (i < line.size()) {
    while (i < line.size() && isBlank (line[i]))
      ++i;
    const std::size_t first = i;
    while (i < line.size() && !isBlank (line[i]))
      ++i;
    if (i > first)
      words.push_back (line.substr (first, i - first));
  }
}

void
TextScanner::skipLineEnd()
{
  if (position_ == text_.size())
    return;
  ++ended_;
  if (text_[position_++] == '\r' && position_ < text_.size() &&
      text_[position_] == '\n')
    ++position_;
}

bool
TextScanner::nextLine()
{
  words_.clear();
  while (position_ < text_.size() && words_.empty())
    continueLine();
  return !words_.empty();
}

bool
TextScanner::continueLine()
{
  if (position_ == text_.size())
    return false;
  if (!words_.empty() && words_.back() == "\\")
    words_.pop_back();
  std::string_view line = rawLine();
  if (comment_ != NO_COMMENTS)
    line = line.substr (0, line.find (comment_));
  splitAtBlanks (line, words_);
  return true;
}

std::string_view
TextScanner::rawLine()
{
  line_ = ended_ + 1;
  const std::size_t first = position_;
  while (position_ < text_.size() && !isLineEnd (text_[position_]))
    ++position_;
  const std::string_view line (text_.data() + first, position_ - first);
  skipLineEnd();
  return line;
}

std::string_view
TextScanner::nextWord()
{
  while (position_ < text_.size()) {
    const char c = text_[position_];
    if (isLineEnd (c))
      skipLineEnd();
    else if (isBlank (c))
      ++position_;
    else if (comment_ != NO_COMMENTS && c == comment_)
      rawLine();
    else
      break;
  }
  line_ = ended_ + 1;
  const std::size_t first = position_;
  while (position_ < text_.size() && !isBlank (text_[position_]) &&
         !isLineEnd (text_[position_]))
    ++position_;
  return {text_.data() + first, position_ - first};
}

std::string_view
TextScanner::bytes (std::size_t count, const std::string& what)
{
  if (count > remaining())
    throw ReadError (what + " should take " + std::to_string (count) +
                     " bytes, but the file ends after " + std::to_string (remaining()));
  position_ += count;
  return {text_.data() + position_ - count, count};
}

std::string
TextScanner::shown (std::string_view word)
{
  constexpr std::size_t LONGEST = 30;
  std::string text;
  for (const char c : word.substr (0, LONGEST))
    text += c >= ' ' && c <= '~' ? c : '?';
  return word.size() > LONGEST ? text + "..." : text;
}

} // namespace crest
} // namespace pcl
