// SPDX-License-Identifier: BSD-3-Clause
// The fields of a file that pass through: how readers collect them.
#pragma once

#include <pcl_crest/io/read_cloud.h>

#include "io/number_type.h"

#include <string>
#include <string_view>
#include <vector>

namespace pcl {
namespace crest {

/** \brief The type of a field's numbers. */
NumberType
typeOf (const FileFields::Field& field);

/** \brief Adds a field at the end of the records, of which there must be none yet.
 * Blanks in its name become underscores; fields without numbers are passed over.
 */
void
addField (FileFields& fields,
          const std::string& name,
          NumberType type,
          std::size_t count = 1);

/** \brief Adds a record of zeros; its first byte, which the next call may move. */
inline char*
addRecord (FileFields& fields)
{
  fields.records.resize (fields.records.size() + fields.record_size);
  return fields.records.data() + (fields.records.size() - fields.record_size);
}

/** \brief Writes the number that a word is: exactly where the type can hold it, else
 * as near as it can; NaN as 0 into whole numbers.
 * \return false if it is none
 */
bool
encodeWord (std::string_view word, NumberType type, char* bytes);

/** \brief Writes a number as the nearest of its type; NaN as 0 into whole numbers. */
void
encodeNumber (double number, NumberType type, char* bytes);

/** \brief Takes red, green and blue, one byte each, as fields of these names. */
void
addColorFields (FileFields& fields);

/** \brief Gives fields other names that have those of the output or of each other.
 * \return one sentence that says so; empty where there was nothing to do
 */
std::string
renameFields (FileFields& fields);

} // namespace crest
} // namespace pcl
