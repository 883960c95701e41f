// SPDX-License-Identifier: BSD-3-Clause
// LAS 1.0 to 1.4, all point formats: positions, and normals where these are among the
// extra bytes. All other numbers of points pass through, but for those of waveforms.
#include <boost/algorithm/string/join.hpp>

#include "io/file_content.h"
#include "io/file_fields.h"
#include "io/las_layout.h"
#include "io/point_field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

namespace pcl {
namespace crest {

namespace {

/** \brief What the header of a file says, as far as points need it. */
struct LasHeader {
  unsigned format = 0;
  std::size_t first_point = 0;
  std::size_t point_size = 0;
  std::size_t points = 0;
  Eigen::Array3d scale;
  Eigen::Array3d offset;
};

/** \brief A number behind those of the point format. */
struct ExtraNumber {
  std::string name;
  NumberType type = NumberType::NONE;
  std::size_t count = 1;
  /** bytes of a point before it */
  std::size_t byte = 0;
  bool is_scaled = false;
  double scale = 1.0;
  double offset = 0.0;
};

[[noreturn]] void
failAt (std::size_t byte, const std::string& what)
{
  throw ReadError ("byte " + std::to_string (byte) + ": " + what);
}

class LasReader {
public:
  LasReader (const std::string& text, const std::vector<std::uint8_t>& classes)
  : text_ (text)
  {
    for (const std::uint8_t code : classes)
      is_wanted_[code] = true;
    if (classes.empty())
      is_wanted_.fill (true);
    readHeader();
    dimensions_ = las::dimensionsOf (header_.format);
    readRecords();
    if (at<std::uint8_t> (las::VERSION_MINOR) == 4)
      readExtendedRecords();
    if (las::hasWaveforms (header_.format))
      content_.notes.push_back ("Its waveforms (point format " +
                                std::to_string (header_.format) +
                                ") are not read, and are in none of the outputs.");
  }

  FileContent
  read ()
  {
    choose();
    content_.step = header_.scale;
    content_.origin = header_.offset;
    std::array<const ExtraNumber*, 3> normal{};
    for (const ExtraNumber& number : extra_) {
      const std::size_t axis =
          placeOf (pointFieldOf (number.name)) - placeOf (PointField::NX);
      if (axis < normal.size() && number.count == 1 && normal[axis] == nullptr)
        normal[axis] = &number;
    }
    content_.has_normals =
        normal[0] != nullptr && normal[1] != nullptr && normal[2] != nullptr;
    for (const las::Dimension& dimension : dimensions_)
      addField (content_.fields, dimension.name, dimension.type);
    std::vector<const ExtraNumber*> passing;
    for (const ExtraNumber& number : extra_)
      if (!content_.has_normals ||
          std::find (normal.begin(), normal.end(), &number) == normal.end()) {
        passing.push_back (&number);
        addField (content_.fields,
                  number.name,
                  number.is_scaled ? NumberType::FLOAT64 : number.type,
                  number.count);
      }
    content_.fields.records.reserve (chosen_ * content_.fields.record_size);
    content_.points.reserve (chosen_);
    for (std::size_t i = 0; i < header_.points; ++i) {
      const char* const point = pointAt (i);
      if (!is_wanted_[classOf (point)])
        continue;
      std::array<double, 6> values{};
      for (int axis = 0; axis < 3; ++axis) {
        const std::size_t place = static_cast<std::size_t> (axis);
        values[place] =
            header_.scale[axis] * decodeAs<std::int32_t> (point + 4 * place, false) +
            header_.offset[axis];
        if (content_.has_normals)
          values[3 + place] = valueOf (*normal[place], point);
      }
      content_.points.add (values.data(), content_.has_normals);
      pass (point, passing, addRecord (content_.fields));
    }
    readColors();
    return std::move (content_);
  }

private:
  template <typename T>
  T
  at (std::size_t byte) const
  {
    return decodeAs<T> (text_.data() + byte, false);
  }

  /** \brief What stands in a room of some bytes, up to the first that is 0. */
  std::string
  nameAt (std::size_t byte, std::size_t size) const
  {
    const std::string room (text_, byte, size);
    return room.substr (0, room.find ('\0'));
  }

