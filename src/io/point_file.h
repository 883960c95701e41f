// SPDX-License-Identifier: BSD-3-Clause
// Points as they are written: positions in the coordinates of the file, and columns of
// whatever else each has. What the writers of the point formats have in common.
#pragma once

#include <pcl_crest/io/read_cloud.h>

#include "io/crest_colors.h"
#include "io/number_type.h"

#include <array>
#include <string>
#include <vector>

namespace pcl {
namespace crest {

/** \brief A number of each point, or several of one type: a view of what is elsewhere.
 */
struct PointColumn {
  std::string name;
  NumberType type = NumberType::NONE;
  std::size_t count = 1;
  /** the first byte of the first point */
  const char* first = nullptr;
  /** bytes from point to point */
  std::size_t stride = 0;

  const char*
  at (std::size_t i) const
  {
    return first + i * stride;
  }
};

/** \brief What the writers take. */
struct PointFile {
  const pcl::PointCloud<pcl::PointNormal>& cloud;
  const Placement& placement;
  /** behind positions and normals, in their order */
  std::vector<PointColumn> columns = {};
  /** from the file that was read, colors as it has them among them */
  const FileFields* fields = nullptr;
  /** of each point; null where there are none */
  const std::vector<Rgb>* colors = nullptr;
  /** for formats that programs show colors of at once, where there are none */
  const pcl::PointCloud<pcl::Label>* labels = nullptr;
};

/** \brief The column of a number that structures of one kind have.
 * \param[in] number of the first of them
 */
template <typename Structure, typename Number>
PointColumn
columnOf (const char* name, const Number* number, NumberType type)
{
  return {name, type, 1, reinterpret_cast<const char*> (number), sizeof (Structure)};
}

/** \brief The normals of a cloud that is not empty. */
std::vector<PointColumn>
normalColumns (const pcl::PointCloud<pcl::PointNormal>& cloud,
               const std::array<const char*, 3>& names);

/** \brief The fields of the file that was read.
 * \param[in] keeps_packed whether a color in one number stays as it is
 * \param[in] file where it has colors, fields that hold the same are left out, but for
 * alpha
 */
std::vector<PointColumn>
passingColumns (const PointFile& file, bool keeps_packed);

/** \brief Whether a column is a color in one number, as PCL has them. */
bool
isPackedColor (const PointColumn& column);

/** \brief Columns of several numbers as one of each, NAME_0, NAME_1 and so on. */
std::vector<PointColumn>
singleColumns (const std::vector<PointColumn>& columns);

/** \brief Where points are in the file, one after the other. */
class FilePositions {
public:
  FilePositions (const pcl::PointCloud<pcl::PointNormal>& cloud,
                 const Placement& placement)
  : cloud_ (cloud), placement_ (placement), next_apart_ (placement.apart.begin())
  {}

  /** \brief To be called for one point after the other, from the first on. */
  Eigen::Vector3d
  operator() (std::size_t i);

  /** \brief Whether the point of the last call is set apart. */
  bool
  isApart () const
  {
    return is_apart_;
  }

private:
  const pcl::PointCloud<pcl::PointNormal>& cloud_;
  const Placement& placement_;
  std::vector<Placement::PointApart>::const_iterator next_apart_;
  bool is_apart_ = false;
};

// The writers give the whole content of a file.

/** \brief Binary PCD. pcl::PCDWriter writes a file in place, where it stays in part if
 * the disk is full.
 */
std::string
toPcd (const PointFile& file);

/** \brief Binary PLY, little-endian. */
std::string
toPly (const PointFile& file);

/** \brief LAS 1.4 with the point format 6, 7 or 8.
 * \param[out] error where a LAS file cannot hold the points, what is wrong; else as it
 * was
 */
std::string
toLas (const PointFile& file, std::string& error);

} // namespace crest
} // namespace pcl
