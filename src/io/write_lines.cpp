// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_crest/io/write_lines.h>

#include "io/format_number.h"
#include "io/output_file.h"
#include "io/placement.h"

#include <algorithm>
#include <array>

namespace pcl {
namespace crest {

namespace {

/** \brief The points on lines, and their places in the file. */
class LinePoints {
public:
  LinePoints (const pcl::PointCloud<pcl::PointNormal>& cloud,
              const std::vector<CrestLine>& lines,
              const Placement& placement)
  : cloud_ (cloud), placement_ (placement)
  {
    for (const CrestLine& line : lines)
      for (const std::vector<index_t>& polyline : line.polylines)
        used_.insert (used_.end(), polyline.begin(), polyline.end());
    std::sort (used_.begin(), used_.end());
    used_.erase (std::unique (used_.begin(), used_.end()), used_.end());
  }

  std::size_t
  size () const
  {
    return used_.size();
  }

  /** \brief The place of a point of the cloud in the file, from 0. */
  std::size_t
  place (index_t point) const
  {
    return static_cast<std::size_t> (
        std::lower_bound (used_.begin(), used_.end(), point) - used_.begin());
  }

  /** \brief The type of the coordinates, as PLY and VTK name it. */
  const char*
  type () const
  {
    return needsDoubles (placement_) ? "double" : "float";
  }

