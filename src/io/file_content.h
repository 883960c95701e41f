// SPDX-License-Identifier: BSD-3-Clause
// What the readers of the file formats have in common.
#pragma once

#include <Eigen/Geometry>

#include "io/file_points.h"
#include "io/text_scanner.h"
#include "meshes/faces.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace pcl {
namespace crest {

/** \brief What a file holds, before its points are placed and its normals seen to. */
struct FileContent {
  /** normals are zero where the file has none */
  FilePoints points;
  bool has_normals = false;
  /** whether the file has the positions as floats, so that more digits are lost */
  bool has_floats = false;
  /** as Placement has them */
  Eigen::Vector3d step = Eigen::Vector3d::Zero();
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  std::vector<Placement::CrsRecord> crs_records;
  std::vector<std::array<unsigned char, 3>> colors;
  /** what else each point has */
  FileFields fields;
  Faces faces;
  /** of points that are organized, how many rows they have */
  std::size_t rows = 1;
  /** where the scanner stood, in formats that tell */
  std::optional<Eigen::Vector3d> viewpoint;
  /** how it stood there, in formats that tell */
  std::optional<Eigen::Quaternionf> orientation;
  std::vector<std::string> notes;
};

/** \brief Throws if there are more points than an index_t tells apart: to be called
 * before room is made for as many, and before their places become indices.
 */
void
checkPointCount (std::size_t points);

/** \brief Throws unless the corners of all faces are points of the file. */
void
checkFaces (const FileContent& content);

// The readers, one for each format, take the whole content of a file and throw
// ReadError where it is not of their format. That of text takes
// ReadOptions::columns, too, and that of LAS ReadOptions::classes.

FileContent
readPcd (const std::string& text);
FileContent
readPly (const std::string& text);
FileContent
readObj (const std::string& text);
FileContent
readOff (const std::string& text);
FileContent
readStl (const std::string& text);
FileContent
readVtk (const std::string& text);
FileContent
readVtp (const std::string& text);
FileContent
readPtx (const std::string& text);
FileContent
readLas (const std::string& text, const std::vector<std::uint8_t>& classes);
FileContent
readXyz (const std::string& text, const std::vector<std::string>& columns);

} // namespace crest
} // namespace pcl
