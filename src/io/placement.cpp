// SPDX-License-Identifier: BSD-3-Clause
#include "io/placement.h"

#include <pcl/common/point_tests.h>

#include <Eigen/Geometry>

#include "base/quantile.h"
#include "io/format_number.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace pcl {
namespace crest {

namespace {

/** In widths of the others along an axis: nearer numbers may be coordinates. */
constexpr double FAR_FOR_NO_DATA = 10.0;
/** In widths of the bulk: farther away there is no surface that belongs to it. */
constexpr double FAR_FOR_A_POINT = 1e3;

/** \brief Whether programs stand for no data by this number: GDAL and makers of terrain
 * models by whole ones, ArcGIS and the like by the least or largest float.
 */
bool
standsForNoData (double x)
{
  constexpr std::array<double, 4> WHOLE{-9999.0, -99999.0, -32767.0, -32768.0};
  constexpr double ROUND = 1e20;
  constexpr double LARGEST = 3.4e38;
  constexpr double LEAST = 9999.0;
  if (std::abs (x) < LEAST)
    return false;
  // As a float or as a double.
  return std::abs (x / ROUND - 1.0) < 1e-7 || std::abs (x) >= LARGEST ||
         std::find (WHOLE.begin(), WHOLE.end(), x) != WHOLE.end();
}

/** \brief Where the bulk of the points lies along each axis. */
struct Bulk {
  Eigen::Array3d min = Eigen::Array3d::Zero();
  Eigen::Array3d max = Eigen::Array3d::Zero();
  /** coordinates that it was found from */
  std::array<std::size_t, 3> counts{};

