// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_crest/version.h>

#include "io/las_layout.h"
#include "io/point_file.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace pcl {
namespace crest {

namespace {

/** \brief A number of the points in its place; little-endian. */
template <typename T>
void
put (char* bytes, T number)
{
  copyNumber (reinterpret_cast<const char*> (&number), sizeof (T), false, bytes);
}

/** \brief The steps that coordinates are whole multiples of, and where from. */
struct Grid {
  Eigen::Array3d step;
  Eigen::Array3d origin;
};

/** \brief Whether a point can be told in whole numbers of four bytes. */
bool
fits (const Grid& grid, const Eigen::Vector3d& position)
{
  return ((position.array() - grid.origin) / grid.step).abs().maxCoeff() <=
         std::numeric_limits<std::int32_t>::max();
}

/** \brief The steps of the file that was read, if there were any that reach all points;
 * else decimal ones, as fine as they can be.
 */
Grid
findGrid (const PointFile& file)
{
  Grid grid{file.placement.step, file.placement.origin};
  const Eigen::Array3d offset = file.placement.offset;
  Eigen::Array3d farthest = Eigen::Array3d::Zero();
  bool is_given = (grid.step > 0.0).all();
  FilePositions positions (file.cloud, file.placement);
  for (std::size_t i = 0; i < file.cloud.size(); ++i) {
    const Eigen::Vector3d position = positions (i);
    if (positions.isApart() || !position.allFinite())
      continue;
    farthest = farthest.max ((position.array() - offset).abs());
    is_given = is_given && fits (grid, position);
  }
  if (is_given)
    return grid;
  constexpr double MOST = std::numeric_limits<std::int32_t>::max();
  for (int axis = 0; axis < 3; ++axis)
    grid.step[axis] =
        farthest[axis] > 0.0
            ? std::pow (10.0, std::ceil (std::log10 (farthest[axis] / MOST)))
            : 0.001;
  grid.origin = offset;
  return grid;
}

/** \brief The bytes of a LAS file, made in the order in which they stand. */
class LasText {
public:
  explicit LasText (const PointFile& file) : file_ (file), grid_ (findGrid (file))
  {
    if (file.fields != nullptr)
      columns_ = singleColumns (passingColumns (file, false));
    const auto has = [this] (const char* name) {
      return std::any_of (columns_.begin(), columns_.end(), [&] (const auto& column) {
        return column.name == name && column.type == NumberType::UINT16;
      });
    };
    has_channels_ = has ("red") && has ("green") && has ("blue");
    format_ = has ("nir") ? 8 : has_channels_ || file.colors != nullptr ? 7 : 6;
    for (const las::Dimension& dimension : las::dimensionsOf (format_)) {
      const auto column =
          std::find_if (columns_.begin(), columns_.end(), [&] (const auto& c) {
            return c.name == dimension.name && c.type == dimension.type;
          });
      if (column == columns_.end())
        continue;
      filled_.push_back ({dimension, *column});
      columns_.erase (column);
    }
    std::vector<PointColumn> own =
        normalColumns (file.cloud, {"normal_x", "normal_y", "normal_z"});
    own.insert (own.end(), file.columns.begin(), file.columns.end());
    columns_.insert (columns_.begin(), own.begin(), own.end());
    point_size_ = las::POINT_SIZES[format_];
    for (const PointColumn& column : columns_)
      point_size_ += sizeOf (column.type);
  }

  /** \brief Why these points fit into no LAS file; empty if they do. */
  std::string
  explainUnfit () const
  {
    constexpr std::size_t MOST = std::numeric_limits<std::uint16_t>::max();
    constexpr std::size_t MOST_NUMBERS = MOST / las::EXTRA_SIZE;
    if (columns_.size() > MOST_NUMBERS || point_size_ > MOST)
      return "each point has " + std::to_string (columns_.size()) +
             " numbers beside those of LAS, and " + std::to_string (point_size_) +
             " bytes, but LAS files have at most " + std::to_string (MOST_NUMBERS) +
             " and " + std::to_string (MOST) + ": write .pcd or .ply";
    return {};
  }

