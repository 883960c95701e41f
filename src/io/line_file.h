// SPDX-License-Identifier: BSD-3-Clause
// Lines as they are written: their points, and what each is known by. What the writers
// of the line formats have in common.
#pragma once

#include <pcl_crest/crest_line.h>
#include <pcl_crest/io/read_cloud.h>

#include "io/crest_colors.h"
#include "io/format_number.h"

#include <array>
#include <string>
#include <vector>

namespace pcl {
namespace crest {

/** \brief The points on lines, and their places in the file. */
class LinePoints {
public:
  LinePoints (const pcl::PointCloud<pcl::PointNormal>& cloud,
              const std::vector<CrestLine>& lines,
              const Placement& placement,
              std::string crs);

  std::size_t
  size () const
  {
    return used_.size();
  }

  /** \brief The place of a point of the cloud in the file, from 0. */
  std::size_t
  place (index_t point) const;

  bool
  hasDoubles () const;

  /** \brief Where a point of the cloud is in the file. */
  Eigen::Vector3d
  position (index_t point) const;

  /** \brief The coordinate system, as "EPSG:25832"; empty if it is not known. */
  const std::string&
  crs () const
  {
    return crs_;
  }

  /** \brief Appends the coordinates of a point of the cloud, parted by blanks. */
  void
  appendPoint (std::string& text, index_t point) const;

  /** \brief Appends a line for each point: its coordinates, and what follows them.
   * \param[in] behind of a color what follows; nothing if null
   */
  void
  append (std::string& text,
          const char* prefix,
          std::string (*behind) (const Rgb& color) = nullptr) const;

  /** \brief The color of each point: that of the first line through it. */
  const std::vector<Rgb>&
  colors () const
  {
    return colors_;
  }

private:
  const pcl::PointCloud<pcl::PointNormal>& cloud_;
  const Placement& placement_;
  std::string crs_;
  /** ascending */
  std::vector<index_t> used_;
  std::vector<Rgb> colors_;
};

/** \brief A number that each line has. */
struct Measure {
  const char* name;
  /** at most 10 letters, which is what the tables of shapefiles have room for */
  const char* short_name;
  bool whole;
  double (*of) (const CrestLine& line);
};

/** \brief What files tell of lines beside type, place and ends. */
constexpr std::array<Measure, 8> MEASURES{
    {{"size",
      "size",
      true,
      [] (const CrestLine& l) { return static_cast<double> (l.size); }},
     {"closed",
      "closed",
      true,
      [] (const CrestLine& l) { return l.closed ? 1.0 : 0.0; }},
     {"length", "length", false, [] (const CrestLine& l) { return l.length; }},
     {"strength", "strength", false, [] (const CrestLine& l) { return l.strength; }},
     {"mean_curvature",
      "mean_curv",
      false,
      [] (const CrestLine& l) { return l.mean_curvature; }},
     {"turning_angle",
      "turn_angle",
      false,
      [] (const CrestLine& l) { return l.turning_angle; }},
     {"scale", "scale", false, [] (const CrestLine& l) { return l.scale; }},
     {"sign_trust", "sign_trust", false, [] (const CrestLine& l) {
        return l.sign_trust;
      }}}};

/** \brief Appends a measure of a line. */
inline void
appendMeasure (std::string& text, const Measure& measure, const CrestLine& line)
{
  if (measure.whole)
    appendNumber (text, static_cast<std::size_t> (measure.of (line)));
  else
    appendNumber (text, measure.of (line));
}

/** \brief "ridge" or "valley". */
constexpr const char*
nameOf (CrestType type)
{
  return type == CrestType::RIDGE ? "ridge" : "valley";
}

/** \brief Red, green and blue, parted by blanks. */
std::string
colorText (const Rgb& color);

/** \brief An array of the points or of the cells of a VTK file, as text. */
struct VtkArray {
  std::string name;
  std::size_t components = 1;
  /** whether its numbers are bytes, whole or of eight bytes */
  enum class Kind { BYTES, WHOLE, REAL } kind = Kind::WHOLE;
  /** a line for each point or cell */
  std::string values;
};

/** \brief Polylines as the cells of VTK files. */
struct VtkCells {
  std::size_t count = 0;
  /** each with the places of its points */
  std::vector<std::vector<std::size_t>> points;
  /** the colors RGB first */
  std::vector<VtkArray> arrays;
  /** the colors of the points */
  VtkArray point_colors;
};

VtkCells
vtkCells (const LinePoints& points, const std::vector<CrestLine>& lines);

// The writers give the whole content of a file.

/** \param[in] materials the name of the file with what toMtl gives */
std::string
toObj (const LinePoints& points,
       const std::vector<CrestLine>& lines,
       const std::string& materials);
/** \brief The materials of OBJ files. */
std::string
toMtl ();
std::string
toPly (const LinePoints& points, const std::vector<CrestLine>& lines);
std::string
toVtk (const LinePoints& points, const std::vector<CrestLine>& lines);
std::string
toVtp (const LinePoints& points, const std::vector<CrestLine>& lines);
std::string
toDxf (const LinePoints& points, const std::vector<CrestLine>& lines);
std::string
toGeoJson (const LinePoints& points, const std::vector<CrestLine>& lines);
std::string
toCsv (const LinePoints& points, const std::vector<CrestLine>& lines);

} // namespace crest
} // namespace pcl
