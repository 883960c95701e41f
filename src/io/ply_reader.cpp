// SPDX-License-Identifier: BSD-3-Clause
// PLY, text and binary of either byte order: x y z, normals and faces; all other
// numbers of vertices pass through, but for lists. pcl::PLYReader is not used because
// it makes room for as many points as the header announces before it looks whether they
// are there.
#include "io/file_content.h"
#include "io/file_fields.h"
#include "io/number_type.h"
#include "io/point_field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

namespace pcl {
namespace crest {

namespace {

struct Property {
  std::string name;
  NumberType type;
  /** of the number in front of a list; NONE where it is no list */
  NumberType count_type = NumberType::NONE;
};

struct Element {
  std::string name;
  std::size_t count;
  std::vector<Property> properties;
};

NumberType
typeOf (std::string_view name)
{
  if (name == "char" || name == "int8")
    return NumberType::INT8;
  if (name == "uchar" || name == "uint8")
    return NumberType::UINT8;
  if (name == "short" || name == "int16")
    return NumberType::INT16;
  if (name == "ushort" || name == "uint16")
    return NumberType::UINT16;
  if (name == "int" || name == "int32")
    return NumberType::INT32;
  if (name == "uint" || name == "uint32")
    return NumberType::UINT32;
  if (name == "float" || name == "float32")
    return NumberType::FLOAT32;
  if (name == "double" || name == "float64")
    return NumberType::FLOAT64;
  return NumberType::NONE;
}

class PlyReader {
public:
  explicit PlyReader (const std::string& text)
  : scanner_ (text, TextScanner::NO_COMMENTS)
  {}

  FileContent
  read ()
  {
    readHeader();
    for (const Element& element : elements_)
      readElement (element);
    checkFaces (content_);
    return std::move (content_);
  }

private:
  void
  readHeader ()
  {
    if (scanner_.rawLine() != "ply")
      scanner_.fail ("expected \"ply\" as the first line");
    bool has_format = false;
    while (true) {
      if (!scanner_.nextLine())
        scanner_.fail ("the file ends within its header, before \"end_header\"");
      const std::vector<std::string_view>& words = scanner_.words();
      if (words[0] == "end_header")
        break;
      if (words[0] == "format" && words.size() == 3) {
        readFormat (words[1]);
        has_format = true;
      }
      else if (words[0] == "element" && words.size() == 3) {
        if (words[1] == "vertex" && hasVertices())
          scanner_.fail ("the header has the element \"vertex\" twice");
        elements_.push_back (
            {std::string (words[1]),
             scanner_.number<std::size_t> (words[2], "the number of elements"),
             {}});
        if (words[1] == "vertex")
          checkPointCount (elements_.back().count);
      }
      else if (words[0] == "property")
        readProperty();
      else if (words[0] != "comment" && words[0] != "obj_info")
        scanner_.fail ("expected format, element, property, comment or end_header, "
                       "found \"" +
                       TextScanner::shown (words[0]) + "\"");
    }
    if (!has_format)
      scanner_.fail ("the header has no format line");
    if (!text_)
      scanner_.forgetLines();
  }

  bool
  hasVertices () const
  {
    return std::any_of (elements_.begin(), elements_.end(), [] (const Element& e) {
      return e.name == "vertex";
    });
  }

  void
  readFormat (std::string_view name)
  {
    text_ = name == "ascii";
    big_endian_ = name == "binary_big_endian";
    if (!text_ && !big_endian_ && name != "binary_little_endian")
      scanner_.fail ("expected the format ascii, binary_little_endian or "
                     "binary_big_endian, found \"" +
                     TextScanner::shown (name) + "\"");
  }

  void
  readProperty ()
  {
    const std::vector<std::string_view>& words = scanner_.words();
    if (elements_.empty())
      scanner_.fail ("a property comes after an element");
    const bool list = words.size() == 5 && words[1] == "list";
    if (!list && words.size() != 3)
      scanner_.fail ("expected a property as \"property float x\" or \"property list "
                     "uchar int vertex_indices\"");
    Property property{std::string (words.back()), typeOf (words[words.size() - 2])};
    if (list)
      property.count_type = typeOf (words[2]);
    if (property.type == NumberType::NONE ||
        (list && property.count_type == NumberType::NONE))
      scanner_.fail ("property \"" + TextScanner::shown (words.back()) +
                     "\" has a type that is not of the PLY format");
    elements_.back().properties.push_back (std::move (property));
  }

  void
  readElement (const Element& element)
  {
    if (element.properties.empty())
      return;
    // A number takes at least a digit and a blank in text.
    std::size_t least = 0;
    for (const Property& property : element.properties)
      least += text_ ? 2
                     : sizeOf (property.count_type == NumberType::NONE
                                   ? property.type
                                   : property.count_type);
    if (element.count > (scanner_.remaining() + 1) / least)
      scanner_.fail ("the header announces " + std::to_string (element.count) +
                     " elements \"" + TextScanner::shown (element.name) +
                     "\", but the file is too short for them");
    if (element.name == "vertex")
      readVertices (element);
    else
      readOthers (element);
  }