  std::string
  take ()
  {
    constexpr std::size_t HEADER_SIZE = las::HEADER_SIZES.back();
    std::size_t first_point =
        HEADER_SIZE + las::DATA + columns_.size() * las::EXTRA_SIZE;
    const std::size_t first_crs = first_point;
    for (const Placement::CrsRecord& record : file_.placement.crs_records)
      first_point += las::DATA + record.data.size();
    text_.resize (first_point + file_.cloud.size() * point_size_);
    putExtraBytes (HEADER_SIZE);
    putCrs (first_crs);
    FilePositions positions (file_.cloud, file_.placement);
    for (std::size_t i = 0; i < file_.cloud.size(); ++i) {
      const Eigen::Vector3d position = positions (i);
      putPoint (text_.data() + first_point + i * point_size_,
                i,
                position,
                !positions.isApart() && position.allFinite());
    }
    putHeader (first_point);
    return std::move (text_);
  }

private:
  void
  putExtraBytes (std::size_t place)
  {
    char* record = text_.data() + place;
    std::strcpy (record + las::USER, las::SPECIFICATION);
    put<std::uint16_t> (record + las::RECORD_ID, las::EXTRA_BYTES);
    put (record + las::DATA_SIZE,
         static_cast<std::uint16_t> (columns_.size() * las::EXTRA_SIZE));
    record += las::DATA;
    for (const PointColumn& column : columns_) {
      const auto* const type =
          std::find (las::EXTRA_TYPES.begin(), las::EXTRA_TYPES.end(), column.type);
      put (record + las::EXTRA_TYPE,
           static_cast<std::uint8_t> (1 + (type - las::EXTRA_TYPES.begin())));
      column.name.copy (record + las::EXTRA_NAME, las::EXTRA_NAME_SIZE);
      record += las::EXTRA_SIZE;
    }
  }

  void
  putCrs (std::size_t place)
  {
    char* record = text_.data() + place;
    for (const Placement::CrsRecord& crs : file_.placement.crs_records) {
      std::strcpy (record + las::USER, las::PROJECTION);
      put (record + las::RECORD_ID, crs.id);
      put (record + las::DATA_SIZE, static_cast<std::uint16_t> (crs.data.size()));
      crs.description.copy (record + las::DESCRIPTION, las::DESCRIPTION_SIZE);
      crs.data.copy (record + las::DATA, crs.data.size());
      record += las::DATA + crs.data.size();
    }
  }

  void
  putPoint (char* point,
            std::size_t i,
            const Eigen::Vector3d& position,
            bool has_position)
  {
    // There are no points without a position: these are withheld.
    constexpr unsigned char WITHHELD = 4;
    constexpr std::size_t RETURNS = 14;
    constexpr std::size_t FLAGS = 15;
    constexpr unsigned char ONLY_RETURN = 0x11;
    point[RETURNS] = ONLY_RETURN;
    for (const Filled& filled : filled_)
      putDimension (point, filled.dimension, filled.column.at (i));
    if (file_.colors != nullptr && !has_channels_)
      for (std::size_t c = 0; c < 3; ++c)
        put (point + COLORS + 2 * c,
             static_cast<std::uint16_t> (257 * (*file_.colors)[i][c]));
    if (!has_position)
      point[FLAGS] = static_cast<char> (point[FLAGS] | WITHHELD);
    for (int axis = 0; axis < 3; ++axis) {
      const double steps = (position[axis] - grid_.origin[axis]) / grid_.step[axis];
      const auto whole =
          has_position ? static_cast<std::int32_t> (std::round (steps)) : 0;
      put (point + sizeof (whole) * static_cast<std::size_t> (axis), whole);
      const double place = grid_.step[axis] * whole + grid_.origin[axis];
      least_[axis] = std::min (least_[axis], place);
      most_[axis] = std::max (most_[axis], place);
    }
    const auto return_number = static_cast<unsigned char> (point[RETURNS]) & 0xFU;
    if (return_number != 0)
      ++by_return_[return_number - 1];
    char* extra = point + las::POINT_SIZES[format_];
    for (const PointColumn& column : columns_) {
      const std::size_t size = sizeOf (column.type);
      copyNumber (column.at (i), size, false, extra);
      extra += size;
    }
  }

