// SPDX-License-Identifier: BSD-3-Clause
// VTK's XML polydata: points, normals, other arrays of points and faces, in text,
// base64 or raw bytes, compressed by zlib or not. vtkXMLPolyDataReader is not used
// because it would load VTK, and makes room for whatever a file announces.
#include <boost/property_tree/ptree.hpp>
#include <boost/property_tree/xml_parser.hpp>

#include "io/file_content.h"
#include "io/number_type.h"
#include "io/point_arrays.h"
#include "io/unpack_blocks.h"

#include <array>
#include <cmath>
#include <sstream>

namespace pcl {
namespace crest {

namespace {

namespace pt = boost::property_tree;

NumberType
typeOf (const std::string& name)
{
  constexpr std::array<std::pair<const char*, NumberType>, 10> TYPES{
      {{"Int8", NumberType::INT8},
       {"UInt8", NumberType::UINT8},
       {"Int16", NumberType::INT16},
       {"UInt16", NumberType::UINT16},
       {"Int32", NumberType::INT32},
       {"UInt32", NumberType::UINT32},
       {"Int64", NumberType::INT64},
       {"UInt64", NumberType::UINT64},
       {"Float32", NumberType::FLOAT32},
       {"Float64", NumberType::FLOAT64}}};
  for (const auto& [known, type] : TYPES)
    if (name == known)
      return type;
  return NumberType::NONE;
}

std::string
attribute (const pt::ptree& element, const std::string& name)
{
  return element.get ("<xmlattr>." + name, std::string());
}

class VtpReader {
public:
  explicit VtpReader (const std::string& text) : text_ (text) {}

  FileContent
  read ()
  {
    const pt::ptree document = parse();
    const auto file = document.get_child_optional ("VTKFile");
    if (!file)
      throw ReadError ("it has no element VTKFile");
    if (attribute (*file, "type") != "PolyData")
      throw ReadError ("its VTKFile has the type \"" +
                       TextScanner::shown (attribute (*file, "type")) +
                       "\", but must have PolyData");
    encoding_.big_endian = attribute (*file, "byte_order") == "BigEndian";
    encoding_.wide_sizes = attribute (*file, "header_type") == "UInt64";
    const std::string compressor = attribute (*file, "compressor");
    encoding_.compressed = !compressor.empty();
    if (encoding_.compressed && compressor != "vtkZLibDataCompressor")
      throw ReadError ("its data are compressed by " + TextScanner::shown (compressor) +
                       ", but must be by vtkZLibDataCompressor or not at all");
    if (const auto data = file->get_child_optional ("PolyData"))
      for (const auto& [name, piece] : *data)
        if (name == "Piece")
          readPiece (piece);
    checkFaces (content_);
    arrays_.pass (content_);
    return std::move (content_);
  }

private:
  /** \brief The XML, but for bytes appended to it, which are none. */
  pt::ptree
  parse ()
  {
    std::string xml;
    const std::size_t element = text_.find ("<AppendedData");
    const std::size_t start =
        element == std::string::npos ? element : text_.find ('>', element);
    if (start == std::string::npos)
      xml = text_;
    else {
      xml = text_.substr (0, start + 1) + "</AppendedData></VTKFile>";
      appended_ = text_.find ('_', start);
      if (appended_ == std::string::npos)
        throw ReadError ("its appended data do not begin with _");
      ++appended_;
    }
    checkDepth (xml);
    pt::ptree document;
    try {
      std::istringstream stream (xml);
      pt::read_xml (stream, document);
    }
    catch (const pt::xml_parser_error& problem) {
      throw ReadError ("it is no XML: " + problem.message(), problem.line());
    }
    const std::string encoding = document.get (
        "VTKFile.AppendedData.<xmlattr>.encoding", std::string ("base64"));
    appended_is_raw_ = encoding == "raw";
    return document;
  }

  /** \brief The parser calls itself for elements within elements. */
  static void
  checkDepth (const std::string& xml)
  {
    // VTK has six.
    constexpr int MOST = 64;
    int depth = 0;
    for (std::size_t i = xml.find ('<'); i != std::string::npos;
         i = xml.find ('<', i)) {
      const std::size_t end = xml.find ('>', i);
      if (end == std::string::npos)
        return;
      if (xml[i + 1] == '/')
        --depth;
      else if (xml[i + 1] != '?' && xml[i + 1] != '!' && xml[end - 1] != '/')
        ++depth;
      if (depth > MOST)
        throw ReadError ("its elements are nested more than " + std::to_string (MOST) +
                         " deep, which VTK's are not");
      i = end;
    }
  }

