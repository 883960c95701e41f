// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <string>
#include <vector>

namespace pcl {
namespace crest {

/** \brief Where the normals of a cloud come from. */
enum class NormalSource { FILE, FACES, ESTIMATED };

/** \brief A cloud as read from a file, ready for the crest line estimation. */
struct InputCloud {
  /** one point per point of the file, in its order; is_dense is honest */
  pcl::PointCloud<pcl::PointNormal>::Ptr points;
  NormalSource normals = NormalSource::FILE;
  /** what the user should know: what was done, what looks odd; one sentence each */
  std::vector<std::string> notes;
};

/** \brief Reads a cloud and sees to its normals: from the file, else from the faces,
 * else estimated from k neighbours and made consistent over the cloud.
 *
 * By the extension of the name: PCD, PLY, OBJ, OFF, STL, VTK (legacy polydata), XYZ or
 * TXT (three numbers a line, or six with normals).
 *
 * \param[in] file the path
 * \param[in] k neighbours for the estimation of normals, where it is needed
 * \param[in] threads 0 for all processors
 * \param[out] cloud what was read; untouched on failure
 * \param[out] error on failure what is wrong, naming the file and what would be right
 * \return whether the cloud was read
 */
bool
readCloud (const std::string& file,
           int k,
           unsigned threads,
           InputCloud& cloud,
           std::string& error);

} // namespace crest
} // namespace pcl
