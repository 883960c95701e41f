// SPDX-License-Identifier: BSD-3-Clause
// VTK's polydata, legacy and XML. The colors of points are there for pcl_viewer, which
// shows no others.
#include "io/line_file.h"

namespace pcl {
namespace crest {

namespace {

constexpr char TITLE[] = "crest lines: type 1 is a ridge, 2 a valley";

const char*
legacyType (VtkArray::Kind kind)
{
  return kind == VtkArray::Kind::BYTES   ? "unsigned_char"
         : kind == VtkArray::Kind::WHOLE ? "int"
                                         : "double";
}

const char*
xmlType (VtkArray::Kind kind)
{
  return kind == VtkArray::Kind::BYTES   ? "UInt8"
         : kind == VtkArray::Kind::WHOLE ? "Int32"
                                         : "Float64";
}

void
appendScalars (std::string& text, const VtkArray& array)
{
  text += "SCALARS " + array.name + " " + legacyType (array.kind) + " " +
          std::to_string (array.components) + "\nLOOKUP_TABLE default\n" + array.values;
}

std::string
xmlArray (const VtkArray& array)
{
  return std::string ("<DataArray type=\"") + xmlType (array.kind) + "\" Name=\"" +
         array.name + "\" NumberOfComponents=\"" + std::to_string (array.components) +
         "\" format=\"ascii\">\n" + array.values + "</DataArray>\n";
}

} // namespace

VtkCells
vtkCells (const LinePoints& points, const std::vector<CrestLine>& lines)
{
  using Kind = VtkArray::Kind;
  VtkCells cells;
  cells.arrays = {{"RGB", 3, Kind::BYTES, {}},
                  {"type", 1, Kind::WHOLE, {}},
                  {"line", 1, Kind::WHOLE, {}},
                  {"first_end", 1, Kind::WHOLE, {}},
                  {"last_end", 1, Kind::WHOLE, {}}};
  for (const Measure& measure : MEASURES)
    cells.arrays.push_back (
        {measure.name, 1, measure.whole ? Kind::WHOLE : Kind::REAL, {}});
  for (std::size_t i = 0; i < lines.size(); ++i)
    for (std::size_t p = 0; p < lines[i].polylines.size(); ++p) {
      auto array = cells.arrays.begin();
      const auto add = [&array] (const auto& append) {
        append (array->values);
        array->values += '\n';
        ++array;
      };
      add ([&] (std::string& text) { text += colorText (colorOf (lines[i].type)); });
      add ([&] (std::string& text) {
        appendNumber (text, static_cast<int> (lines[i].type));
      });
      add ([&] (std::string& text) { appendNumber (text, i); });
      for (const LineEnd end : lines[i].ends[p])
        add ([&] (std::string& text) { appendNumber (text, static_cast<int> (end)); });
      for (const Measure& measure : MEASURES)
        add ([&] (std::string& text) { appendMeasure (text, measure, lines[i]); });
      std::vector<std::size_t>& cell = cells.points.emplace_back();
      for (const index_t point : lines[i].polylines[p])
        cell.push_back (points.place (point));
    }
  cells.point_colors = {"RGB", 3, Kind::BYTES, {}};
  for (const Rgb& color : points.colors())
    cells.point_colors.values += colorText (color) + "\n";
  return cells;
}

std::string
toVtk (const LinePoints& points, const std::vector<CrestLine>& lines)
{
  const VtkCells cells = vtkCells (points, lines);
  std::string places;
  std::size_t numbers = 0;
  for (const std::vector<std::size_t>& cell : cells.points) {
    appendNumber (places, cell.size());
    for (const std::size_t place : cell) {
      places += ' ';
      appendNumber (places, place);
    }
    places += '\n';
    numbers += cell.size() + 1;
  }
  const std::string count = std::to_string (cells.points.size());
  std::string text = std::string ("# vtk DataFile Version 3.0\n") + TITLE +
                     "\nASCII\nDATASET POLYDATA\nPOINTS " +
                     std::to_string (points.size()) +
                     (points.hasDoubles() ? " double\n" : " float\n");
  points.append (text, "");
  text += "LINES " + count + " " + std::to_string (numbers) + "\n" + places +
          "POINT_DATA " + std::to_string (points.size()) + "\n";
  appendScalars (text, cells.point_colors);
  text += "CELL_DATA " + count + "\n";
  appendScalars (text, cells.arrays[0]);
  text += "FIELD FieldData " + std::to_string (cells.arrays.size() - 1) + "\n";
  for (std::size_t i = 1; i < cells.arrays.size(); ++i)
    text += cells.arrays[i].name + " 1 " + count + " " +
            legacyType (cells.arrays[i].kind) + "\n" + cells.arrays[i].values;
  return text;
}

std::string
toVtp (const LinePoints& points, const std::vector<CrestLine>& lines)
{
  const VtkCells cells = vtkCells (points, lines);
  VtkArray places{"connectivity", 1, VtkArray::Kind::WHOLE, {}};
  VtkArray ends{"offsets", 1, VtkArray::Kind::WHOLE, {}};
  std::size_t end = 0;
  for (const std::vector<std::size_t>& cell : cells.points) {
    for (const std::size_t place : cell) {
      appendNumber (places.values, place);
      places.values += '\n';
    }
    end += cell.size();
    appendNumber (ends.values, end);
    ends.values += '\n';
  }
  std::string text =
      std::string ("<?xml version=\"1.0\"?>\n<!-- ") + TITLE +
      " -->\n<VTKFile type=\"PolyData\" version=\"0.1\" "
      "byte_order=\"LittleEndian\">\n<PolyData>\n"
      "<Piece NumberOfPoints=\"" +
      std::to_string (points.size()) + "\" NumberOfVerts=\"0\" NumberOfLines=\"" +
      std::to_string (cells.points.size()) +
      "\" NumberOfStrips=\"0\" NumberOfPolys=\"0\">\n"
      "<PointData Scalars=\"RGB\">\n" +
      xmlArray (cells.point_colors) + "</PointData>\n<CellData Scalars=\"RGB\">\n";
  for (const VtkArray& array : cells.arrays)
    text += xmlArray (array);
  text += std::string ("</CellData>\n<Points>\n<DataArray type=\"") +
          (points.hasDoubles() ? "Float64" : "Float32") +
          "\" Name=\"Points\" NumberOfComponents=\"3\" format=\"ascii\">\n";
  points.append (text, "");
  return text + "</DataArray>\n</Points>\n<Lines>\n" + xmlArray (places) +
         xmlArray (ends) + "</Lines>\n</Piece>\n</PolyData>\n</VTKFile>\n";
}

} // namespace crest
} // namespace pcl