  double
  width () const
  {
    return (max - min).maxCoeff();
  }
};

/** \brief The intervals of the coordinates that a condition takes. */
template <typename Points, typename Take>
Bulk
findRange (const Points& positions, const Take& take)
{
  Bulk range;
  for (std::size_t i = 0; i < positions.size(); ++i)
    for (int axis = 0; axis < 3; ++axis)
      if (take (i, axis)) {
        const double x = positions[i][axis];
        const bool first = range.counts[axis]++ == 0;
        range.min[axis] = first ? x : std::min (range.min[axis], x);
        range.max[axis] = first ? x : std::max (range.max[axis], x);
      }
  return range;
}

/** \brief Whether a twentieth of the points and more are in the first third of their
 * interval along an axis, and in the last: then none of them is astray.
 */
template <typename Points, typename Take>
bool
fillRange (const Points& positions, int axis, const Take& take, const Bulk& bulk)
{
  const double third = (bulk.max[axis] - bulk.min[axis]) / 3.0;
  std::size_t low = 0;
  std::size_t high = 0;
  for (std::size_t i = 0; i < positions.size(); ++i)
    if (take (i, axis)) {
      low += positions[i][axis] < bulk.min[axis] + third ? 1 : 0;
      high += positions[i][axis] > bulk.max[axis] - third ? 1 : 0;
    }
  return 20 * std::min (low, high) > bulk.counts[axis];
}

/** \brief Where nine tenths of the points are along each axis, or all of them if no few
 * make up most of the interval: that takes no sorting.
 * \param[in] take of a point and an axis, whether its coordinate, a finite one, counts
 */
template <typename Points, typename Take>
Bulk
findBulk (const Points& positions, const Take& take)
{
  Bulk bulk = findRange (positions, take);
  int widest = 0;
  (bulk.max - bulk.min).maxCoeff (&widest);
  if (fillRange (positions, widest, take, bulk))
    return bulk;
  std::vector<double> values;
  for (int axis = 0; axis < 3; ++axis) {
    values.clear();
    for (std::size_t i = 0; i < positions.size(); ++i)
      if (take (i, axis))
        values.push_back (positions[i][axis]);
    if (!values.empty()) {
      bulk.min[axis] = quantile (values, 5);
      bulk.max[axis] = quantile (values, 95);
    }
  }
  return bulk;
}

/** \brief How far outside of the bulk a position is along each axis. */
Eigen::Array3d
distancesTo (const Bulk& bulk, const Eigen::Vector3d& position)
{
  return (bulk.min - position.array()).max (position.array() - bulk.max).max (0.0);
}

template <typename Points>
void
setApart (const Points& positions, const Bulk& bulk, Placement& placement)
{
  const Eigen::Array3d no_data_from = FAR_FOR_NO_DATA * (bulk.max - bulk.min);
  const double apart_from = FAR_FOR_A_POINT * bulk.width();
  // Of one place there is nothing to be far from.
  if (!(apart_from > 0.0))
    return;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const auto& position = positions[i];
    if (!position.allFinite())
      continue;
    const Eigen::Array3d distances = distancesTo (bulk, position);
    bool no_data = false;
    for (int axis = 0; axis < 3; ++axis)
      no_data = no_data || (distances[axis] > no_data_from[axis] &&
                            standsForNoData (position[axis]));
    if (!no_data && distances.maxCoeff() <= apart_from)
      continue;
    placement.apart.push_back ({static_cast<index_t> (i), position});
    placement.no_data += no_data ? 1 : 0;
  }
}

/** \brief Along an axis near the middle of the bulk, or 0 where floats do without.
 *
 * \param[in] resolution how far apart coordinates are, which floats have to tell if an
 * offset lets them; 0 where that is not known
 */
double
offsetAlong (const Bulk& bulk, int axis, double resolution)
{
  // A surface of n points has a spacing of about its width by the root of n, of which
  // the steps between floats may be a thousandth.
  constexpr double FINEST = 1e-3;
  constexpr double NEAR = 4.0;
  const double farthest =
      std::max (std::abs (bulk.min[axis]), std::abs (bulk.max[axis]));
  const double between = std::numeric_limits<float>::epsilon();
  const double step = farthest * between;
  const double width = bulk.width();
  const bool resolves = step > resolution && width * between <= resolution;
  if (!(width > 0.0) ||
      (!resolves &&
       (farthest <= NEAR * width ||
        step * std::sqrt (static_cast<double> (bulk.counts[axis])) <= FINEST * width)))
    return 0.0;
  // A float, so that the origin of the file has its place in the cloud exactly.
  const double middle = bulk.min[axis] + 0.5 * (bulk.max[axis] - bulk.min[axis]);
  return std::round (static_cast<double> (static_cast<float> (middle))) + 0.0;
}

/** \param[in] positions their size and each by its index
 * \param[in] resolution of their coordinates, as offsetAlong has it
 */
template <typename Points>
Placement
findPlacement (const Points& positions, const Eigen::Vector3d& resolution)
{
  const auto isFinite = [&positions] (std::size_t i, int axis) {
    return std::isfinite (positions[i][axis]);
  };
  // What did not come back to a sensor is at 0 0 0 in many files, and may be most.
  Bulk bulk = findBulk (positions, [&] (std::size_t i, int axis) {
    return isFinite (i, axis) && !standsForNoData (positions[i][axis]) &&
           !positions[i].isZero (0.0);
  });
  // What all have along an axis is a coordinate.
  if (std::find (bulk.counts.begin(), bulk.counts.end(), 0) != bulk.counts.end())
    bulk = findBulk (positions, isFinite);
  Placement placement;
  setApart (positions, bulk, placement);
  // What was set apart has no part in the offset, and what was not, has.
  if (!placement.apart.empty() ||
      bulk.counts != findRange (positions, isFinite).counts) {
    std::vector<bool> is_apart (positions.size(), false);
    for (const Placement::PointApart& point : placement.apart)
      is_apart[static_cast<std::size_t> (point.index)] = true;
    bulk = findBulk (positions, [&] (std::size_t i, int axis) {
      return !is_apart[i] && isFinite (i, axis);
    });
  }
  for (int axis = 0; axis < 3; ++axis)
    placement.offset[axis] = offsetAlong (bulk, axis, resolution[axis]);
  return placement;
}

/** \brief Keeps points that are apart out of all that is computed. */
void
takeOut (const Placement& placement, pcl::PointCloud<pcl::PointNormal>& points)
{
  for (const Placement::PointApart& point : placement.apart)
    points[point.index].getVector3fMap().setConstant (
        std::numeric_limits<float>::quiet_NaN());
}

void
noteNotFinite (PlacedContent& content)
{
  const auto finite =
      std::count_if (content.points->begin(),
                     content.points->end(),
                     [] (const pcl::PointNormal& p) { return pcl::isXYZFinite (p); });
  const std::size_t not_finite = content.points->size() -
                                 static_cast<std::size_t> (finite) -
                                 content.placement.apart.size();
  if (not_finite != 0)
    content.notes.push_back (std::to_string (not_finite) + " of " +
                             std::to_string (content.points->size()) +
                             " points are not finite.");
}

void
noteOffset (PlacedContent& content)
{
  if (!needsDoubles (content.placement))
    return;
  std::string numbers;
  for (const double number : content.placement.offset) {
    numbers += ' ';
    appendNumber (numbers, number);
  }
  content.notes.push_back ("The coordinates are far from the origin:" + numbers +
                           " is taken off them, and added again, in doubles, to what "
                           "is written.");
}

void
noteApart (PlacedContent& content)
{
  const std::size_t apart = content.placement.apart.size();
  const std::size_t no_data = content.placement.no_data;
  if (apart == 0)
    return;
  std::string note = std::to_string (apart) + " of " +
                     std::to_string (content.points->size()) +
                     " points are set apart, and have the label 5:";
  if (no_data != 0)
    note += " " + std::to_string (no_data) + " with a number that stands for no data";
  if (no_data != 0 && no_data != apart)
    note += ",";
  if (no_data != apart)
    note += " " + std::to_string (apart - no_data) +
            " more than 1000 times the width of the cloud away from it";
  content.notes.push_back (note + ".");
}

/** \brief Of a file that has floats. */
void
noteBlur (PlacedContent& content)
{
  Eigen::AlignedBox3d box;
  for (const pcl::PointNormal& point : *content.points)
    if (pcl::isXYZFinite (point))
      box.extend (content.placement.toFile (point.getVector3fMap()));
  // Floats are 1e-7 of their value apart: 1e-4 of the cloud's extent from here on,
  // which a fit to neighbours, some 1e-2 of it apart, begins to feel.
  constexpr double FAR = 1e3;
  if (!box.isEmpty() && box.sizes().maxCoeff() > 0.0 &&
      box.min().cwiseAbs().cwiseMax (box.max().cwiseAbs()).maxCoeff() >
          FAR * box.sizes().maxCoeff())
    content.notes.emplace_back (
        "The single precision of the file blurs its shape so far from the origin: "
        "write it with doubles, or subtract an offset before writing it.");
}

} // namespace