  void
  readPiece (const pt::ptree& piece)
  {
    const std::size_t before = content_.points.size();
    const std::size_t points = countOf (piece, "NumberOfPoints");
    const std::vector<double> positions =
        readArray (child (child (piece, "Points"), "DataArray"), 3 * points, "points");
    checkPointCount (before + points);
    std::vector<double> normals;
    if (const auto of_points = piece.get_child_optional ("PointData")) {
      for (const auto& [name, array] : *of_points)
        if (name == "DataArray" && isNormals (*of_points, array))
          normals = readArray (array, 3 * points, "normals");
        else if (name == "DataArray")
          pass (array, before, points);
    }
    const bool has_normals = !normals.empty();
    if (before != 0 && has_normals != content_.has_normals && points != 0)
      throw ReadError ("only some of its pieces have normals");
    content_.has_normals = has_normals;
    content_.points.reserve (before + points);
    for (std::size_t i = 0; i < points; ++i) {
      std::array<double, 6> values{};
      std::copy_n (&positions[3 * i], 3, values.begin());
      if (has_normals)
        std::copy_n (&normals[3 * i], 3, values.begin() + 3);
      content_.points.add (values.data(), has_normals);
    }
    readCells (piece, "Polys", "NumberOfPolys", before, points);
    readCells (piece, "Strips", "NumberOfStrips", before, points);
  }

  /** \brief Keeps an array of a piece's points for the output. */
  void
  pass (const pt::ptree& array, std::size_t before, std::size_t points)
  {
    constexpr std::size_t MOST_COMPONENTS = 1024;
    const std::string name = attribute (array, "Name");
    const std::string word = attribute (array, "NumberOfComponents");
    const NumberType type = typeOf (attribute (array, "type"));
    std::size_t components = 1;
    if (type == NumberType::NONE || points == 0)
      return;
    if (!word.empty() && (!parseNumber (word, components) || components == 0 ||
                          components > MOST_COMPONENTS))
      throw ReadError ("the array \"" + TextScanner::shown (name) + "\" has \"" +
                       TextScanner::shown (word) +
                       "\" components, but must have from 1 to " +
                       std::to_string (MOST_COMPONENTS));
    arrays_.add (name,
                 type,
                 components,
                 before,
                 readArray (array,
                            components * points,
                            "\"" + TextScanner::shown (name) + "\""));
  }

  static bool
  isNormals (const pt::ptree& of_points, const pt::ptree& array)
  {
    const std::string chosen = attribute (of_points, "Normals");
    return attribute (array, "Name") == (chosen.empty() ? "Normals" : chosen) &&
           attribute (array, "NumberOfComponents") == "3";
  }

  /** \param[in] before points of the pieces before this one
   * \param[in] points of this one
   */
  void
  readCells (const pt::ptree& piece,
             const char* element,
             const char* count_name,
             std::size_t before,
             std::size_t points)
  {
    const std::size_t count = countOf (piece, count_name);
    if (count == 0)
      return;
    std::vector<double> ends;
    const pt::ptree* corners_array = nullptr;
    for (const auto& [name, array] : child (piece, element))
      if (name == "DataArray" && attribute (array, "Name") == "offsets")
        ends = readArray (array, count, "offsets");
      else if (name == "DataArray" && attribute (array, "Name") == "connectivity")
        corners_array = &array;
    if (ends.empty() || corners_array == nullptr)
      throw ReadError (std::string ("its ") + element +
                       " need the arrays connectivity and offsets");
    double before_end = 0.0;
    for (const double end : ends) {
      if (!(end >= before_end) || end != std::floor (end) || end > MOST_NUMBERS)
        throw ReadError (std::string ("the offsets of its ") + element +
                         " must be whole numbers that do not fall, found " +
                         std::to_string (end));
      before_end = end;
    }
    const std::vector<double> corners = readArray (
        *corners_array, static_cast<std::size_t> (ends.back()), "connectivity");
    for (const double corner : corners)
      if (!(corner >= 0.0 && corner < static_cast<double> (points)))
        throw ReadError ("a face has the corner " + std::to_string (corner) +
                         ", but its piece has " + std::to_string (points) + " points");
    const bool strips = std::string (element) == "Strips";
    std::size_t first = 0;
    for (const double end_number : ends) {
      const auto end = static_cast<std::size_t> (end_number);
      const auto add = [&] (std::size_t i) {
        content_.faces.corners.push_back (
            static_cast<index_t> (before + static_cast<std::size_t> (corners[i])));
      };
      if (!strips) {
        for (std::size_t i = first; i < end; ++i)
          add (i);
        content_.faces.close();
      }
      for (std::size_t i = first; strips && i + 2 < end; ++i) {
        // Every other triangle of a strip runs the other way round.
        const std::size_t odd = (i - first) % 2;
        add (i + odd);
        add (i + 1 - odd);
        add (i + 2);
        content_.faces.close();
      }
      first = end;
    }
  }

