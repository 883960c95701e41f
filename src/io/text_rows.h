// SPDX-License-Identifier: BSD-3-Clause
// A text cloud by its rows: what stands above them, and samples of them.
#pragma once

#include "io/text_scanner.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pcl {
namespace crest {

/** \brief Walks through the lines of a text that are neither empty nor comments, which
 * begin with # or //. A byte-order mark at the start is passed over.
 */
class RowScanner {
public:
  /** \brief \param[in] text must outlive the scanner */
  explicit RowScanner (const std::string& text);

  /** \brief Goes to the next row; false at the end of the text. */
  bool
  next ();

  /** \brief The row that next went to, without a comment behind it. */
  std::string_view
  row () const
  {
    return row_;
  }

  /** \brief The last comment before the row, without its sign; empty if none. */
  std::string_view
  comment () const
  {
    return comment_;
  }

  /** \brief Bytes that follow the row. */
  std::size_t
  remaining () const
  {
    return scanner_.remaining();
  }

  [[noreturn]] void
  fail (const std::string& what) const
  {
    scanner_.fail (what);
  }

private:
  TextScanner scanner_;
  std::string_view row_;
  std::string_view comment_;
};

/** \brief What stands above the rows with points. */
struct TextHead {
  /** the row of words alone, or else the comment, just above the first point */
  std::string_view names;
  /** whether that was a comment, which may say anything */
  bool names_are_comment = false;
  /** how many points a row with one whole number announces */
  std::optional<std::size_t> announced;
};

/** \brief Goes to the first row with a point.
 * \param[in,out] rows from before the first row; after it, next stands on that row
 * \return nothing where there is none
 */
std::optional<TextHead>
readHead (RowScanner& rows);

/** \brief The number of points that a row announces, if it is one whole number. */
std::optional<std::size_t>
announcedPoints (std::string_view row);

/** \brief Rows from all over a text, to be judged by.
 * \param[in] text all of it
 * \param[in] first a row of it, before which nothing is taken
 * \param[out] contiguous how many from the first on follow each other
 */
std::vector<std::string_view>
sampleRows (const std::string& text, std::string_view first, std::size_t& contiguous);

} // namespace crest
} // namespace pcl