  void
  readHeader ()
  {
    constexpr char SIGNATURE[] = "LASF";
    if (text_.compare (0, 4, SIGNATURE) != 0)
      failAt (0,
              "expected \"LASF\", which LAS files begin with, found \"" +
                  TextScanner::shown (std::string_view (text_).substr (0, 4)) + "\"");
    if (text_.size() < las::HEADER_SIZES[0])
      failAt (text_.size(),
              "the file ends within its header, which has at least " +
                  std::to_string (las::HEADER_SIZES[0]) + " bytes");
    const unsigned major = at<std::uint8_t> (las::VERSION_MAJOR);
    const unsigned minor = at<std::uint8_t> (las::VERSION_MINOR);
    if (major != 1 || minor > 4)
      failAt (las::VERSION_MAJOR,
              "the version is " + std::to_string (major) + "." +
                  std::to_string (minor) + ", but 1.0 to 1.4 are read");
    const std::size_t least = las::HEADER_SIZES[minor <= 2 ? 0 : minor - 2];
    header_size_ = at<std::uint16_t> (las::HEADER_SIZE);
    if (header_size_ < least || header_size_ > text_.size())
      failAt (las::HEADER_SIZE,
              "the header has " + std::to_string (header_size_) +
                  " bytes, but that of version 1." + std::to_string (minor) +
                  " has at least " + std::to_string (least) + ", and the file has " +
                  std::to_string (text_.size()));
    header_.format = at<std::uint8_t> (las::POINT_FORMAT);
    if (header_.format >= las::POINT_SIZES.size())
      failAt (las::POINT_FORMAT,
              "the point format is " + std::to_string (header_.format) +
                  ", but must be one of 0 to 10");
    header_.point_size = at<std::uint16_t> (las::POINT_SIZE);
    if (header_.point_size < las::POINT_SIZES[header_.format])
      failAt (las::POINT_SIZE,
              "points have " + std::to_string (header_.point_size) +
                  " bytes, but those of format " + std::to_string (header_.format) +
                  " have at least " +
                  std::to_string (las::POINT_SIZES[header_.format]));
    readPointCount (minor);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto place = static_cast<Eigen::Index> (axis);
      header_.scale[place] = at<double> (las::SCALES + 8 * axis);
      header_.offset[place] = at<double> (las::OFFSETS + 8 * axis);
      if (!std::isfinite (header_.scale[place]) || header_.scale[place] == 0.0)
        failAt (las::SCALES + 8 * axis,
                "a scale of coordinates is " + std::to_string (header_.scale[place]) +
                    ", but must be finite and not 0");
      if (!std::isfinite (header_.offset[place]))
        failAt (las::OFFSETS + 8 * axis,
                "an offset of coordinates is " +
                    std::to_string (header_.offset[place]) + ", but must be finite");
    }
  }

  void
  readPointCount (unsigned minor)
  {
    std::size_t place = las::LEGACY_POINTS;
    std::uint64_t points = at<std::uint32_t> (place);
    if (minor == 4 && at<std::uint64_t> (las::POINTS) != 0) {
      place = las::POINTS;
      points = at<std::uint64_t> (place);
    }
    header_.first_point = at<std::uint32_t> (las::FIRST_POINT);
    if (header_.first_point < header_size_ || header_.first_point > text_.size())
      failAt (las::FIRST_POINT,
              "points begin at byte " + std::to_string (header_.first_point) +
                  ", but must do so behind the header of " +
                  std::to_string (header_size_) + " bytes and within the file of " +
                  std::to_string (text_.size()));
    const std::size_t most = (text_.size() - header_.first_point) / header_.point_size;
    if (points > most)
      failAt (place,
              "the header announces " + std::to_string (points) + " points of " +
                  std::to_string (header_.point_size) +
                  " bytes each, but there is "
                  "room for " +
                  std::to_string (most) + " between byte " +
                  std::to_string (header_.first_point) + " and the end of the file, " +
                  std::to_string (text_.size()));
    checkPointCount (points);
    header_.points = points;
  }

  void
  readRecords ()
  {
    const auto records = at<std::uint32_t> (las::RECORDS);
    std::size_t byte = header_size_;
    for (std::uint32_t i = 0; i < records; ++i) {
      const bool has_head = header_.first_point - byte >= las::DATA;
      const std::size_t size = has_head ? at<std::uint16_t> (byte + las::DATA_SIZE) : 0;
      if (!has_head || size > header_.first_point - byte - las::DATA)
        failAt (byte,
                "variable length record " + std::to_string (i + 1) + " of " +
                    std::to_string (records) +
                    " ends behind the start of the points, byte " +
                    std::to_string (header_.first_point));
      if (nameAt (byte + las::USER, las::USER_SIZE) == las::SPECIFICATION &&
          at<std::uint16_t> (byte + las::RECORD_ID) == las::EXTRA_BYTES)
        readExtra (byte + las::DATA, size);
      takeCrs (byte, byte + las::DATA, size);
      byte += las::DATA + size;
    }
  }

