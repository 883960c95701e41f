// SPDX-License-Identifier: BSD-3-Clause
// The component io: clouds from files, labels, curvatures, lines and statistics into
// files. Each format has a reader of its own; nothing is written in part. It knows the
// clouds of PCL, the lines and the normals, but none of the stages.
#pragma once

#include <pcl_crest/normal_estimation.h>
#include <pcl_crest/progress.h>
#include <pcl_crest/types.h>

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <Eigen/Core>

#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace pcl {
namespace crest {

/** \brief Where a cloud of floats lies in the coordinates of a file, which are doubles.
 *
 * Coordinates as those of maps have more digits than a float, so that the points of a
 * cloud are what is left of them when one offset is taken off. Points that are no part
 * of the surface, because they are far from all others or stand for no data, are set
 * apart: in the cloud they are not finite, so that they shift nothing and get
 * LABEL_INVALID.
 */
struct Placement {
  /** \brief A point that was set apart, as it is in the file. */
  struct PointApart {
    index_t index;
    Eigen::Vector3d position;
  };

  /** \brief A record of a LAS file that tells its coordinate system, as GeoTIFF has it
   * (34735 to 34737) or as WKT (2111 and 2112).
   */
  struct CrsRecord {
    std::uint16_t id = 0;
    std::string description;
    std::string data;
  };

  /** what was taken off: whole numbers, near the middle of the cloud; 0 along axes
   * where floats tell the points apart as well without */
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();
  /** ascending by their indices */
  std::vector<PointApart> apart;
  /** how many of these have a number that stands for no data */
  std::size_t no_data = 0;
  /** of files whose coordinates are whole numbers of steps away from an origin, as
   * those of LAS, these; else 0 */
  Eigen::Vector3d step = Eigen::Vector3d::Zero();
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  /** of LAS, as they are in the file */
  std::vector<CrsRecord> crs_records;

  /** \brief Where a place of the cloud is in the file. */
  Eigen::Vector3d
  toFile (const Eigen::Vector3f& place) const
  {
    return place.cast<double>() + offset;
  }

  /** \brief Where a point of the cloud is in the file: as toFile, but exactly on the
   * steps.
   */
  Eigen::Vector3d
  pointToFile (const Eigen::Vector3f& point) const
  {
    Eigen::Vector3d place = toFile (point);
    for (int axis = 0; axis < 3; ++axis)
      if (step[axis] != 0.0)
        place[axis] =
            step[axis] * std::round ((place[axis] - origin[axis]) / step[axis]) +
            origin[axis];
    return place;
  }

  /** \brief Where a place of the file is in the cloud. */
  Eigen::Vector3f
  toCloud (const Eigen::Vector3d& place) const
  {
    return (place - offset).cast<float>();
  }
};

/** \brief Sets the positions of a cloud from doubles, as readCloud does.
 *
 * Points are set apart that have a number by which programs stand for no data (-9999,
 * -99999, -32767, -32768, 1e20, or 3.4e38 and more of either sign) along an axis on
 * which the others are ten times their width away from it; and those that are a
 * thousand times the width of the cloud away from the bulk of it.
 *
 * \code
 * const crest::Placement placement = crest::placePoints (positions, *cloud);
 * estimation.setInputCloud (cloud);
 * estimation.compute (labels);
 * crest::writeLines ("lines.ply", *estimation.getLineCloud(), estimation.getLines(),
 *                    error, placement);
 * \endcode
 *
 * \param[in] positions in the order of the points
 * \param[in,out] points one for each position, which keep all but where they are; a
 * cloud of another size is resized; is_dense tells whether all positions are finite
 * \return where the points lie, for the writers
 */
PCL_CREST_EXPORT Placement
placePoints (const std::vector<Eigen::Vector3d>& positions,
             pcl::PointCloud<pcl::PointNormal>& points);

/** \brief What a file has of its points beside positions and normals, colors among it:
 * it passes through to the labelled points (see writeLabels).
 */
struct FileFields {
  /** \brief A number of each point, or several of one type. */
  struct Field {
    /** that of the file, but with "input_" before it where labelled points have their
     * own of this name */
    std::string name;
    /** as in PCD files: I for whole numbers, U for those that are not negative, F */
    char type = 'F';
    /** bytes of a number: 1, 2, 4 or 8 */
    std::size_t size = 4;
    /** numbers of a point */
    std::size_t count = 1;
    /** bytes of a record before it */
    std::size_t offset = 0;
  };