  void
  putDimension (char* point, const las::Dimension& dimension, const char* number)
  {
    char* const to = point + dimension.byte;
    const double value = decode (number, dimension.type, HOST_IS_BIG_ENDIAN);
    if (dimension.mask != 0) {
      const unsigned room = dimension.mask << dimension.shift;
      const unsigned bits = static_cast<unsigned> (value) << dimension.shift;
      *to = static_cast<char> ((static_cast<unsigned char> (*to) & ~room) |
                               (bits & room));
    }
    else if (dimension.type == NumberType::FLOAT32)
      put (to, wholeAngle (value));
    else if (dimension.type == NumberType::FLOAT64) {
      put (to, value);
      has_large_times_ = has_large_times_ || value < 0.0 || value >= WEEK;
    }
    else if (dimension.type == NumberType::UINT16)
      put (to, static_cast<std::uint16_t> (value));
    else
      put (to, static_cast<std::uint8_t> (value));
  }

  /** \brief A scan angle in its unit; 0 for what no scan angle can be. */
  static std::int16_t
  wholeAngle (double degrees)
  {
    constexpr double MOST = std::numeric_limits<std::int16_t>::max();
    const double angle = std::round (degrees / las::WIDE_ANGLE);
    return std::abs (angle) <= MOST ? static_cast<std::int16_t> (angle)
                                    : std::int16_t (0);
  }

  void
  putHeader (std::size_t first_point)
  {
    char* const header = text_.data();
    const std::uint64_t points = file_.cloud.size();
    std::strcpy (header, "LASF");
    // Time within a week is below its seconds; else it counts from 2011, nearly.
    constexpr unsigned STANDARD_TIME = 1;
    constexpr unsigned WKT = 16;
    // The bit says which kind of records counts. Points of these formats should have
    // WKT, but what the file has in GeoTIFF's keys is told by them or not at all.
    const std::vector<Placement::CrsRecord>& crs = file_.placement.crs_records;
    const bool has_wkt =
        crs.empty() || std::any_of (crs.begin(), crs.end(), [] (const auto& record) {
          return las::isWkt (record.id);
        });
    put (header + las::GLOBAL_ENCODING,
         static_cast<std::uint16_t> ((has_wkt ? WKT : 0) |
                                     (has_large_times_ ? STANDARD_TIME : 0)));
    put<std::uint8_t> (header + las::VERSION_MAJOR, 1);
    put<std::uint8_t> (header + las::VERSION_MINOR, 4);
    std::strcpy (header + las::SYSTEM, "OTHER");
    const std::string software = std::string ("pcl_crest ") + version();
    std::strcpy (header + las::SOFTWARE, software.c_str());
    put (header + las::HEADER_SIZE,
         static_cast<std::uint16_t> (las::HEADER_SIZES.back()));
    put (header + las::FIRST_POINT, static_cast<std::uint32_t> (first_point));
    put (header + las::RECORDS, static_cast<std::uint32_t> (1 + crs.size()));
    put (header + las::POINT_FORMAT, static_cast<std::uint8_t> (format_));
    put (header + las::POINT_SIZE, static_cast<std::uint16_t> (point_size_));
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto place = static_cast<Eigen::Index> (axis);
      put (header + las::SCALES + 8 * axis, grid_.step[place]);
      put (header + las::OFFSETS + 8 * axis, grid_.origin[place]);
      put (header + las::EXTENT + 16 * axis, most_[place]);
      put (header + las::EXTENT + 16 * axis + 8, least_[place]);
    }
    put (header + las::POINTS, points);
    for (std::size_t i = 0; i < by_return_.size(); ++i)
      put (header + las::POINTS_BY_RETURN + 8 * i, by_return_[i]);
  }

  /** \brief A number of the point format that the file that was read has, too. */
  struct Filled {
    las::Dimension dimension;
    PointColumn column;
  };

  /** of the formats 7 and 8 */
  static constexpr std::size_t COLORS = 30;
  static constexpr double WEEK = 7.0 * 24.0 * 3600.0;

  const PointFile& file_;
  Grid grid_;
  unsigned format_ = 0;
  bool has_channels_ = false;
  std::vector<Filled> filled_;
  /** those that become extra bytes */
  std::vector<PointColumn> columns_;
  std::size_t point_size_ = 0;
  bool has_large_times_ = false;
  Eigen::Array3d least_ =
      Eigen::Array3d::Constant (std::numeric_limits<double>::infinity());
  Eigen::Array3d most_ = -least_;
  std::array<std::uint64_t, 15> by_return_{};
  std::string text_;
};

} // namespace

std::string
toLas (const PointFile& file, std::string& error)
{
  LasText las (file);
  const std::string unfit = las.explainUnfit();
  if (unfit.empty())
    return las.take();
  error = unfit;
  return {};
}

} // namespace crest
} // namespace pcl