Placement
placePoints (const std::vector<Eigen::Vector3d>& positions,
             pcl::PointCloud<pcl::PointNormal>& points)
{
  Placement placement = findPlacement (positions, Eigen::Vector3d::Zero());
  if (points.size() != positions.size())
    points.resize (positions.size());
  for (std::size_t i = 0; i < positions.size(); ++i)
    points[i].getVector3fMap() = placement.toCloud (positions[i]);
  takeOut (placement, points);
  points.is_dense =
      std::all_of (points.begin(), points.end(), [] (const pcl::PointNormal& p) {
        return pcl::isXYZFinite (p);
      });
  return placement;
}

PlacedContent
placeContent (FileContent content)
{
  PlacedContent placed;
  placed.placement = findPlacement (content.points, content.step.cwiseAbs());
  placed.placement.step = content.step;
  placed.placement.origin = content.origin;
  placed.placement.crs_records = std::move (content.crs_records);
  placed.points = content.points.place (placed.placement);
  pcl::PointCloud<pcl::PointNormal>& points = *placed.points;
  takeOut (placed.placement, points);
  points.height = static_cast<std::uint32_t> (content.rows);
  points.width = static_cast<std::uint32_t> (points.size() / content.rows);
  placed.has_normals = content.has_normals;
  if (content.orientation) {
    points.sensor_orientation_ = *content.orientation;
    // PCL's default, which tells nothing of a sensor, stays what it is.
    if (!content.viewpoint->isZero (0.0))
      points.sensor_origin_.head<3>() = placed.placement.toCloud (*content.viewpoint);
  }
  placed.colors = std::move (content.colors);
  placed.fields = std::move (content.fields);
  placed.faces = std::move (content.faces);
  placed.viewpoint = content.viewpoint;
  placed.notes = std::move (content.notes);
  noteNotFinite (placed);
  noteOffset (placed);
  noteApart (placed);
  if (content.has_floats)
    noteBlur (placed);
  return placed;
}

void
appendPlace (std::string& text,
             const Eigen::Vector3f& place,
             const Placement& placement)
{
  const Eigen::Vector3d in_file = placement.toFile (place);
  for (int axis = 0; axis < 3; ++axis) {
    if (axis != 0)
      text += ' ';
    if (placement.offset[axis] == 0.0)
      appendNumber (text, place[axis]);
    else
      appendNumber (text, in_file[axis]);
  }
}

} // namespace crest
} // namespace pcl
