// SPDX-License-Identifier: BSD-3-Clause
#include "meshes/face_samples.h"

#include <Eigen/Geometry>

#include "base/parallel.h"
#include "base/radix_sort.h"
#include "base/scrambled.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace pcl {
namespace crest {

namespace {

using Eigen::Vector3d;

/** Per square of the spacing, and the distance in spacings that so many fill up to one
 * sample a square. */
constexpr double DARTS = 10.0;
constexpr double DISK = 0.773;

/** \brief A place on a face, known by its number. */
struct Dart {
  std::uint64_t cell;
  std::uint32_t triangle;
  std::uint32_t number;
};

/** \brief Places on triangles by their numbers. */
class Darts {
public:
  Darts (const PointView& cloud, const Faces& triangles, const TriangleShapes& shapes)
  : cloud_ (cloud), triangles_ (triangles), shapes_ (shapes)
  {}

  Vector3d
  position (std::uint32_t triangle, std::uint32_t number) const
  {
    // Multiples of the inverses of the root of x^3 = x + 1 and of its square.
    constexpr std::uint32_t STEP_U = 3242174889U;
    constexpr std::uint32_t STEP_V = 2447445414U;
    constexpr double UNIT = 1.0 / 4294967296.0;
    double u = (STEP_U * number) * UNIT;
    double v = (STEP_V * number) * UNIT;
    if (u + v > 1.0) {
      u = 1.0 - u;
      v = 1.0 - v;
    }
    const Vector3d a = corner (triangle, 0);
    return a + u * (corner (triangle, 1) - a) + v * (corner (triangle, 2) - a);
  }

  const Vector3d&
  normal (std::uint32_t triangle) const
  {
    return shapes_.normals[triangle];
  }

private:
  Vector3d
  corner (std::uint32_t triangle, std::size_t i) const
  {
    return cloud_
        .positionOf (static_cast<std::size_t> (
            triangles_.corners[3 * static_cast<std::size_t> (triangle) + i]))
        .cast<double>();
  }

  const PointView& cloud_;
  const Faces& triangles_;
  const TriangleShapes& shapes_;
};

/** \brief Cubes of space, three times 21 bits of a number: those of a row along x are
 * consecutive.
 */
class Cells {
public:
  static constexpr std::uint64_t ROW = std::uint64_t (1) << 21;
  static constexpr std::uint64_t LAYER = ROW << 21;

  Cells (const Eigen::AlignedBox3d& box, double width)
  : low_ (box.min()), scale_ (1.0 / std::max (width, box.sizes().maxCoeff() / MOST))
  {}

  std::uint64_t
  of (const Vector3d& position) const
  {
    // The lowest cells have neighbours, too.
    const Vector3d cell = ((position - low_) * scale_).array().floor() + 1.0;
    return static_cast<std::uint64_t> (cell.z()) * LAYER +
           static_cast<std::uint64_t> (cell.y()) * ROW +
           static_cast<std::uint64_t> (cell.x());
  }

  /** \brief One of eight, a different one for each of the cells around a place. */
  static int
  turnOf (std::uint64_t cell)
  {
    return static_cast<int> ((cell & 1) + 2 * (cell / ROW & 1) +
                             4 * (cell / LAYER & 1));
  }

private:
  static constexpr double MOST = 2e6;

  Vector3d low_;
  double scale_;
};

/** \brief All darts in the order of their cells, in each in an order of its own. */
std::vector<Dart>
spreadDarts (const Darts& places,
             const TriangleShapes& shapes,
             const Cells& cells,
             double darts_per_area,
             const Workers& workers)
{
  std::vector<Dart> darts;
  double area = 0.0;
  for (const double own : shapes.areas)
    area += own;
  darts.reserve (static_cast<std::size_t> (area * darts_per_area) + 1);
  // One in each step of the area, at random: at the same place in all, the darts of a
  // grid's triangles would fall on every second of these.
  constexpr double UNIT = 1.0 / 4294967296.0;
  double sum = 0.0;
  std::uint32_t number = 0;
  const auto next = [&number] { return number + scrambled (number) * UNIT; };
  for (std::size_t i = 0; i < shapes.areas.size(); ++i)
    for (sum += shapes.areas[i] * darts_per_area; next() < sum; ++number)
      if (!shapes.normals[i].isZero (0.0))
        darts.push_back ({0, static_cast<std::uint32_t> (i), number});
  forEachBlock (
      darts.size(), workers, [&] (std::size_t, std::size_t first, std::size_t last) {
        for (; first < last; ++first) {
          Dart& dart = darts[first];
          dart.cell = cells.of (places.position (dart.triangle, dart.number));
        }
      });
  radixSort (
      darts.data(),
      darts.data() + darts.size(),
      [] (const Dart& dart) { return dart.cell; },
      [] (const Dart& a, const Dart& b) {
        return scrambled (a.number) < scrambled (b.number);
      });
  return darts;
}

/** \brief The darts of a cell; those that found room come first. */
struct CellDarts {
  std::uint64_t cell;
  std::size_t first;
  std::size_t end;
  std::size_t taken;
};

std::vector<CellDarts>
divide (const std::vector<Dart>& darts)
{
  std::vector<CellDarts> cells;
  for (std::size_t i = 0; i < darts.size(); ++i) {
    if (cells.empty() || cells.back().cell != darts[i].cell)
      cells.push_back ({darts[i].cell, i, i, i});
    cells.back().end = i + 1;
  }
  return cells;
}

/** \brief Throws the darts of some cells after the other. */
class Thrower {
public:
  Thrower (const Darts& places, double disk, std::vector<Dart>& darts)
  : places_ (places), squared_disk_ (disk * disk), darts_ (darts)
  {}

