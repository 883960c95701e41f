// SPDX-License-Identifier: BSD-3-Clause
#include "meshes/shared_corners.h"

#include <Eigen/Geometry>

#include "base/disjoint_sets.h"
#include "base/radix_sort.h"

#include <algorithm>
#include <cstdint>

namespace pcl {
namespace crest {

namespace {

/** \brief A point in a cell of space. */
struct CellPoint {
  std::uint64_t cell;
  index_t point;
};

/** \brief Cells much wider than the rounding, so that few points are near the next. */
class RoundingCells {
public:
  RoundingCells (const PointView& cloud, const Eigen::AlignedBox3f& box)
  : cloud_ (cloud), low_ (box.min().cast<double>())
  {
    // Of the coordinates, and of those that they were computed from.
    constexpr double ROUNDING = 1e-6;
    constexpr double PART_OF_EXTENT = 5e-7;
    constexpr double WIDTH = 16.0;
    const double extent = box.sizes().maxCoeff();
    const double largest =
        box.min().cwiseAbs().cwiseMax (box.max().cwiseAbs()).maxCoeff();
    tolerance_ = std::max (PART_OF_EXTENT * extent, ROUNDING * largest);
    scale_ = tolerance_ > 0.0 ? 1.0 / (WIDTH * tolerance_) : 0.0;
  }

  /** \brief The cell of a place this many tolerances from a point. */
  std::uint64_t
  cellOf (index_t point, const Eigen::Vector3d& tolerances) const
  {
    // The lowest places may be below the box.
    const Eigen::Vector3d cell =
        ((position (point) + tolerance_ * tolerances - low_) * scale_).array().floor() +
        1.0;
    return (static_cast<std::uint64_t> (cell.x()) << 42) +
           (static_cast<std::uint64_t> (cell.y()) << 21) +
           static_cast<std::uint64_t> (cell.z());
  }

  bool
  areSame (index_t a, index_t b) const
  {
    return (position (a) - position (b)).norm() <= tolerance_;
  }

private:
  Eigen::Vector3d
  position (index_t point) const
  {
    return cloud_.positionOf (static_cast<std::size_t> (point)).cast<double>();
  }

  const PointView& cloud_;
  Eigen::Vector3d low_;
  double tolerance_ = 0.0;
  double scale_ = 0.0;
};

/** \brief Unites a point with those of a cell that are at its place. */
void
uniteWithin (const RoundingCells& cells,
             const std::vector<CellPoint>& points,
             index_t own,
             std::vector<CellPoint>::const_iterator other,
             DisjointSets& same)
{
  for (const std::uint64_t cell = other->cell;
       other != points.end() && other->cell == cell;
       ++other)
    if (other->point < own && cells.areSame (other->point, own))
      same.unite (other->point, own);
}

/** \brief Unites points at the same place, whose cells are in order. */
void
uniteSame (const RoundingCells& cells,
           const std::vector<CellPoint>& points,
           DisjointSets& same)
{
  auto begin = points.begin();
  for (const CellPoint& own : points) {
    if (begin->cell != own.cell)
      begin = points.begin() + (&own - points.data());
    uniteWithin (cells, points, own.point, begin, same);
    const Eigen::Vector3d diagonal = Eigen::Vector3d::Ones();
    if (cells.cellOf (own.point, -diagonal) == cells.cellOf (own.point, diagonal))
      continue;
    for (int corner = 0; corner < 8; ++corner) {
      const std::uint64_t near = cells.cellOf (own.point,
                                               {(corner & 1) != 0 ? 1.0 : -1.0,
                                                (corner & 2) != 0 ? 1.0 : -1.0,
                                                (corner & 4) != 0 ? 1.0 : -1.0});
      const auto other = std::lower_bound (
          points.begin(),
          points.end(),
          near,
          [] (const CellPoint& p, std::uint64_t cell) { return p.cell < cell; });
      if (near != own.cell && other != points.end() && other->cell == near)
        uniteWithin (cells, points, own.point, other, same);
    }
  }
}

/** \brief Of each point the first that is at its place; -1 where that is not finite. */
std::vector<index_t>
firstAtPlace (const PointView& cloud)
{
  Eigen::AlignedBox3f box;
  std::vector<index_t> finite;
  for (std::size_t i = 0; i < cloud.size; ++i)
    if (cloud.positionOf (i).allFinite()) {
      box.extend (cloud.positionOf (i));
      finite.push_back (static_cast<index_t> (i));
    }
  std::vector<index_t> first (cloud.size, -1);
  if (finite.empty())
    return first;
  const RoundingCells cells (cloud, box);
  std::vector<CellPoint> points;
  points.reserve (finite.size());
  for (const index_t point : finite)
    points.push_back ({cells.cellOf (point, Eigen::Vector3d::Zero()), point});
  radixSort (
      points.data(),
      points.data() + points.size(),
      [] (const CellPoint& p) { return p.cell; },
      [] (const CellPoint& a, const CellPoint& b) { return a.point < b.point; });
  DisjointSets same (cloud.size);
  uniteSame (cells, points, same);
  for (const index_t point : finite)
    first[point] = same.find (point);
  return first;
}

} // namespace

Faces
shareCorners (const PointView& cloud, const Faces& faces)
{
  const std::vector<index_t> first = firstAtPlace (cloud);
  Faces shared;
  std::vector<index_t> corners;
  for (std::size_t face = 0; face < faces.size(); ++face) {
    corners.clear();
    for (std::size_t i = faces.begin (face); i < faces.ends[face]; ++i) {
      const index_t corner = first[faces.corners[i]];
      if (corners.empty() || corner != corners.back())
        corners.push_back (corner);
    }
    while (corners.size() > 1 && corners.back() == corners.front())
      corners.pop_back();
    if (corners.size() < 3 || std::count (corners.begin(), corners.end(), -1) != 0)
      continue;
    shared.corners.insert (shared.corners.end(), corners.begin(), corners.end());
    shared.close();
  }
  return shared;
}

} // namespace crest
} // namespace pcl
