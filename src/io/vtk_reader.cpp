// SPDX-License-Identifier: BSD-3-Clause
// VTK legacy polydata and unstructured grids, text and binary, of file versions 1 to 5:
// POINTS, POLYGONS, TRIANGLE_STRIPS, CELLS that are faces, and the NORMALS of points,
// whose other arrays pass through; all else is passed over. vtkPolyDataReader is not
// used because it makes room for whatever sizes a file announces before it looks
// whether the data are there.
#include "io/file_content.h"
#include "io/number_type.h"
#include "io/point_arrays.h"

#include <cmath>

namespace pcl {
namespace crest {

namespace {

NumberType
typeOf (std::string_view name)
{
  if (name == "char" || name == "signed_char")
    return NumberType::INT8;
  if (name == "unsigned_char")
    return NumberType::UINT8;
  if (name == "short")
    return NumberType::INT16;
  if (name == "unsigned_short")
    return NumberType::UINT16;
  if (name == "int")
    return NumberType::INT32;
  if (name == "unsigned_int")
    return NumberType::UINT32;
  if (name == "long" || name == "vtktypeint64" || name == "vtkIdType")
    return NumberType::INT64;
  if (name == "unsigned_long" || name == "vtktypeuint64")
    return NumberType::UINT64;
  if (name == "float")
    return NumberType::FLOAT32;
  if (name == "double")
    return NumberType::FLOAT64;
  return NumberType::NONE;
}

class VtkReader {
public:
  explicit VtkReader (const std::string& text)
  : scanner_ (text, TextScanner::NO_COMMENTS)
  {}

  FileContent
  read ()
  {
    readHeader();
    for (std::string_view word = scanner_.nextWord(); !word.empty();
         word = scanner_.nextWord())
      readSection (word);
    if (content_.has_normals && normals_.size() != content_.points.size())
      throw ReadError ("it has " + std::to_string (normals_.size()) + " normals for " +
                       std::to_string (content_.points.size()) + " points");
    for (std::size_t i = 0; i < normals_.size(); ++i)
      content_.points.setNormal (i, normals_[i]);
    checkFaces (content_);
    arrays_.pass (content_);
    return std::move (content_);
  }

private:
  void
  readHeader ()
  {
    const std::string magic = "# vtk DataFile Version ";
    const std::string_view line = scanner_.rawLine();
    double version = 0.0;
    if (line.substr (0, magic.size()) != magic ||
        !parseNumber (
            line.substr (magic.size(), line.find_last_not_of (' ') + 1 - magic.size()),
            version))
      scanner_.fail ("expected \"# vtk DataFile Version 3.0\" or the like as the first "
                     "line: only the legacy format of VTK is supported");
    offsets_ = version >= 5.0;
    scanner_.rawLine();
    const std::string_view coding = scanner_.nextWord();
    binary_ = coding == "BINARY";
    if (!binary_ && coding != "ASCII")
      scanner_.fail ("expected ASCII or BINARY, found \"" +
                     TextScanner::shown (coding) + "\"");
    if (scanner_.nextWord() != "DATASET")
      scanner_.fail ("expected DATASET");
    const std::string_view dataset = scanner_.nextWord();
    if (dataset != "POLYDATA" && dataset != "UNSTRUCTURED_GRID")
      scanner_.fail ("only the datasets POLYDATA and UNSTRUCTURED_GRID are supported, "
                     "found \"" +
                     TextScanner::shown (dataset) + "\"");
    if (binary_)
      scanner_.forgetLines();
  }

  void
  readSection (std::string_view keyword)
  {
    if (keyword == "POINTS") {
      const std::size_t points = readSize ("points");
      checkPointCount (content_.points.size() + points);
      const std::size_t numbers = product (3, points);
      const NumberType type = readType();
      content_.has_floats = binary_ && type == NumberType::FLOAT32;
      const std::vector<double> values = readArray (numbers, type);
      for (std::size_t i = 0; i < values.size(); i += 3)
        content_.points.add (&values[i], false);
    }
    else if (keyword == "POLYGONS" || keyword == "TRIANGLE_STRIPS" ||
             keyword == "LINES" || keyword == "VERTICES" || keyword == "CELLS")
      readCells (keyword);
    else if (keyword == "CELL_TYPES")
      readCellTypes();
    else if (keyword == "POINT_DATA" || keyword == "CELL_DATA") {
      tuples_ = readSize ("tuples");
      of_points_ = keyword == "POINT_DATA";
    }
    else if (keyword == "METADATA") {
      scanner_.rawLine();
      while (scanner_.remaining() > 0 && !scanner_.rawLine().empty()) {
      }
    }
    else if (keyword == "FIELD")
      readField();
    else
      readAttribute (keyword);
  }