  /** \brief Throws those of all cells whose turn it is.
   * \param[in] first, last of the cells
   */
  void
  throwInto (std::vector<CellDarts>& cells,
             std::size_t first,
             std::size_t last,
             int turn)
  {
    constexpr std::array<std::int64_t, 3> STEPS{-1, 0, 1};
    std::array<std::uint64_t, 9> rows;
    std::array<std::size_t, 9> at;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      rows[i] = static_cast<std::uint64_t> (STEPS[i / 3]) * Cells::LAYER +
                static_cast<std::uint64_t> (STEPS[i % 3]) * Cells::ROW - 1;
      at[i] = static_cast<std::size_t> (
          std::lower_bound (cells.begin(),
                            cells.end(),
                            cells[first].cell + rows[i],
                            [] (const CellDarts& cell, std::uint64_t key) {
                              return cell.cell < key;
                            }) -
          cells.begin());
    }
    for (std::size_t own = first; own < last; ++own) {
      if (Cells::turnOf (cells[own].cell) != turn)
        continue;
      around_.clear();
      for (std::size_t i = 0; i < rows.size(); ++i) {
        const std::uint64_t begin = cells[own].cell + rows[i];
        while (at[i] < cells.size() && cells[at[i]].cell < begin)
          ++at[i];
        for (std::size_t j = at[i]; j < cells.size() && cells[j].cell < begin + 3; ++j)
          for (std::size_t k = cells[j].first; k < cells[j].taken; ++k)
            around_.push_back (placeOf (darts_[k]));
      }
      throwInto (cells[own]);
    }
  }

private:
  struct Place {
    Vector3d position;
    const Vector3d* normal;
  };

  Place
  placeOf (const Dart& dart) const
  {
    return {places_.position (dart.triangle, dart.number),
            &places_.normal (dart.triangle)};
  }

  bool
  hasRoom (const Place& place) const
  {
    // Faces of an edge are not turned by more, where it is one for the lines.
    constexpr double OTHER_SIDE = -0.9;
    return std::none_of (around_.begin(), around_.end(), [&] (const Place& taken) {
      return (taken.position - place.position).squaredNorm() < squared_disk_ &&
             taken.normal->dot (*place.normal) > OTHER_SIDE;
    });
  }

  void
  throwInto (CellDarts& cell)
  {
    for (std::size_t i = cell.first; i < cell.end; ++i) {
      const Place place = placeOf (darts_[i]);
      if (!hasRoom (place))
        continue;
      around_.push_back (place);
      std::swap (darts_[i], darts_[cell.taken++]);
    }
  }

  const Darts& places_;
  double squared_disk_;
  std::vector<Dart>& darts_;
  /** what is taken in the cells around and in the own one */
  std::vector<Place> around_;
};

} // namespace

FaceSamples
sampleFaces (const PointView& cloud,
             const Faces& triangles,
             const TriangleShapes& shapes,
             double spacing,
             const Workers& workers)
{
  constexpr int TURNS = 8;
  Eigen::AlignedBox3d box;
  for (const index_t corner : triangles.corners)
    box.extend (cloud.positionOf (static_cast<std::size_t> (corner)).cast<double>());
  const Darts places (cloud, triangles, shapes);
  const double disk = DISK * spacing;
  std::vector<Dart> darts = spreadDarts (
      places, shapes, Cells (box, disk), DARTS / (spacing * spacing), workers);
  std::vector<CellDarts> cells = divide (darts);
  for (int turn = 0; turn < TURNS; ++turn)
    forEachBlock (
        cells.size(), workers, [&] (std::size_t, std::size_t first, std::size_t last) {
          Thrower (places, disk, darts).throwInto (cells, first, last, turn);
        });
  FaceSamples samples;
  for (const CellDarts& cell : cells)
    for (std::size_t i = cell.first; i < cell.taken; ++i) {
      const Dart& dart = darts[i];
      samples.positions.push_back (
          places.position (dart.triangle, dart.number).cast<float>());
      samples.normals.push_back (places.normal (dart.triangle).cast<float>());
    }
  return samples;
}

} // namespace crest
} // namespace pcl
