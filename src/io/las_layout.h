// SPDX-License-Identifier: BSD-3-Clause
// Where LAS files have what: ASPRS, LAS Specification 1.4 - R15, which describes the
// versions before as well. All numbers are little-endian, all places in bytes.
#pragma once

#include "io/number_type.h"

#include <array>
#include <cstddef>
#include <vector>

namespace pcl {
namespace crest {
namespace las {

/** \brief Places in the header, which is the start of the file. */
enum HeaderByte : std::size_t {
  GLOBAL_ENCODING = 6,
  VERSION_MAJOR = 24,
  VERSION_MINOR = 25,
  SYSTEM = 26,
  SOFTWARE = 58,
  HEADER_SIZE = 94,
  FIRST_POINT = 96,
  RECORDS = 100,
  POINT_FORMAT = 104,
  POINT_SIZE = 105,
  LEGACY_POINTS = 107,
  SCALES = 131,
  OFFSETS = 155,
  /** for each axis the most and the least coordinate */
  EXTENT = 179,
  FIRST_EXTENDED = 235,
  EXTENDED_RECORDS = 243,
  POINTS = 247,
  POINTS_BY_RETURN = 255
};

/** \brief The sizes of the headers of versions up to 1.2, of 1.3 and of 1.4. */
constexpr std::array<std::size_t, 3> HEADER_SIZES{227, 235, 375};

/** \brief A variable length record: a head, whose places these are, and its data. */
enum RecordByte : std::size_t {
  USER = 2,
  RECORD_ID = 18,
  DATA_SIZE = 20,
  DESCRIPTION = 22,
  DATA = 54
};
/** \brief The size of the description, and of the head of the extended ones behind the
 * points, whose sizes take eight bytes.
 */
constexpr std::size_t DESCRIPTION_SIZE = 32;
constexpr std::size_t EXTENDED_DATA = 60;
constexpr std::size_t USER_SIZE = 16;
constexpr char SPECIFICATION[] = "LASF_Spec";
/** the record that describes numbers behind those of the point format */
constexpr unsigned EXTRA_BYTES = 4;
/** the user of records that tell the coordinate system */
constexpr char PROJECTION[] = "LASF_Projection";

/** \brief Whether a record of that user tells it: WKT of a transform and of a system,
 * or the keys of GeoTIFF with their doubles and texts.
 */
constexpr bool
isWkt (unsigned record)
{
  return record == 2111 || record == 2112;
}

constexpr bool
isGeoTiff (unsigned record)
{
  return record >= 34735 && record <= 34737;
}

/** \brief Places in the description of one of these numbers, and its size. */
enum ExtraByte : std::size_t {
  EXTRA_TYPE = 2,
  EXTRA_OPTIONS = 3,
  EXTRA_NAME = 4,
  EXTRA_SCALE = 112,
  EXTRA_OFFSET = 136,
  EXTRA_SIZE = 192
};
constexpr std::size_t EXTRA_NAME_SIZE = 32;
/** bits of the options: the value is scale * number + offset */
constexpr unsigned HAS_SCALE = 8;
constexpr unsigned HAS_OFFSET = 16;

/** \brief The types of these numbers by their codes from 1 on; above them there are
 * those of two and three, which the specification has given up.
 */
constexpr std::array<NumberType, 10> EXTRA_TYPES{NumberType::UINT8,
                                                 NumberType::INT8,
                                                 NumberType::UINT16,
                                                 NumberType::INT16,
                                                 NumberType::UINT32,
                                                 NumberType::INT32,
                                                 NumberType::UINT64,
                                                 NumberType::INT64,
                                                 NumberType::FLOAT32,
                                                 NumberType::FLOAT64};

/** \brief What a point of each format takes at least. */
constexpr std::array<std::size_t, 11> POINT_SIZES{
    20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67};

/** \brief A number of the points of a format, beside positions and extra bytes. */
struct Dimension {
  const char* name;
  NumberType type;
  /** bytes of a point before it */
  std::size_t byte;
  /** of a number that is some bits of a byte, how many are below it, and which it has
   */
  unsigned shift = 0;
  unsigned mask = 0;
};

/** \brief The unit of the scan angle in degrees from format 6 on, where it is an INT16;
 * up to 5 it is 1, of an INT8. As a dimension it is in degrees, the only FLOAT32.
 */
constexpr double WIDE_ANGLE = 0.006;

/** \brief The numbers of the points of a format, by the names that laspy has for them.
 */
std::vector<Dimension>
dimensionsOf (unsigned format);

/** \brief Whether a format has more than 8 returns, and classes above 31. */
constexpr bool
isWide (unsigned format)
{
  return format >= 6;
}

/** \brief Whether points have a waveform, which stands elsewhere. */
constexpr bool
hasWaveforms (unsigned format)
{
  return format == 4 || format == 5 || format == 9 || format == 10;
}

/** \brief Where points have their class, and which of its bits. */
constexpr std::size_t
classByte (unsigned format)
{
  return isWide (format) ? 16 : 15;
}

constexpr unsigned
classMask (unsigned format)
{
  return isWide (format) ? 0xFF : 0x1F;
}

} // namespace las
} // namespace crest
} // namespace pcl