  void
  readCells (std::string_view keyword)
  {
    const std::size_t first = readSize ("cells");
    const std::size_t second = readSize ("numbers");
    std::vector<double> sizes;
    std::vector<double> corners;
    if (offsets_) {
      const std::vector<double> offsets = readNamedArray ("OFFSETS", first);
      corners = readNamedArray ("CONNECTIVITY", second);
      for (std::size_t i = 1; i < offsets.size(); ++i)
        sizes.push_back (offsets[i] - offsets[i - 1]);
    }
    else {
      const std::vector<double> numbers = readArray (second, NumberType::INT32);
      std::size_t next = 0;
      for (std::size_t i = 0; i < first && next < numbers.size(); ++i) {
        sizes.push_back (numbers[next++]);
        for (double j = 0; j < sizes.back() && next < numbers.size(); ++j)
          corners.push_back (numbers[next++]);
      }
    }
    if (keyword == "CELLS") {
      // Their types, which follow, tell what they are.
      cell_sizes_ = std::move (sizes);
      cell_corners_ = std::move (corners);
    }
    else if (keyword == "POLYGONS" || keyword == "TRIANGLE_STRIPS")
      addFaces (sizes, corners, keyword == "TRIANGLE_STRIPS");
  }

  void
  readCellTypes ()
  {
    constexpr double TRIANGLE = 5;
    constexpr double STRIP = 6;
    constexpr double POLYGON = 7;
    constexpr double QUAD = 9;
    const std::vector<double> types =
        readArray (readSize ("types of cells"), NumberType::INT32);
    if (types.size() != cell_sizes_.size())
      scanner_.fail ("there are " + std::to_string (cell_sizes_.size()) +
                     " cells, but " + std::to_string (types.size()) + " types of them");
    auto first = cell_corners_.begin();
    for (std::size_t i = 0; i < types.size(); ++i) {
      const double size = cell_sizes_[i];
      if (!(size >= 0 && size <= static_cast<double> (cell_corners_.end() - first)))
        scanner_.fail ("a cell has more corners than the file lists");
      const auto next = first + static_cast<std::ptrdiff_t> (size);
      if (types[i] == TRIANGLE || types[i] == STRIP || types[i] == POLYGON ||
          types[i] == QUAD)
        addFaces ({size}, {first, next}, types[i] == STRIP);
      first = next;
    }
  }

  void
  addFaces (const std::vector<double>& sizes,
            const std::vector<double>& corners,
            bool strips)
  {
    std::size_t first = 0;
    for (const double exact_size : sizes) {
      if (!(exact_size >= 0 && exact_size <= corners.size() - first))
        scanner_.fail ("a face has more corners than the file lists");
      const auto size = static_cast<std::size_t> (exact_size);
      for (std::size_t i = first; i < first + size; ++i)
        if (!(corners[i] >= 0 && corners[i] < content_.points.size()))
          scanner_.fail ("a face has a corner that is not one of the " +
                         std::to_string (content_.points.size()) + " points");
      const auto add = [&] (std::size_t i) {
        content_.faces.corners.push_back (static_cast<index_t> (corners[i]));
      };
      if (strips)
        for (std::size_t i = 0; i + 2 < size; ++i) {
          // Every other triangle of a strip runs the other way round.
          add (first + i + i % 2);
          add (first + i + 1 - i % 2);
          add (first + i + 2);
          content_.faces.close();
        }
      else {
        for (std::size_t i = first; i < first + size; ++i)
          add (i);
        content_.faces.close();
      }
      first += size;
    }
  }

  void
  readField ()
  {
    scanner_.nextWord();
    const std::size_t arrays = readSize ("arrays");
    for (std::size_t i = 0; i < arrays; ++i) {
      std::string name (scanner_.nextWord());
      if (name == "METADATA") {
        readSection (name);
        name = scanner_.nextWord();
      }
      const std::size_t components = readSize ("components");
      const std::size_t tuples = readSize ("tuples");
      const NumberType type = readType();
      take (name, type, components, readArray (product (components, tuples), type));
    }
  }

