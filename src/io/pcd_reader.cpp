// SPDX-License-Identifier: BSD-3-Clause
// PCD, text, binary and compressed: x y z, normals and the viewpoint; all else that a
// file may declare passes through. pcl::PCDReader is not used because it makes room for
// as many points as the header announces, makes up what is missing in text, and refuses
// fields without numbers, which drivers of lidars write between others.
#include "io/file_content.h"
#include "io/file_fields.h"
#include "io/lzf.h"
#include "io/number_type.h"
#include "io/point_field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <set>

namespace pcl {
namespace crest {

namespace {

struct PcdHeader {
  std::vector<std::string> fields;
  std::vector<std::size_t> sizes;
  std::string types;
  std::vector<std::size_t> counts;
  std::size_t width = 0;
  std::size_t height = 1;
  std::size_t points = 0;
  /** x y z, and the quaternion w x y z */
  std::array<double, 7> viewpoint{0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0};
  std::string coding;

  std::uint64_t
  pointSize () const
  {
    std::uint64_t bytes = 0;
    for (std::size_t i = 0; i < fields.size(); ++i)
      bytes += sizes[i] * counts[i];
    return bytes;
  }
  std::size_t
  numbers () const
  {
    std::size_t sum = 0;
    for (const std::size_t count : counts)
      sum += count;
    return sum;
  }
};

std::vector<std::size_t>
readNumbers (const TextScanner& scanner)
{
  std::vector<std::size_t> numbers;
  for (std::size_t i = 1; i < scanner.words().size(); ++i)
    numbers.push_back (
        scanner.number<std::size_t> (scanner.words()[i], "a whole number"));
  return numbers;
}

std::vector<std::size_t>
readSizes (const TextScanner& scanner)
{
  std::vector<std::size_t> sizes = readNumbers (scanner);
  for (const std::size_t size : sizes)
    if (size != 1 && size != 2 && size != 4 && size != 8)
      scanner.fail ("a field has numbers of " + std::to_string (size) +
                    " bytes, but must have 1, 2, 4 or 8");
  return sizes;
}

std::vector<std::size_t>
readCounts (const TextScanner& scanner)
{
  // More than any point has, and few enough for sums over as many fields as fit into
  // memory.
  constexpr std::size_t LARGEST = 1U << 20U;
  std::vector<std::size_t> counts = readNumbers (scanner);
  for (const std::size_t count : counts)
    if (count > LARGEST)
      scanner.fail ("a field has a count of " + std::to_string (count) +
                    ", but must have one up to " + std::to_string (LARGEST));
  return counts;
}

std::string
readTypes (const TextScanner& scanner)
{
  std::string types;
  for (std::size_t i = 1; i < scanner.words().size(); ++i) {
    const std::string_view word = scanner.words()[i];
    if (word != "I" && word != "U" && word != "F")
      scanner.fail ("a field has the type \"" + TextScanner::shown (word) +
                    "\", but must have I, U or F");
    types += word;
  }
  return types;
}

std::array<double, 7>
readViewpoint (const TextScanner& scanner)
{
  std::array<double, 7> viewpoint{};
  if (scanner.words().size() != 1 + viewpoint.size())
    scanner.fail ("expected a viewpoint of 7 numbers");
  for (std::size_t i = 0; i < viewpoint.size(); ++i) {
    const std::string_view word = scanner.words()[i + 1];
    viewpoint[i] = scanner.number<double> (word, "a number");
    if (!std::isfinite (static_cast<float> (viewpoint[i])))
      scanner.fail ("a number of the viewpoint is " + TextScanner::shown (word) +
                    ", but must be one that a float can hold");
  }
  return viewpoint;
}

PcdHeader
readHeader (TextScanner& scanner)
{
  PcdHeader header;
  std::set<std::string> keys;
  const auto number = [&scanner] {
    if (scanner.words().size() != 2)
      scanner.fail ("expected one number");
    const auto value =
        scanner.number<std::size_t> (scanner.words()[1], "a whole number");
    checkPointCount (value);
    return value;
  };
  while (header.coding.empty()) {
    if (!scanner.nextLine())
      scanner.fail ("the file ends within its header, before \"DATA\"");
    const std::vector<std::string_view>& words = scanner.words();
    const std::string key (words[0] == "COLUMNS" ? "FIELDS" : words[0]);
    if (!keys.insert (key).second)
      scanner.fail ("the header has the line " + TextScanner::shown (key) + " twice");
    if (key == "FIELDS")
      header.fields.assign (words.begin() + 1, words.end());
    else if (key == "SIZE")
      header.sizes = readSizes (scanner);
    else if (key == "COUNT")
      header.counts = readCounts (scanner);
    else if (key == "TYPE")
      header.types = readTypes (scanner);
    else if (key == "WIDTH")
      header.width = number();
    else if (key == "HEIGHT")
      header.height = number();
    else if (key == "POINTS")
      header.points = number();
    else if (key == "VIEWPOINT")
      header.viewpoint = readViewpoint (scanner);
    else if (key == "DATA" && words.size() == 2)
      header.coding = words[1];
    else if (key != "VERSION")
      scanner.fail ("expected a line of a PCD header, found \"" +
                    TextScanner::shown (key) + "\"");
  }
  checkPointCount (header.width * header.height);
  if (keys.count ("POINTS") == 0)
    header.points = header.width * header.height;
  if (header.counts.empty())
    header.counts.assign (header.fields.size(), 1);
  if (keys.count ("WIDTH") == 0 || header.points != header.width * header.height)
    throw ReadError ("its header announces " + std::to_string (header.points) +
                     " points, but a width of " + std::to_string (header.width) +
                     " and a height of " + std::to_string (header.height));
  const std::size_t fields = header.fields.size();
  if (fields == 0 || header.sizes.size() != fields || header.counts.size() != fields ||
      header.types.size() != fields)
    throw ReadError ("its header needs FIELDS, SIZE, TYPE and COUNT of equal numbers");
  // PCL, which writes the others, keeps the places of fields in an int.
  constexpr std::uint64_t LARGEST_POINT = std::numeric_limits<std::int32_t>::max();
  if (header.pointSize() > LARGEST_POINT)
    throw ReadError ("its header announces points of " +
                     std::to_string (header.pointSize()) + " bytes, but at most " +
                     std::to_string (LARGEST_POINT) + " are supported");
  return header;
}

/** \brief Where a field is in the points of a file. */
struct PlacedField {
  NumberType type = NumberType::NONE;
  /** numbers of a point before it */
  std::size_t word = 0;
  /** bytes of a point before it */
  std::size_t offset = 0;
  /** bytes of all its numbers */
  std::size_t size = 0;
};

/** \brief Makes points of what the data of a file hold. */
class PcdPoints {
public:
  explicit PcdPoints (const PcdHeader& header) : header_ (header)
  {
    std::string present;
    PlacedField next;
    for (std::size_t i = 0; i < header.fields.size(); ++i) {
      const std::string& name = header.fields[i];
      present += (present.empty() ? "" : " ") + TextScanner::shown (name);
      next.type = numberTypeOf (header.types[i], header.sizes[i]);
      next.size = header.sizes[i] * header.counts[i];
      const PointField field = pointFieldOf (name);
      // A name of "_" stands for bytes that mean nothing.
      if (header.counts[i] != 0 && next.type != NumberType::NONE) {
        if (field < PointField::RED && !fields_[placeOf (field)])
          fields_[placeOf (field)] = next;
        else if (name != "_")
          addPassing (name, header.counts[i], next);
        if ((name == "rgb" || name == "rgba" || name == "RGB" || name == "RGBA") &&
            header.sizes[i] == 4)
          color_ = next;
      }
      next.word += header.counts[i];
      next.offset += next.size;
    }
    if (!fields_[0] || !fields_[1] || !fields_[2])
      throw ReadError ("it has the fields \"" + present +
                       "\", but x, y and z are needed");
    content_.has_normals = fields_[3] && fields_[4] && fields_[5];
    constexpr const char* NORMAL[] = {"normal_x", "normal_y", "normal_z"};
    for (std::size_t i = 3; i < fields_.size() && !content_.has_normals; ++i)
      if (fields_[i])
        addPassing (NORMAL[i - 3], 1, *fields_[i]);
    numbers_ = content_.has_normals ? 6 : 3;
  }

