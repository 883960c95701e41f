// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace pcl {
namespace crest {

/** \brief The types of numbers in binary files. */
enum class NumberType {
  NONE,
  INT8,
  UINT8,
  INT16,
  UINT16,
  INT32,
  UINT32,
  INT64,
  UINT64,
  FLOAT32,
  FLOAT64
};

/** \brief Bytes that a number takes. */
inline std::size_t
sizeOf (NumberType type)
{
  switch (type) {
  case NumberType::INT8:
  case NumberType::UINT8:
    return 1;
  case NumberType::INT16:
  case NumberType::UINT16:
    return 2;
  case NumberType::INT32:
  case NumberType::UINT32:
  case NumberType::FLOAT32:
    return 4;
  case NumberType::INT64:
  case NumberType::UINT64:
  case NumberType::FLOAT64:
    return 8;
  case NumberType::NONE:
    break;
  }
  return 0;
}

/** \brief The type by the letter that PCD files have for it, I, U or F, and by its size
 * in bytes; NONE if there is none.
 */
inline NumberType
numberTypeOf (char letter, std::size_t size)
{
  constexpr NumberType SIGNED[] = {
      NumberType::INT8, NumberType::INT16, NumberType::INT32, NumberType::INT64};
  constexpr NumberType UNSIGNED[] = {
      NumberType::UINT8, NumberType::UINT16, NumberType::UINT32, NumberType::UINT64};
  const std::size_t place = size == 1 ? 0 : size == 2 ? 1 : size == 4 ? 2 : 3;
  if (letter == 'I')
    return SIGNED[place];
  if (letter == 'U')
    return UNSIGNED[place];
  if (letter == 'F' && size >= 4)
    return size == 4 ? NumberType::FLOAT32 : NumberType::FLOAT64;
  return NumberType::NONE;
}

/** \brief The letter that PCD files have for a type. */
inline char
letterOf (NumberType type)
{
  switch (type) {
  case NumberType::INT8:
  case NumberType::INT16:
  case NumberType::INT32:
  case NumberType::INT64:
    return 'I';
  case NumberType::FLOAT32:
  case NumberType::FLOAT64:
    return 'F';
  default:
    return 'U';
  }
}

constexpr bool HOST_IS_BIG_ENDIAN = __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__;

/** \brief Copies a number from the machine's byte order to that of a file, or back. */
inline void
copyNumber (const char* from, std::size_t size, bool big_endian, char* to)
{
  if (big_endian == HOST_IS_BIG_ENDIAN)
    std::memcpy (to, from, size);
  else
    std::reverse_copy (from, from + size, to);
}

/** \brief The value of a number in a file, in the byte order of the file. */
template <typename T>
T
decodeAs (const char* bytes, bool big_endian)
{
  char native[sizeof (T)];
  for (std::size_t i = 0; i < sizeof (T); ++i)
    native[i] = bytes[big_endian == HOST_IS_BIG_ENDIAN ? i : sizeof (T) - 1 - i];
  T value;
  std::memcpy (&value, native, sizeof (T));
  return value;
}

inline double
decode (const char* bytes, NumberType type, bool big_endian)
{
  switch (type) {
  case NumberType::INT8:
    return decodeAs<std::int8_t> (bytes, big_endian);
  case NumberType::UINT8:
    return decodeAs<std::uint8_t> (bytes, big_endian);
  case NumberType::INT16:
    return decodeAs<std::int16_t> (bytes, big_endian);
  case NumberType::UINT16:
    return decodeAs<std::uint16_t> (bytes, big_endian);
  case NumberType::INT32:
    return decodeAs<std::int32_t> (bytes, big_endian);
  case NumberType::UINT32:
    return decodeAs<std::uint32_t> (bytes, big_endian);
  case NumberType::INT64:
    return static_cast<double> (decodeAs<std::int64_t> (bytes, big_endian));
  case NumberType::UINT64:
    return static_cast<double> (decodeAs<std::uint64_t> (bytes, big_endian));
  case NumberType::FLOAT32:
    return decodeAs<float> (bytes, big_endian);
  case NumberType::FLOAT64:
    return decodeAs<double> (bytes, big_endian);
  case NumberType::NONE:
    break;
  }
  return 0.0;
}

} // namespace crest
} // namespace pcl