  std::vector<Field> fields;
  /** bytes of a point */
  std::size_t record_size = 0;
  /** those of all points in their order, in the machine's byte order */
  std::vector<char> records;
};

/** \brief Where the normals of a cloud come from. */
enum class NormalSource { FILE, FACES, ESTIMATED };

/** \brief Where normals are to come from. */
struct NormalOptions {
  /** whether to estimate them even where the file has some, or faces */
  bool always_estimate = false;
  /** for those that are estimated, in the coordinates of the file; in the place of the
   * viewpoint of a PCD file */
  std::optional<Eigen::Vector3d> viewpoint;
  /** for those that are estimated (see NormalHints) */
  std::optional<Eigen::Vector3f> up;
};

/** \brief How a file is to be read. */
struct ReadOptions {
  /** one of readFormats, whatever the name of the file says; empty: by that name */
  std::string format;
  /** of text, what its columns are, from the first to the last: x y z nx ny nz r g b
   * intensity, each once at most, or - for any that is to be passed over; empty: told
   * by a line of names, else by the values */
  std::vector<std::string> columns;
  /** of LAS, which classes of points are read, as 2 for ground; empty: all */
  std::vector<std::uint8_t> classes;
  NormalOptions normals;
  /** whether faces are sampled where their vertices tell too little of them */
  bool samples_faces = true;
  /** between samples of faces, in the unit of the file; where it is above 0 all faces
   * are sampled, whatever their vertices tell */
  double sample_spacing = 0.0;
};

/** \brief What was sampled in the place of vertices. */
struct SampledFaces {
  /** triangles; 0 where the points are those of the file */
  std::size_t faces = 0;
  /** the root of the area for each sample, in the unit of the file */
  double spacing = 0.0;
  /** whether the order of corners agreed over all edges as it was in the file, so that
   * no normal can be on the wrong side, however near two sides of a wall are */
  bool sides_agree = false;
};

/** \brief A cloud as read from a file, ready for the crest line estimation. */
struct InputCloud {
  /** one point per point of the file, in its order, or samples of its faces; is_dense
   * is honest */
  pcl::PointCloud<pcl::PointNormal>::Ptr points;
  /** where they, and sensor_origin_, lie in the coordinates of the file */
  Placement placement;
  SampledFaces sampled;
  NormalSource normals = NormalSource::FILE;
  /** what it was read with */
  ReadOptions options;
  /** what is known of normals that were estimated; else null */
  std::shared_ptr<const NormalEstimate> estimate;
  /** of each point red, green and blue up to 255, where a file has them and its points
   * are these; else empty */
  std::vector<std::array<unsigned char, 3>> colors;
  /** of files whose points are these, but for OFF and STL */
  FileFields fields;
  /** what the user should know: what was done, what looks odd; one sentence each */
  std::vector<std::string> notes;
  /** what reading the file and seeing to the normals took */
  std::vector<StageTime> times;
};

/** \brief "file", "faces" or "estimated", as in messages and statistics. */
PCL_CREST_EXPORT std::string
nameOf (NormalSource source);

/** \brief The formats of readCloud by their extensions, in lower case, without a dot.
 */
PCL_CREST_EXPORT std::vector<std::string>
readFormats ();

/** \brief What is wrong with the format or the columns of these; empty if nothing. */
PCL_CREST_EXPORT std::string
explainInvalid (const ReadOptions& options);

/** \brief Reads a cloud and sees to its normals: from the file, else from the faces,
 * else estimated from k neighbours and made consistent over the cloud.
 *
 * By the extension of the name, or options.format: PCD, PLY, OBJ, OFF, STL, PTX, VTK
 * (legacy polydata and unstructured grids), VTP, LAS, or text with a point a line (XYZ,
 * TXT, CSV, ASC, PTS, NEU). Any of them may be packed by gzip, as in "scan.ply.gz".
 * Points are those of the file in its order; STL files list the corners of triangles,
 * of which equal ones become one point.
 *
 * Coordinates are read as doubles. Where floats are too coarse for them, an offset is
 * taken off, and points that cannot be meant are set apart (see placePoints); the notes
 * say so, and the writers put all where it was.
 *
 * Meshes as CAD programs write them have vertices on their edges alone, or much closer
 * to each other along these than the faces are wide. Such faces are sampled evenly, and
 * the samples with the normals of the faces are the cloud; the spacing, which tells the
 * narrowest features as far as a million samples do, is in the notes. Meshes whose
 * vertices are samples of their surface by themselves stay as they are.
 *
 * The columns of text may be parted by blanks, tabs, commas or semicolons, and decimals
 * by commas where that is certain. A line of names tells what the columns are; without
 * one the first three numbers are x y z (after the number of the point, if that counts
 * up), three columns of unit vectors are normals, and three of whole numbers up to 255,
 * or of numbers up to 1, are colors. The notes tell what was found. Text that leaves it
 * in doubt is refused; options.columns tells it then.
 *
 * Faces decide the side of the normals by the order of their corners: a normal looks to
 * where that order is counter-clockwise. A file whose normals are all zero or not
 * finite counts as one without; single ones are left as they are, and mentioned in the
 * notes.
 *
 * Estimated normals have no side of their own, but ridges and valleys swap with it: see
 * estimateNormals for how it is found. Where the file has a viewpoint, as PCD files do,
 * that decides first. The notes tell what did, and what is unsure.
 *
 * \param[in] file the path
 * \param[in] k neighbours for the estimation of normals, where it is needed
 * \param[in] threads 0 for all processors
 * \param[out] cloud what was read; untouched on failure
 * \param[out] error on failure what is wrong, naming the file and what would be right
 * \param[in] options of the format, and where normals are to come from
 * \return whether the cloud was read
 */
PCL_CREST_EXPORT bool
readCloud (const std::string& file,
           int k,
           unsigned threads,
           InputCloud& cloud,
           std::string& error,
           const ReadOptions& options = {});

/** \brief Whether there is a file that can be opened, found out without reading it.
 * \param[in] file the path
 * \param[out] error if not, what is wrong, naming the file
 */
PCL_CREST_EXPORT bool
checkReadable (const std::string& file, std::string& error);

} // namespace crest
} // namespace pcl
