// SPDX-License-Identifier: BSD-3-Clause
// PCD through PCL's reader, once its header is known to be true to the file:
// PCL makes room for as many points as the header announces.
#include "io/file_content.h"
#include "io/load_pcd_module.h"
#include "io/number_type.h"

#include <array>
#include <limits>

namespace pcl {
namespace crest {

namespace {

struct PcdHeader {
  std::vector<std::size_t> sizes;
  std::vector<std::size_t> counts;
  std::size_t fields = 0;
  std::size_t points = 0;
  std::string coding;

  std::uint64_t
  pointSize () const
  {
    std::uint64_t bytes = 0;
    for (std::size_t i = 0; i < fields; ++i)
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
    if (count == 0 || count > LARGEST)
      scanner.fail ("a field has a count of " + std::to_string (count) +
                    ", but must have one from 1 to " + std::to_string (LARGEST));
  return counts;
}

PcdHeader
readHeader (TextScanner& scanner)
{
  PcdHeader header;
  std::size_t width = 0;
  std::size_t height = 1;
  std::string types;
  bool has_width = false;
  bool has_points = false;
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
    if (words[0] == "FIELDS" || words[0] == "COLUMNS")
      header.fields = words.size() - 1;
    else if (words[0] == "SIZE")
      header.sizes = readSizes (scanner);
    else if (words[0] == "COUNT")
      header.counts = readCounts (scanner);
    else if (words[0] == "TYPE")
      for (std::size_t i = 1; i < words.size(); ++i)
        types += words[i];
    else if (words[0] == "WIDTH") {
      width = number();
      has_width = true;
    }
    else if (words[0] == "HEIGHT")
      height = number();
    else if (words[0] == "POINTS") {
      header.points = number();
      has_points = true;
    }
    else if (words[0] == "VIEWPOINT") {
      if (words.size() != 8)
        scanner.fail ("expected a viewpoint of 7 numbers");
      for (std::size_t i = 1; i < words.size(); ++i)
        scanner.number<double> (words[i], "a number");
    }
    else if (words[0] == "DATA" && words.size() == 2)
      header.coding = words[1];
    else if (words[0] != "VERSION")
      scanner.fail ("expected a line of a PCD header, found \"" +
                    TextScanner::shown (words[0]) + "\"");
  }
  checkPointCount (width * height);
  if (!has_points)
    header.points = width * height;
  if (header.counts.empty())
    header.counts.assign (header.fields, 1);
  if (!has_width || header.points != width * height)
    throw ReadError ("its header announces " + std::to_string (header.points) +
                     " points, but a width of " + std::to_string (width) +
                     " and a height of " + std::to_string (height));
  if (header.fields == 0 || header.sizes.size() != header.fields ||
      header.counts.size() != header.fields || types.size() != header.fields)
    throw ReadError ("its header needs FIELDS, SIZE, TYPE and COUNT of equal numbers");
  // PCL keeps the places of fields in an int.
  constexpr std::uint64_t LARGEST_POINT = std::numeric_limits<std::int32_t>::max();
  if (header.pointSize() > LARGEST_POINT)
    throw ReadError ("its header announces points of " +
                     std::to_string (header.pointSize()) + " bytes, but at most " +
                     std::to_string (LARGEST_POINT) + " are supported");
  return header;
}

/** \brief PCL's reader takes what it can of a row and makes up the rest. */
void
checkRows (const PcdHeader& header, TextScanner& scanner)
{
  std::size_t rows = 0;
  while (scanner.nextLine()) {
    if (++rows > header.points)
      scanner.fail ("expected " + std::to_string (header.points) +
                    " points as its header announces, found more");
    if (scanner.words().size() != header.numbers())
      scanner.fail ("expected " + std::to_string (header.numbers()) +
                    " numbers, found " + std::to_string (scanner.words().size()));
    for (const std::string_view word : scanner.words())
      scanner.number<double> (word, "a number");
  }
  if (rows != header.points)
    throw ReadError ("its header announces " + std::to_string (header.points) +
                     " points, but " + std::to_string (rows) + " follow");
}

void
checkData (const PcdHeader& header, TextScanner& scanner)
{
  if (header.coding == "ascii") {
    checkRows (header, scanner);
    return;
  }
  // Neither factor has more than 31 bits.
  const std::uint64_t size = header.points * header.pointSize();
  std::uint64_t needed = 0;
  if (header.coding == "binary")
    needed = size;
  else if (header.coding == "binary_compressed") {
    // LZF makes at most 264 bytes of 3.
    constexpr std::size_t BEST_RATIO = 88;
    const std::string_view sizes = scanner.bytes (8, "the size of the data");
    needed = decodeAs<std::uint32_t> (sizes.data(), false);
    const std::uint64_t inflated = decodeAs<std::uint32_t> (sizes.data() + 4, false);
    if (inflated != size || inflated / BEST_RATIO > needed)
      throw ReadError ("its compressed data do not make up the " +
                       std::to_string (header.points) + " points that it announces");
  }
  else
    throw ReadError ("its data are \"" + TextScanner::shown (header.coding) +
                     "\", but must be ascii, binary or binary_compressed");
  if (needed > scanner.remaining())
    throw ReadError ("its header announces " + std::to_string (header.points) +
                     " points, which take at least " + std::to_string (needed) +
                     " bytes, but only " + std::to_string (scanner.remaining()) +
                     " follow");
}

NumberType
typeOf (const pcl::PCLPointField& field)
{
  switch (field.datatype) {
  case pcl::PCLPointField::INT8:
    return NumberType::INT8;
  case pcl::PCLPointField::UINT8:
    return NumberType::UINT8;
  case pcl::PCLPointField::INT16:
    return NumberType::INT16;
  case pcl::PCLPointField::UINT16:
    return NumberType::UINT16;
  case pcl::PCLPointField::INT32:
    return NumberType::INT32;
  case pcl::PCLPointField::UINT32:
    return NumberType::UINT32;
  case pcl::PCLPointField::FLOAT32:
    return NumberType::FLOAT32;
  case pcl::PCLPointField::FLOAT64:
    return NumberType::FLOAT64;
  default:
    return NumberType::NONE;
  }
}

} // namespace

FileContent
readPcd (const std::string& file, const std::string& text)
{
  TextScanner scanner (text, '#');
  checkData (readHeader (scanner), scanner);

  pcl::PCLPointCloud2 data;
  Eigen::Vector4f origin;
  Eigen::Quaternionf orientation;
  if (!loadPcdReader() (file.c_str(), data, origin, orientation))
    throw ReadError ("its data are not as its header says");

  constexpr std::array<const char*, 6> NAMES{
      "x", "y", "z", "normal_x", "normal_y", "normal_z"};
  std::array<const pcl::PCLPointField*, 6> fields{};
  const pcl::PCLPointField* packed_color = nullptr;
  std::string present;
  for (const pcl::PCLPointField& field : data.fields) {
    present += (present.empty() ? "" : " ") + field.name;
    for (std::size_t i = 0; i < NAMES.size(); ++i)
      if (field.name == NAMES[i] && typeOf (field) != NumberType::NONE)
        fields[i] = &field;
    if ((field.name == "rgb" || field.name == "rgba") && sizeOf (typeOf (field)) == 4)
      packed_color = &field;
  }
  if (!fields[0] || !fields[1] || !fields[2])
    throw ReadError ("it has the fields \"" + present +
                     "\", but x, y and z are needed");
  FileContent content;
  content.has_normals = fields[3] && fields[4] && fields[5];
  content.viewpoint = origin.head<3>();
  const std::size_t numbers = content.has_normals ? 6 : 3;
  const std::size_t size = std::size_t (data.width) * data.height;
  content.points->reserve (size);
  for (std::size_t i = 0; i < size; ++i) {
    const auto* const point =
        reinterpret_cast<const char*> (data.data.data() + i * data.point_step);
    double values[6];
    for (std::size_t j = 0; j < numbers; ++j)
      values[j] =
          decode (point + fields[j]->offset, typeOf (*fields[j]), HOST_IS_BIG_ENDIAN);
    content.points->push_back (makePoint (values, content.has_normals));
    if (packed_color != nullptr) {
      // Whatever the type says, it is not a number but bytes.
      const auto color =
          decodeAs<std::uint32_t> (point + packed_color->offset, HOST_IS_BIG_ENDIAN);
      content.colors.push_back ({static_cast<unsigned char> (color >> 16U),
                                 static_cast<unsigned char> (color >> 8U),
                                 static_cast<unsigned char> (color)});
    }
  }
  content.points->width = data.width;
  content.points->height = data.height;
  content.points->sensor_origin_ = origin;
  content.points->sensor_orientation_ = orientation;
  return content;
}

} // namespace crest
} // namespace pcl