  void
  readAttribute (std::string_view keyword)
  {
    const std::string name (scanner_.nextWord());
    if (keyword == "NORMALS") {
      const std::vector<double> values = readArray (product (3, tuples_), readType());
      if (of_points_) {
        content_.has_normals = true;
        normals_.clear();
        for (std::size_t i = 0; i < values.size(); i += 3)
          normals_.emplace_back (
              Eigen::Map<const Eigen::Vector3d> (&values[i]).cast<float>());
      }
    }
    else if (keyword == "VECTORS")
      readAndTake (name, 3);
    else if (keyword == "TENSORS")
      readAndTake (name, 9);
    else if (keyword == "TENSORS6")
      readAndTake (name, 6);
    else if (keyword == "GLOBAL_IDS" || keyword == "PEDIGREE_IDS" ||
             keyword == "EDGE_FLAGS")
      readAndTake (name, 1);
    else if (keyword == "TEXTURE_COORDINATES")
      readAndTake (name, readSize ("dimensions"));
    else if (keyword == "COLOR_SCALARS") {
      const std::size_t components = readSize ("components");
      std::vector<double> values =
          readArray (product (components, tuples_), NumberType::UINT8);
      // In text they are numbers up to 1.
      for (double& value : values)
        value = binary_ ? value : std::round (255.0 * value);
      take (name, NumberType::UINT8, components, std::move (values));
    }
    else if (keyword == "LOOKUP_TABLE")
      readArray (product (4, readSize ("colors")), NumberType::UINT8);
    else if (keyword == "SCALARS") {
      const NumberType type = readType();
      std::size_t components = 1;
      std::string_view word = scanner_.nextWord();
      if (word != "LOOKUP_TABLE") {
        components = scanner_.number<std::size_t> (word, "the number of components");
        word = scanner_.nextWord();
      }
      if (word != "LOOKUP_TABLE")
        scanner_.fail ("expected LOOKUP_TABLE, found \"" + TextScanner::shown (word) +
                       "\"");
      scanner_.nextWord();
      take (name, type, components, readArray (product (components, tuples_), type));
    }
    else
      scanner_.fail ("expected a section of the VTK format, found \"" +
                     TextScanner::shown (keyword) + "\"");
  }

  void
  readAndTake (const std::string& name, std::size_t components)
  {
    const NumberType type = readType();
    take (name, type, components, readArray (product (components, tuples_), type));
  }

  /** \brief Takes an array if it is one of points. */
  void
  take (const std::string& name,
        NumberType type,
        std::size_t components,
        std::vector<double> values)
  {
    if (of_points_ && components != 0)
      arrays_.add (name, type, components, 0, std::move (values));
  }

  std::vector<double>
  readNamedArray (const char* name, std::size_t count)
  {
    const std::string_view word = scanner_.nextWord();
    if (word != name)
      scanner_.fail ("expected " + std::string (name) + ", found \"" +
                     TextScanner::shown (word) + "\"");
    return readArray (count, readType());
  }

  std::size_t
  readSize (const char* what)
  {
    return scanner_.number<std::size_t> (scanner_.nextWord(),
                                         "the number of " + std::string (what));
  }

  NumberType
  readType ()
  {
    const std::string_view name = scanner_.nextWord();
    const NumberType type = typeOf (name);
    if (type == NumberType::NONE)
      scanner_.fail ("expected a type of numbers, as float, found \"" +
                     TextScanner::shown (name) + "\"");
    return type;
  }

  /** \brief How many numbers that is, if the file could hold them. */
  std::size_t
  product (std::size_t a, std::size_t b) const
  {
    if (a != 0 && b > scanner_.remaining() / a)
      scanner_.fail (std::to_string (a) + " times " + std::to_string (b) +
                     " numbers are announced, but the file is too short for them");
    return a * b;
  }

  std::vector<double>
  readArray (std::size_t count, NumberType type)
  {
    product (1, count);
    std::vector<double> values;
    values.reserve (count);
    if (!binary_) {
      for (std::size_t i = 0; i < count; ++i)
        values.push_back (scanner_.number<double> (scanner_.nextWord(), "a number"));
      return values;
    }
    // The data begin after the line of their name.
    scanner_.rawLine();
    const std::size_t size = sizeOf (type);
    const std::string_view data = scanner_.bytes (count * size, "an array");
    for (std::size_t i = 0; i < count; ++i)
      values.push_back (decode (&data[i * size], type, true));
    return values;
  }

  TextScanner scanner_;
  bool binary_ = false;
  /** whether cells are stored by offsets, as since version 5 */
  bool offsets_ = false;
  std::vector<double> cell_sizes_;
  std::vector<double> cell_corners_;
  std::size_t tuples_ = 0;
  bool of_points_ = false;
  std::vector<Eigen::Vector3f> normals_;
  PointArrays arrays_;
  FileContent content_;
};

} // namespace

FileContent
readVtk (const std::string& text)
{
  return VtkReader (text).read();
}

} // namespace crest
} // namespace pcl