  /** \brief To be called when it is known that the file holds them. */
  void
  makeRoom ()
  {
    content_.points.reserve (header_.points);
    content_.fields.records.reserve (header_.points * content_.fields.record_size);
    if (color_)
      content_.colors.reserve (header_.points);
  }

  void
  add (const TextScanner& scanner)
  {
    const std::vector<std::string_view>& words = scanner.words();
    if (words.size() != header_.numbers())
      scanner.fail ("expected " + std::to_string (header_.numbers()) +
                    " numbers, found " + std::to_string (words.size()));
    words_.resize (words.size());
    for (std::size_t i = 0; i < words.size(); ++i)
      words_[i] = scanner.number<double> (words[i], "a number");
    std::array<double, 6> values{};
    for (std::size_t i = 0; i < numbers_; ++i)
      values[i] = words_[fields_[i]->word];
    std::uint32_t color = 0;
    if (color_) {
      const double number = words_[color_->word];
      if (color_->type == NumberType::FLOAT32) {
        const auto bytes = static_cast<float> (number);
        std::memcpy (&color, &bytes, sizeof (color));
      }
      else if (number >= 0.0 && number <= std::numeric_limits<std::uint32_t>::max())
        color = static_cast<std::uint32_t> (number);
    }
    add (values, color);
    char* record = addRecord (content_.fields);
    for (std::size_t i = 0; i < passing_.size(); ++i) {
      const PlacedField& from = passing_[i];
      const std::size_t count = content_.fields.fields[i].count;
      for (std::size_t j = 0; j < count; ++j, record += sizeOf (from.type))
        encodeWord (words[from.word + j], from.type, record);
    }
  }

