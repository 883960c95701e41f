// SPDX-License-Identifier: BSD-3-Clause
// What the columns of a text cloud are: by what the user says, by their names, or by
// their values.
#pragma once

#include "io/point_field.h"
#include "io/text_dialect.h"
#include "io/text_rows.h"

#include <string>
#include <string_view>
#include <vector>

namespace pcl {
namespace crest {

/** \brief A column of a text cloud. */
struct TextColumn {
  PointField field = PointField::NONE;
  /** whether every word of it has to be a number */
  bool is_number = true;
  /** of the field that passes through; empty if none does */
  std::string passes_as{};
};

/** \brief The columns of a text cloud, and how they were found. */
struct TextColumns {
  std::vector<TextColumn> columns;
  /** what found them, as in "by their names"; empty where there was nothing to find */
  std::string found_by;

  bool
  has (PointField field) const;

  /** \brief As the option -columns has them, as in "x,y,z,-,nx,ny,nz". */
  std::string
  describe () const;
};

/** \brief What is wrong with names of columns for -columns; empty if nothing. */
std::string
explainInvalidColumns (const std::vector<std::string>& names);

/** \brief The columns as the user names them. */
TextColumns
columnsGiven (const std::vector<std::string>& names);

/** \brief The columns by what stands above them. Throws a ReadError where that is a row
 * of words that does not tell which are x, y and z.
 * \param[in] head what stands there
 * \param[in] rows some rows of the text
 * \param[in] dialect theirs
 * \return no columns where there are no names
 */
TextColumns
columnsByName (const TextHead& head,
               const std::vector<std::string_view>& rows,
               const TextDialect& dialect);

/** \brief The columns by the values in them: x y z are the first three numbers, behind
 * the number of the point if there is one that counts up; three columns of unit vectors
 * are normals; three of whole numbers up to 255, or of numbers up to 1, are colors.
 * Throws a ReadError where that leaves more than one choice for positions or normals.
 * \param[in] rows some rows of the text
 * \param[in] contiguous how many of them from the first on follow each other
 * \param[in] dialect theirs
 */
TextColumns
columnsByValue (const std::vector<std::string_view>& rows,
                std::size_t contiguous,
                const TextDialect& dialect);

} // namespace crest
} // namespace pcl
