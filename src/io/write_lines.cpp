// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_crest/io/output_file.h>
#include <pcl_crest/io/write_lines.h>

#include "format_number.h"

#include <algorithm>

namespace pcl {
namespace crest {

namespace {

/** \brief The points on lines, and their places in the file. */
class LinePoints {
public:
  LinePoints (const pcl::PointCloud<pcl::PointNormal>& cloud,
              const std::vector<CrestLine>& lines)
  : cloud_ (cloud)
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

  /** \brief Appends a line of coordinates for each point. */
  void
  append (std::string& text, const char* prefix) const
  {
    for (const index_t i : used_) {
      text += prefix;
      appendNumber (text, cloud_[i].x);
      text += ' ';
      appendNumber (text, cloud_[i].y);
      text += ' ';
      appendNumber (text, cloud_[i].z);
      text += '\n';
    }
  }

private:
  const pcl::PointCloud<pcl::PointNormal>& cloud_;
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

std::string
toPly (const LinePoints& points, const std::vector<CrestLine>& lines)
{
  std::string edges;
  std::size_t edge_count = 0;
  for (std::size_t i = 0; i < lines.size(); ++i)
    for (const std::vector<index_t>& polyline : lines[i].polylines)
      for (std::size_t j = 1; j < polyline.size(); ++j) {
        appendNumber (edges, points.place (polyline[j - 1]));
        edges += ' ';
        appendNumber (edges, points.place (polyline[j]));
        edges += ' ';
        appendNumber (edges, static_cast<int> (lines[i].type));
        edges += ' ';
        appendNumber (edges, i);
        edges += '\n';
        ++edge_count;
      }
  std::string text = "ply\nformat ascii 1.0\ncomment type 1 is a ridge, 2 a valley\n"
                     "element vertex " +
                     std::to_string (points.size()) +
                     "\nproperty float x\nproperty float y\nproperty float z\n"
                     "element edge " +
                     std::to_string (edge_count) +
                     "\nproperty int vertex1\nproperty int vertex2\n"
                     "property uchar type\nproperty int line\nend_header\n";
  points.append (text, "");
  return text + edges;
}

std::string
toVtk (const LinePoints& points, const std::vector<CrestLine>& lines)
{
  std::string cells;
  std::string types;
  std::string places;
  std::size_t cell_count = 0;
  std::size_t number_count = 0;
  for (std::size_t i = 0; i < lines.size(); ++i)
    for (const std::vector<index_t>& polyline : lines[i].polylines) {
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
      ++cell_count;
      number_count += polyline.size() + 1;
    }
  const std::string count = std::to_string (cell_count);
  std::string text = "# vtk DataFile Version 3.0\n"
                     "crest lines: type 1 is a ridge, 2 a valley\n"
                     "ASCII\nDATASET POLYDATA\nPOINTS " +
                     std::to_string (points.size()) + " float\n";
  points.append (text, "");
  return text + "LINES " + count + " " + std::to_string (number_count) + "\n" + cells +
         "CELL_DATA " + count + "\nSCALARS type int 1\nLOOKUP_TABLE default\n" + types +
         "FIELD FieldData 1\nline 1 " + count + " int\n" + places;
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
            std::string& error)
{
  const LinePoints points (cloud, lines);
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