  /** \brief Adds all points of binary data.
   * \param[in] data the points one after the other, or field by field
   */
  void
  add (const char* data, bool by_field)
  {
    const std::uint64_t step = header_.pointSize();
    content_.has_floats = fields_[0]->type == NumberType::FLOAT32;
    // Of the field at an offset, that of the point i.
    const auto at = [&] (const PlacedField& field, std::size_t i) {
      return by_field ? data + field.offset * header_.points + i * field.size
                      : data + i * step + field.offset;
    };
    const auto addAll = [&] (const auto& numberAt) {
      for (std::size_t i = 0; i < header_.points; ++i) {
        std::array<double, 6> values{};
        for (std::size_t j = 0; j < numbers_; ++j)
          values[j] = numberAt (*fields_[j], i);
        add (values, color_ ? decodeAs<std::uint32_t> (at (*color_, i), false) : 0);
      }
    };
    // Most files have floats alone: then there is nothing to ask for each number.
    if (std::all_of (fields_.begin(),
                     fields_.begin() + static_cast<std::ptrdiff_t> (numbers_),
                     [] (const auto& f) { return f->type == NumberType::FLOAT32; }))
      addAll ([&at] (const PlacedField& field, std::size_t i) -> double {
        return decodeAs<float> (at (field, i), false);
      });
    else
      addAll ([&at] (const PlacedField& field, std::size_t i) {
        return decode (at (field, i), field.type, false);
      });
    passRecords (at, by_field);
  }

  FileContent
  take ()
  {
    const auto& v = header_.viewpoint;
    content_.rows = header_.height;
    content_.viewpoint = Eigen::Vector3d (v[0], v[1], v[2]);
    Eigen::Quaterniond orientation (v[3], v[4], v[5], v[6]);
    // Of as few digits as programs write.
    constexpr double TOLERANCE = 0.01;
    if (std::abs (orientation.norm() - 1.0) > TOLERANCE) {
      orientation.setIdentity();
      content_.notes.emplace_back ("The orientation of the viewpoint is left out: it "
                                   "is no quaternion of length 1.");
    }
    content_.orientation = orientation.cast<float>();
    return std::move (content_);
  }

private:
  void
  addPassing (const std::string& name, std::size_t count, const PlacedField& field)
  {
    addField (content_.fields, name, field.type, count);
    passing_.push_back (field);
  }