  static const pt::ptree&
  child (const pt::ptree& parent, const char* name)
  {
    const auto found = parent.get_child_optional (name);
    if (!found)
      throw ReadError (std::string ("it lacks an element ") + name);
    return *found;
  }

  static std::size_t
  countOf (const pt::ptree& piece, const char* name)
  {
    const std::string word = attribute (piece, name);
    std::size_t count = 0;
    if (!word.empty() && (!parseNumber (word, count) || count > MOST_NUMBERS))
      throw ReadError (std::string (name) + " is \"" + TextScanner::shown (word) +
                       "\", but must be a whole number up to " +
                       std::to_string (MOST_NUMBERS));
    return count;
  }

  std::vector<double>
  readArray (const pt::ptree& array, std::size_t count, const std::string& what)
  {
    const std::string name = attribute (array, "type");
    const NumberType type = typeOf (name);
    if (type == NumberType::NONE)
      throw ReadError ("the array of its " + what + " has the type \"" +
                       TextScanner::shown (name) +
                       "\", but must have one as Float32 or Int64");
    if (count == 0)
      return {};
    const std::string format = attribute (array, "format");
    if (format == "ascii")
      return readWords (array.data(), count, what);
    std::string bytes;
    const std::size_t size = count * sizeOf (type);
    if (format == "binary")
      bytes = unpackBase64 (array.data(), size, encoding_, what);
    else if (format == "appended") {
      std::size_t offset = 0;
      const std::string word = attribute (array, "offset");
      if (!parseNumber (word, offset) || appended_ == std::string::npos ||
          offset > text_.size() - appended_)
        throw ReadError ("the array of its " + what + " has the offset \"" +
                         TextScanner::shown (word) +
                         "\", but that is not within the appended data");
      const std::string_view data =
          std::string_view (text_).substr (appended_ + offset);
      bytes = appended_is_raw_ ? unpackRaw (data, size, encoding_, what)
                               : unpackBase64 (data, size, encoding_, what);
    }
    else
      throw ReadError ("the array of its " + what + " has the format \"" +
                       TextScanner::shown (format) +
                       "\", but must have ascii, binary or appended");
    std::vector<double> values (count);
    for (std::size_t i = 0; i < count; ++i)
      values[i] = decode (&bytes[i * sizeOf (type)], type, encoding_.big_endian);
    return values;
  }

  static std::vector<double>
  readWords (const std::string& text, std::size_t count, const std::string& what)
  {
    TextScanner scanner (text, TextScanner::NO_COMMENTS);
    scanner.forgetLines();
    // A number takes a digit and a blank.
    if (count > (text.size() + 1) / 2)
      scanner.fail ("the array of its " + what + " should have " +
                    std::to_string (count) + " numbers, but is too short for them");
    std::vector<double> values (count);
    for (double& value : values)
      value = scanner.number<double> (scanner.nextWord(), "a number of its " + what);
    if (!scanner.nextWord().empty())
      scanner.fail ("the array of its " + what + " has more than the " +
                    std::to_string (count) + " numbers that are announced");
    return values;
  }

  static constexpr std::size_t MOST_NUMBERS = std::size_t (1) << 40U;

  const std::string& text_;
  /** where appended data begin */
  std::size_t appended_ = std::string::npos;
  bool appended_is_raw_ = false;
  BlockEncoding encoding_;
  PointArrays arrays_;
  FileContent content_;
};

} // namespace

FileContent
readVtp (const std::string& text)
{
  return VtpReader (text).read();
}

} // namespace crest
} // namespace pcl
