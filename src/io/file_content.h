// SPDX-License-Identifier: BSD-3-Clause
// What the readers of the file formats have in common.
#pragma once

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <Eigen/Core>

#include "io/text_scanner.h"
#include "normals/face_normals.h"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace pcl {
namespace crest {

/** \brief What a file holds, before its normals are seen to. */
struct FileContent {
  FileContent() : points (new pcl::PointCloud<pcl::PointNormal>) {}

  /** normals are zero where the file has none */
  pcl::PointCloud<pcl::PointNormal>::Ptr points;
  bool has_normals = false;
  std::vector<std::array<unsigned char, 3>> colors;
  Faces faces;
  /** where the scanner stood, in formats that tell */
  std::optional<Eigen::Vector3f> viewpoint;
  std::vector<std::string> notes;
};

/** \brief A point of the numbers of a file: three, or six with normals. */
inline pcl::PointNormal
makePoint (const double* values, bool with_normal)
{
  pcl::PointNormal point;
  point.x = static_cast<float> (values[0]);
  point.y = static_cast<float> (values[1]);
  point.z = static_cast<float> (values[2]);
  if (with_normal) {
    point.normal_x = static_cast<float> (values[3]);
    point.normal_y = static_cast<float> (values[4]);
    point.normal_z = static_cast<float> (values[5]);
  }
  return point;
}

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
// ReadOptions::columns, too.

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
readPtx (const std::string& text);
FileContent
readXyz (const std::string& text, const std::vector<std::string>& columns);

} // namespace crest
} // namespace pcl
