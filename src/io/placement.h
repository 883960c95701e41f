// SPDX-License-Identifier: BSD-3-Clause
// Points of files, in doubles, as clouds of floats near the origin.
#pragma once

#include <pcl_crest/io/read_cloud.h>

#include "io/file_content.h"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace pcl {
namespace crest {

/** \brief What a file holds, as a cloud near the origin. */
struct PlacedContent {
  /** normals are zero where the file has none */
  pcl::PointCloud<pcl::PointNormal>::Ptr points;
  Placement placement;
  bool has_normals = false;
  std::vector<std::array<unsigned char, 3>> colors;
  FileFields fields;
  Faces faces;
  /** as the file has it */
  std::optional<Eigen::Vector3d> viewpoint;
  std::vector<std::string> notes;
};

/** \brief The positions of points. */
inline PointView
viewOf (const pcl::PointCloud<pcl::PointNormal>& points)
{
  return {&points.points.data()->x,
          nullptr,
          sizeof (pcl::PointNormal) / sizeof (float),
          points.size()};
}

/** \brief Makes a cloud of the points of a file, and notes what was done for it. */
PlacedContent
placeContent (FileContent content);

/** \brief Whether places in the file take doubles to write them. */
inline bool
needsDoubles (const Placement& placement)
{
  return !placement.offset.isZero (0.0);
}

/** \brief Appends the coordinates that a place of the cloud has in the file, in as few
 * digits as tell it: those of floats along axes that have no offset.
 */
void
appendPlace (std::string& text,
             const Eigen::Vector3f& place,
             const Placement& placement);

} // namespace crest
} // namespace pcl