  /** \brief Copies the fields that pass through, neighbours of a point at once.
   * \param[in] at of a field and the number of a point its first byte
   * \param[in] by_field whether neighbours of a point are not so in the data
   */
  template <typename At>
  void
  passRecords (const At& at, bool by_field)
  {
    std::vector<PlacedField> runs;
    for (const PlacedField& field : passing_)
      if (!by_field && !runs.empty() &&
          field.offset == runs.back().offset + runs.back().size)
        runs.back().size += field.size;
      else
        runs.push_back (field);
    FileFields& fields = content_.fields;
    for (std::size_t i = 0; i < header_.points; ++i)
      for (const PlacedField& run : runs) {
        const char* const from = at (run, i);
        fields.records.insert (fields.records.end(), from, from + run.size);
      }
  }

  void
  add (const std::array<double, 6>& values, std::uint32_t color)
  {
    content_.points.add (values.data(), content_.has_normals);
    if (color_)
      content_.colors.push_back ({static_cast<unsigned char> (color >> 16U),
                                  static_cast<unsigned char> (color >> 8U),
                                  static_cast<unsigned char> (color)});
  }

  const PcdHeader& header_;
  std::array<std::optional<PlacedField>, 6> fields_;
  std::optional<PlacedField> color_;
  /** where content_.fields are in the file */
  std::vector<PlacedField> passing_;
  std::size_t numbers_ = 3;
  std::vector<double> words_;
  FileContent content_;
};

void
readRows (const PcdHeader& header, TextScanner& scanner, PcdPoints& points)
{
  // A number takes at least a digit and a blank.
  if (header.points <= scanner.remaining() / 2)
    points.makeRoom();
  std::size_t rows = 0;
  for (; scanner.nextLine(); ++rows) {
    if (rows == header.points)
      scanner.fail ("expected " + std::to_string (header.points) +
                    " points as its header announces, found more");
    points.add (scanner);
  }
  if (rows != header.points)
    throw ReadError ("its header announces " + std::to_string (header.points) +
                     " points, but " + std::to_string (rows) + " follow");
}

void
readBinary (const PcdHeader& header, TextScanner& scanner, PcdPoints& points)
{
  const bool compressed = header.coding == "binary_compressed";
  if (!compressed && header.coding != "binary")
    throw ReadError ("its data are \"" + TextScanner::shown (header.coding) +
                     "\", but must be ascii, binary or binary_compressed");
  // Neither factor has more than 31 bits.
  const std::uint64_t size = header.points * header.pointSize();
  std::uint64_t needed = size;
  if (compressed) {
    // LZF makes at most 264 bytes of 3.
    constexpr std::size_t BEST_RATIO = 88;
    const std::string_view sizes = scanner.bytes (8, "the size of the data");
    needed = decodeAs<std::uint32_t> (sizes.data(), false);
    const std::uint64_t inflated = decodeAs<std::uint32_t> (sizes.data() + 4, false);
    if (inflated != size || inflated / BEST_RATIO > needed)
      throw ReadError ("its compressed data do not make up the " +
                       std::to_string (header.points) + " points that it announces");
  }
  if (needed > scanner.remaining())
    throw ReadError ("its header announces " + std::to_string (header.points) +
                     " points, which take at least " + std::to_string (needed) +
                     " bytes, but only " + std::to_string (scanner.remaining()) +
                     " follow");
  const std::string_view data = scanner.bytes (needed, "the data");
  points.makeRoom();
  if (!compressed) {
    points.add (data.data(), false);
    return;
  }
  points.add (unpackLzf (data, size).get(), true);
}

} // namespace

FileContent
readPcd (const std::string& text)
{
  TextScanner scanner (text, '#');
  const PcdHeader header = readHeader (scanner);
  PcdPoints points (header);
  if (header.coding == "ascii")
    readRows (header, scanner, points);
  else
    readBinary (header, scanner, points);
  return points.take();
}

} // namespace crest
} // namespace pcl