  /** \brief Takes what tells the coordinate system of the records behind the points,
   * without which these are what they are, so that no fault of them is an error.
   */
  void
  readExtendedRecords ()
  {
    auto records = at<std::uint32_t> (las::EXTENDED_RECORDS);
    auto byte = at<std::uint64_t> (las::FIRST_EXTENDED);
    for (; records > 0; --records) {
      const bool has_head =
          byte <= text_.size() && text_.size() - byte >= las::EXTENDED_DATA;
      const std::uint64_t size =
          has_head ? at<std::uint64_t> (byte + las::DATA_SIZE) : 0;
      if (!has_head || size > text_.size() - byte - las::EXTENDED_DATA) {
        content_.notes.push_back (
            "The file ends within its extended variable length records: " +
            std::to_string (records) + " of them are not read.");
        return;
      }
      takeCrs (byte, byte + las::EXTENDED_DATA, size);
      byte += las::EXTENDED_DATA + size;
    }
  }

  /** \brief Keeps a record if it tells the coordinate system.
   * \param[in] head, data where these begin
   * \param[in] size of the data
   */
  void
  takeCrs (std::size_t head, std::size_t data, std::size_t size)
  {
    constexpr std::size_t MOST = std::numeric_limits<std::uint16_t>::max();
    const auto id = at<std::uint16_t> (head + las::RECORD_ID);
    if (nameAt (head + las::USER, las::USER_SIZE) != las::PROJECTION ||
        !(las::isWkt (id) || las::isGeoTiff (id)) || size > MOST)
      return;
    // Of the extended ones the size has six bytes more.
    const std::size_t description = data - las::DESCRIPTION_SIZE;
    content_.crs_records.push_back (
        {id, nameAt (description, las::DESCRIPTION_SIZE), text_.substr (data, size)});
  }

  /** \brief Takes the description of the numbers behind those of the point format.
   * \param[in] byte, size of the record's data
   */
  void
  readExtra (std::size_t byte, std::size_t size)
  {
    constexpr std::size_t TYPES = las::EXTRA_TYPES.size();
    std::size_t in_point = las::POINT_SIZES[header_.format];
    for (const std::size_t end = byte + size; end - byte >= las::EXTRA_SIZE;
         byte += las::EXTRA_SIZE) {
      const std::size_t code = at<std::uint8_t> (byte + las::EXTRA_TYPE);
      const unsigned options = at<std::uint8_t> (byte + las::EXTRA_OPTIONS);
      if (code > 3 * TYPES)
        failAt (byte + las::EXTRA_TYPE,
                "the type of extra bytes is " + std::to_string (code) +
                    ", but must be one of 0 to " + std::to_string (3 * TYPES));
      ExtraNumber number;
      number.name = nameAt (byte + las::EXTRA_NAME, las::EXTRA_NAME_SIZE);
      number.byte = in_point;
      // Bytes that mean nothing to the specification, as many as the options say.
      number.type =
          code == 0 ? NumberType::UINT8 : las::EXTRA_TYPES[(code - 1) % TYPES];
      number.count = code == 0 ? options : 1 + (code - 1) / TYPES;
      if (number.count == 1 && code != 0) {
        if ((options & las::HAS_SCALE) != 0)
          number.scale = at<double> (byte + las::EXTRA_SCALE);
        if ((options & las::HAS_OFFSET) != 0)
          number.offset = at<double> (byte + las::EXTRA_OFFSET);
        number.is_scaled = (options & (las::HAS_SCALE | las::HAS_OFFSET)) != 0;
      }
      in_point += sizeOf (number.type) * number.count;
      if (in_point > header_.point_size)
        failAt (byte,
                "the extra bytes \"" + TextScanner::shown (number.name) +
                    "\" end behind the " + std::to_string (header_.point_size) +
                    " bytes of a point");
      extra_.push_back (std::move (number));
    }
  }