  /** \brief Appends a line of coordinates for each point. */
  void
  append (std::string& text, const char* prefix) const
  {
    for (const index_t i : used_) {
      text += prefix;
      appendPlace (text, cloud_[i].getVector3fMap(), placement_);
      text += '\n';
    }
  }

private:
  const pcl::PointCloud<pcl::PointNormal>& cloud_;
  const Placement& placement_;
  /** ascending */
  std::vector<index_t> used_;
};

std::string
toObj (const LinePoints& points, const std::vector<CrestLine>& lines)
{
  std::string text;
  points.append (text, "v ");
  for (const CrestType type : CREST_TYPES) {
    bool first = true;
    for (const CrestLine& line : lines) {
      if (line.type != type)
        continue;
      if (first)
        text += type == CrestType::RIDGE ? "g ridge\n" : "g valley\n";
      first = false;
      for (const std::vector<index_t>& polyline : line.polylines) {
        text += 'l';
        for (const index_t point : polyline) {
          text += ' ';
          appendNumber (text, points.place (point) + 1);
        }
        text += '\n';
      }
    }
  }
  return text;
}

/** \brief A number that each line has. */
struct Measure {
  const char* name;
  bool whole;
  double (*of) (const CrestLine& line);
};

/** \brief What files tell of lines beside type, place and ends. */
constexpr std::array<Measure, 8> MEASURES{
    {{"size", true, [] (const CrestLine& l) { return static_cast<double> (l.size); }},
     {"closed", true, [] (const CrestLine& l) { return l.closed ? 1.0 : 0.0; }},
     {"length", false, [] (const CrestLine& l) { return l.length; }},
     {"strength", false, [] (const CrestLine& l) { return l.strength; }},
     {"mean_curvature", false, [] (const CrestLine& l) { return l.mean_curvature; }},
     {"turning_angle", false, [] (const CrestLine& l) { return l.turning_angle; }},
     {"scale", false, [] (const CrestLine& l) { return l.scale; }},
     {"sign_trust", false, [] (const CrestLine& l) { return l.sign_trust; }}}};

/** \brief A space, then a measure of a line. */
void
appendMeasure (std::string& text, const Measure& measure, const CrestLine& line)
{
  text += ' ';
  if (measure.whole)
    appendNumber (text, static_cast<std::size_t> (measure.of (line)));
  else
    appendNumber (text, measure.of (line));
}

std::string
toPly (const LinePoints& points, const std::vector<CrestLine>& lines)
{
  std::string edges;
  std::string polylines;
  std::string measures;
  std::size_t polyline_count = 0;
  std::size_t edge_count = 0;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const CrestLine& line = lines[i];
    for (std::size_t p = 0; p < line.polylines.size(); ++p) {
      const std::vector<index_t>& polyline = line.polylines[p];
      for (std::size_t j = 1; j < polyline.size(); ++j) {
        appendNumber (edges, points.place (polyline[j - 1]));
        edges += ' ';
        appendNumber (edges, points.place (polyline[j]));
        edges += ' ';
        appendNumber (edges, static_cast<int> (line.type));
        edges += ' ';
        appendNumber (edges, i);
        edges += ' ';
        appendNumber (edges, polyline_count);
        edges += '\n';
        ++edge_count;
      }
      appendNumber (polylines, i);
      for (const LineEnd end : line.ends[p]) {
        polylines += ' ';
        appendNumber (polylines, static_cast<int> (end));
      }
      polylines += '\n';
      ++polyline_count;
    }
    appendNumber (measures, static_cast<int> (line.type));
    for (const Measure& measure : MEASURES)
      appendMeasure (measures, measure, line);
    measures += '\n';
  }
  std::string text = "ply\nformat ascii 1.0\ncomment type 1 is a ridge, 2 a valley\n"
                     "comment ends: 0 free, 1 junction, 2 boundary, 3 closed\n"
                     "element vertex " +
                     std::to_string (points.size()) + "\nproperty " + points.type() +
                     " x\nproperty " + points.type() + " y\nproperty " + points.type() +
                     " z\n"
                     "element edge " +
                     std::to_string (edge_count) +
                     "\nproperty int vertex1\nproperty int vertex2\n"
                     "property uchar type\nproperty int line\nproperty int polyline\n"
                     "element polyline " +
                     std::to_string (polyline_count) +
                     "\nproperty int line\nproperty uchar first_end\n"
                     "property uchar last_end\nelement line " +
                     std::to_string (lines.size()) + "\nproperty uchar type\n";
  for (const Measure& measure : MEASURES)
    text += std::string ("property ") + (measure.whole ? "int " : "double ") +
            measure.name + "\n";
  text += "end_header\n";
  points.append (text, "");
  return text + edges + polylines + measures;
}

std::string
toVtk (const LinePoints& points, const std::vector<CrestLine>& lines)
{
  std::string cells;
  std::string types;
  std::string places;
  std::array<std::string, 2> ends;
  std::array<std::string, MEASURES.size()> measures;
  std::size_t cell_count = 0;
  std::size_t number_count = 0;
  for (std::size_t i = 0; i < lines.size(); ++i)
    for (std::size_t p = 0; p < lines[i].polylines.size(); ++p) {
      const std::vector<index_t>& polyline = lines[i].polylines[p];
      appendNumber (cells, polyline.size());
      for (const index_t point : polyline) {
        cells += ' ';
        appendNumber (cells, points.place (point));
      }
      cells += '\n';
      appendNumber (types, static_cast<int> (lines[i].type));
      types += '\n';
      appendNumber (places, i);
      places += '\n';
      for (std::size_t e = 0; e < ends.size(); ++e) {
        appendNumber (ends[e], static_cast<int> (lines[i].ends[p][e]));
        ends[e] += '\n';
      }
      for (std::size_t m = 0; m < MEASURES.size(); ++m) {
        appendMeasure (measures[m], MEASURES[m], lines[i]);
        measures[m] += '\n';
      }
      ++cell_count;
      number_count += polyline.size() + 1;
    }
  const std::string count = std::to_string (cell_count);
  std::string text = "# vtk DataFile Version 3.0\n"
                     "crest lines: type 1 is a ridge, 2 a valley\n"
                     "ASCII\nDATASET POLYDATA\nPOINTS " +
                     std::to_string (points.size()) + " " + points.type() + "\n";
  points.append (text, "");
  text += "LINES " + count + " " + std::to_string (number_count) + "\n" + cells +
          "CELL_DATA " + count + "\nSCALARS type int 1\nLOOKUP_TABLE default\n" +
          types + "FIELD FieldData " + std::to_string (3 + MEASURES.size()) + "\n";
  const auto add = [&] (const char* name, const char* type, const std::string& values) {
    text += std::string (name) + " 1 " + count + " " + type + "\n" + values;
  };
  add ("line", "int", places);
  add ("first_end", "int", ends[0]);
  add ("last_end", "int", ends[1]);
  for (std::size_t m = 0; m < MEASURES.size(); ++m)
    add (MEASURES[m].name, MEASURES[m].whole ? "int" : "double", measures[m]);
  return text;
}

} // namespace

std::vector<std::string>
lineExtensions ()
{
  return {".obj", ".ply", ".vtk"};
}

bool
writeLines (const std::string& file,
            const pcl::PointCloud<pcl::PointNormal>& cloud,
            const std::vector<CrestLine>& lines,
            std::string& error,
            const Placement& placement)
{
  const LinePoints points (cloud, lines, placement);
  const std::string extension = extensionOf (file);
  if (extension == ".obj")
    return replaceFile (file, toObj (points, lines), error);
  if (extension == ".ply")
    return replaceFile (file, toPly (points, lines), error);
  if (extension == ".vtk")
    return replaceFile (file, toVtk (points, lines), error);
  error = file + ": lines are written as .obj, .ply or .vtk only";
  return false;
}

} // namespace crest
} // namespace pcl
