// SPDX-License-Identifier: BSD-3-Clause
// Rims against plates that are known exactly.
#include <gtest/gtest.h>

#include "creases/plate_rim.h"

#include <algorithm>
#include <cmath>

using namespace pcl::crest;
using Eigen::Vector3d;

namespace {

/** Between rows of samples along the rim. */
constexpr double ROWS = 0.9;

struct Samples {
  std::vector<Vector3d> positions;
  std::vector<Vector3d> normals;

  void
  add (const Vector3d& position, const Vector3d& normal)
  {
    positions.push_back (position);
    normals.push_back (normal);
  }

  /** \brief A sheet at a height, in rows along the rim at x = 0. */
  void
  addSheet (double height, const Vector3d& normal)
  {
    for (int row = 0; row < 9; ++row)
      for (double y = -6.0; y <= 6.0; y += 1.0)
        add ({-ROWS * row, y, height}, normal);
  }

  /** \brief Fits the rim to the 48 that are nearest to one of them. */
  std::optional<PlateRim>
  fitAround (const Vector3d& sample, const Vector3d& normal) const
  {
    constexpr std::size_t NEIGHBORS = 48;
    constexpr double MOST = 0.1;
    std::vector<std::size_t> order (positions.size());
    for (std::size_t i = 0; i < order.size(); ++i)
      order[i] = i;
    std::sort (order.begin(), order.end(), [&] (std::size_t a, std::size_t b) {
      return (positions[a] - sample).norm() < (positions[b] - sample).norm();
    });
    const std::size_t count = std::min (NEIGHBORS, order.size());
    Coordinates near;
    Coordinates of_near;
    near.resize (count);
    of_near.resize (count);
    for (std::size_t i = 0; i < count; ++i) {
      near.set (i, positions[order[i]] - sample);
      of_near.set (i, normals[order[i]]);
    }
    return fitPlateRim (near, of_near, normal, MOST);
  }
};

const Vector3d UP = Vector3d::UnitZ();

/** \brief Below z = 0, with its rim at x = 0. */
Samples
plate (double thickness)
{
  Samples samples;
  samples.addSheet (0.0, UP);
  samples.addSheet (-thickness, -UP);
  return samples;
}

} // namespace

TEST (PlateRim, IsWhereEachSheetEnds)
{
  for (const double thickness : {0.5, 1.0, 1.5})
    for (const double x : {0.0, -ROWS}) {
      const Vector3d sample (x, 0.0, 0.0);
      const auto upper = plate (thickness).fitAround (sample, UP);
      ASSERT_TRUE (upper) << thickness << " " << x;
      EXPECT_LT ((sample + upper->foot).norm(), 0.1);
      EXPECT_GT (std::abs (upper->direction.y()), 0.99);
      EXPECT_GT (upper->normal.dot (Vector3d (1.0, 0.0, 1.0).normalized()), 0.99);
      EXPECT_NEAR (upper->of_sheets, 0.0, 1e-12);
      EXPECT_NEAR (upper->of_one_plane, 0.25 * thickness * thickness, 1e-12);
    }
  const auto lower = plate (1.0).fitAround ({0.0, 0.0, -1.0}, -UP);
  ASSERT_TRUE (lower);
  EXPECT_LT (lower->foot.norm(), 0.1);
  EXPECT_GT (lower->normal.dot (Vector3d (1.0, 0.0, -1.0).normalized()), 0.99);
}

TEST (PlateRim, IsFoundWhereNoiseHasTurnedNormals)
{
  Samples samples = plate (1.5);
  for (std::size_t i = 0; i < samples.normals.size(); i += 7)
    samples.normals[i] = -samples.normals[i];
  const auto upper = samples.fitAround ({0.0, 0.0, 0.0}, UP);
  ASSERT_TRUE (upper);
  EXPECT_LT (upper->foot.norm(), 0.1);
  EXPECT_NEAR (upper->of_sheets, 0.0, 1e-12);
}

TEST (PlateRim, IsNotInsideNorOfWhatIsThick)
{
  for (const double row : {2.0, 3.0, 4.0, 5.0})
    EXPECT_FALSE (plate (1.0).fitAround ({-row * ROWS, 0.0, 0.0}, UP));
  EXPECT_FALSE (plate (2.5).fitAround ({0.0, 0.0, 0.0}, UP));
}

TEST (PlateRim, IsNoneOfAnOpenSheet)
{
  Samples sheet;
  sheet.addSheet (0.0, UP);
  EXPECT_FALSE (sheet.fitAround ({0.0, 0.0, 0.0}, UP));
}

TEST (PlateRim, IsNoneOfTheSidesOfASlot)
{
  Samples slot;
  slot.addSheet (0.0, -UP);
  slot.addSheet (-1.0, UP);
  EXPECT_FALSE (slot.fitAround ({0.0, 0.0, 0.0}, -UP));
}

TEST (PlateRim, IsNotWhereAPlateMeetsAWall)
{
  Samples joint = plate (1.0);
  for (double z = -6.0; z <= 6.0; z += 1.0)
    for (double y = -6.0; y <= 6.0; y += 1.0)
      joint.add ({1.0, y, z}, -Vector3d::UnitX());
  EXPECT_FALSE (joint.fitAround ({0.0, 0.0, 0.0}, UP));
}