  /** \brief Writes what passes through of a point.
   * \param[in] passing the extra bytes among it
   * \param[out] to a record
   */
  void
  pass (const char* point,
        const std::vector<const ExtraNumber*>& passing,
        char* to) const
  {
    const auto put = [&to] (auto number) {
      std::memcpy (to, &number, sizeof (number));
      to += sizeof (number);
    };
    for (const las::Dimension& dimension : dimensions_) {
      const char* const from = point + dimension.byte;
      if (dimension.mask != 0)
        put (static_cast<std::uint8_t> (
            (static_cast<unsigned char> (*from) >> dimension.shift) & dimension.mask));
      else if (dimension.type != NumberType::FLOAT32)
        to = copyNumbers (from, sizeOf (dimension.type), 1, to);
      else if (las::isWide (header_.format))
        put (static_cast<float> (las::WIDE_ANGLE *
                                 decodeAs<std::int16_t> (from, false)));
      else
        put (static_cast<float> (decodeAs<std::int8_t> (from, false)));
    }
    for (const ExtraNumber* const number : passing)
      if (number->is_scaled)
        put (valueOf (*number, point));
      else
        to = copyNumbers (
            point + number->byte, sizeOf (number->type), number->count, to);
  }

  /** \brief Copies numbers in the machine's byte order; where the next one belongs. */
  static char*
  copyNumbers (const char* from, std::size_t size, std::size_t count, char* to)
  {
    for (std::size_t i = 0; i < count; ++i, from += size, to += size)
      copyNumber (from, size, false, to);
    return to;
  }

  const char*
  pointAt (std::size_t i) const
  {
    return text_.data() + header_.first_point + i * header_.point_size;
  }

  std::uint8_t
  classOf (const char* point) const
  {
    return static_cast<std::uint8_t> (
        static_cast<unsigned char> (point[las::classByte (header_.format)]) &
        las::classMask (header_.format));
  }

  static double
  valueOf (const ExtraNumber& number, const char* point)
  {
    return number.scale * decode (point + number.byte, number.type, false) +
           number.offset;
  }

  /** \brief Counts the points that are wanted, and says which they are. */
  void
  choose ()
  {
    std::array<std::size_t, 256> counts{};
    for (std::size_t i = 0; i < header_.points; ++i)
      ++counts[classOf (pointAt (i))];
    std::vector<std::string> wanted;
    std::vector<std::string> present;
    for (std::size_t code = 0; code < counts.size(); ++code) {
      if (is_wanted_[code]) {
        chosen_ += counts[code];
        wanted.push_back (std::to_string (code));
      }
      if (counts[code] != 0)
        present.push_back (std::to_string (code));
    }
    if (wanted.size() == counts.size())
      return;
    const std::string named = "the class" +
                              std::string (wanted.size() == 1 ? " " : "es ") +
                              boost::join (wanted, ", ");
    if (chosen_ == 0 && header_.points != 0)
      throw ReadError ("none of its " + std::to_string (header_.points) +
                       " points has " + named + " of -class: there are " +
                       boost::join (present, ", "));
    content_.notes.push_back (std::to_string (chosen_) + " of " +
                              std::to_string (header_.points) + " points have " +
                              named + " and are read.");
  }

  void
  readColors ()
  {
    const auto red = std::find_if (
        dimensions_.begin(), dimensions_.end(), [] (const las::Dimension& dimension) {
          return dimension.name == std::string_view ("red");
        });
    if (red == dimensions_.end())
      return;
    const auto channel = [byte = red->byte] (const char* point, std::size_t i) {
      return decodeAs<std::uint16_t> (point + byte + 2 * i, false);
    };
    // Up to 65535, but many programs leave them at 255.
    std::uint16_t largest = 0;
    for (std::size_t i = 0; i < header_.points; ++i)
      for (std::size_t c = 0; c < 3; ++c)
        largest = std::max (largest, channel (pointAt (i), c));
    if (largest == 0)
      return;
    const unsigned shift = largest > 255 ? 8 : 0;
    content_.colors.reserve (chosen_);
    for (std::size_t i = 0; i < header_.points; ++i) {
      const char* const point = pointAt (i);
      if (is_wanted_[classOf (point)])
        content_.colors.push_back (
            {static_cast<unsigned char> (channel (point, 0) >> shift),
             static_cast<unsigned char> (channel (point, 1) >> shift),
             static_cast<unsigned char> (channel (point, 2) >> shift)});
    }
  }

  const std::string& text_;
  std::array<bool, 256> is_wanted_{};
  std::size_t header_size_ = 0;
  LasHeader header_;
  std::vector<las::Dimension> dimensions_;
  std::vector<ExtraNumber> extra_;
  std::size_t chosen_ = 0;
  FileContent content_;
};

} // namespace

FileContent
readLas (const std::string& text, const std::vector<std::uint8_t>& classes)
{
  return LasReader (text, classes).read();
}

} // namespace crest
} // namespace pcl