  void
  readVertices (const Element& element)
  {
    // Of several properties that are the same field the first counts.
    std::vector<std::size_t> place (element.properties.size(), KEPT_FIELDS);
    std::array<bool, KEPT_FIELDS> found{};
    for (std::size_t i = 0; i < place.size(); ++i) {
      const Property& property = element.properties[i];
      const PointField field = pointFieldOf (property.name);
      if (!isKept (field) || property.count_type != NumberType::NONE ||
          found[placeOf (field)])
        continue;
      const bool is_color = field >= PointField::RED;
      found[placeOf (field)] = !is_color || property.type == NumberType::UINT8;
      if (field == PointField::X)
        content_.has_floats = !text_ && property.type == NumberType::FLOAT32;
      place[i] = placeOf (field);
    }
    if (!found[0] || !found[1] || !found[2])
      throw ReadError ("its vertices need the properties x, y and z");
    content_.has_normals = found[3] && found[4] && found[5];
    const bool has_colors = found[6] && found[7] && found[8];
    const std::vector<bool> passes = passProperties (element, place);
    content_.points.reserve (content_.points.size() + element.count);
    content_.fields.records.reserve (element.count * content_.fields.record_size);
    for (std::size_t i = 0; i < element.count; ++i) {
      double values[KEPT_FIELDS] = {};
      char* record = addRecord (content_.fields);
      for (std::size_t j = 0; j < place.size(); ++j) {
        const NumberType type = element.properties[j].type;
        if (element.properties[j].count_type != NumberType::NONE) {
          skipList (element.properties[j]);
          continue;
        }
        const std::string_view number = nextNumber (type);
        if (place[j] < KEPT_FIELDS)
          values[place[j]] = valueOf (number, type);
        if (passes[j]) {
          passNumber (number, type, record);
          record += sizeOf (type);
        }
      }
      content_.points.add (values, content_.has_normals);
      if (has_colors)
        content_.colors.push_back (
            {colorOf (values[6]), colorOf (values[7]), colorOf (values[8])});
    }
  }

  /** \brief Makes a field of each property that is no list, position or normal.
   * \param[in] place what the properties are
   * \return for each whether it passes through
   */
  std::vector<bool>
  passProperties (const Element& element, const std::vector<std::size_t>& place)
  {
    std::vector<bool> passes (place.size(), false);
    const std::size_t used =
        placeOf (content_.has_normals ? PointField::RED : PointField::NX);
    for (std::size_t i = 0; i < place.size(); ++i) {
      const Property& property = element.properties[i];
      if (property.count_type != NumberType::NONE)
        content_.notes.push_back ("The list " + TextScanner::shown (property.name) +
                                  " of the vertices is left out.");
      else if (place[i] >= used) {
        addField (content_.fields, property.name, property.type);
        passes[i] = true;
      }
    }
    return passes;
  }

  void
  passNumber (std::string_view number, NumberType type, char* bytes) const
  {
    if (text_)
      encodeWord (number, type, bytes);
    else
      copyNumber (number.data(), number.size(), big_endian_, bytes);
  }

  /** \brief Text may hold any number, whatever its type. */
  static unsigned char
  colorOf (double value)
  {
    return value >= 0.0 && value <= 255.0 ? static_cast<unsigned char> (value) : 0;
  }

  void
  readOthers (const Element& element)
  {
    for (std::size_t i = 0; i < element.count; ++i)
      for (const Property& property : element.properties) {
        if (property.count_type == NumberType::NONE)
          readNumber (property.type);
        else if (element.name == "face" &&
                 (property.name == "vertex_indices" || property.name == "vertex_index"))
          readFace (property);
        else
          skipList (property);
      }
  }

  void
  readFace (const Property& property)
  {
    const std::size_t corners = readCount (property);
    for (std::size_t i = 0; i < corners; ++i)
      content_.faces.corners.push_back (
          static_cast<index_t> (readInteger (property.type, "the index of a vertex")));
    content_.faces.close();
  }

  void
  skipList (const Property& property)
  {
    const std::size_t count = readCount (property);
    for (std::size_t i = 0; i < count; ++i)
      readNumber (property.type);
  }

  std::size_t
  readCount (const Property& property)
  {
    const auto count = static_cast<std::size_t> (
        readInteger (property.count_type, "the length of a list"));
    if (count > scanner_.remaining())
      scanner_.fail ("a list of " + std::to_string (count) +
                     " numbers is longer than the file");
    return count;
  }

  /** \brief A whole number that an index_t can hold, not negative. */
  double
  readInteger (NumberType type, const char* what)
  {
    const double value = readNumber (type);
    if (!(value >= 0.0 && value <= std::numeric_limits<index_t>::max()) ||
        value != std::floor (value))
      scanner_.fail ("expected " + std::string (what) + ", found " +
                     std::to_string (value));
    return value;
  }

  /** \brief The word or the bytes of the next number. */
  std::string_view
  nextNumber (NumberType type)
  {
    return text_ ? scanner_.nextWord() : scanner_.bytes (sizeOf (type), "a number");
  }

  double
  valueOf (std::string_view number, NumberType type) const
  {
    return text_ ? scanner_.number<double> (number, "a number")
                 : decode (number.data(), type, big_endian_);
  }

  double
  readNumber (NumberType type)
  {
    return valueOf (nextNumber (type), type);
  }

  TextScanner scanner_;
  bool text_ = false;
  bool big_endian_ = false;
  std::vector<Element> elements_;
  FileContent content_;
};

} // namespace

FileContent
readPly (const std::string& text)
{
  return PlyReader (text).read();
}

} // namespace crest
} // namespace pcl
