// SPDX-License-Identifier: BSD-3-Clause
// Curvature at a scale against exact curvature, and its errors against real ones.
#include <gtest/gtest.h>

#include "crests/crest_profile.h"
#include "curvature/scale_fit.h"
#include "support/crest_truth.h"
#include "support/noisy_cloud.h"
#include "support/scale_fits.h"

#include <algorithm>
#include <cmath>

using namespace pcl::crest;
using oracle::fitsAt;
using oracle::median;
using oracle::variance;
using Cloud = pcl::PointCloud<pcl::PointNormal>;

TEST (ScaleFit, FindsTheCurvatureOfATorus)
{
  // On the outer equator 1 / .4 around the tube and 1 / 1.4 around the axis.
  const Cloud::Ptr cloud = oracle::sample (oracle::torus (1.0, 0.4), 12000);
  for (const auto& [number, nearest] :
       std::vector<std::pair<int, int>>{{0, 28}, {1, 28}, {1, 70}}) {
    const oracle::ScaleFits run = fitsAt (*cloud, number, nearest);
    std::vector<double> k1_errors;
    std::vector<double> k2_errors;
    std::vector<double> t1_errors;
    for (std::size_t i = 0; i < run.fits.size(); ++i) {
      ASSERT_TRUE (run.fits[i].valid);
      const Eigen::Vector3d p = run.level.positions[i].cast<double>();
      const double axis = std::hypot (p.x(), p.y());
      const double cosine = (axis - 1.0) / std::hypot (axis - 1.0, p.z());
      k1_errors.push_back (std::abs (run.fits[i].k1 - 2.5) / 2.5);
      k2_errors.push_back (std::abs (run.fits[i].k2 - cosine / (1.0 + 0.4 * cosine)));
      const Eigen::Vector3d around (-p.y() / axis, p.x() / axis, 0.0);
      t1_errors.push_back (std::abs (run.fits[i].t1.cast<double>().dot (around)));
    }
    // What a cubic does not follow of a circle falls with the square of the radius.
    const double turn = 2.5 * run.fits[0].radius;
    const double tolerance = 0.2 * turn * turn;
    EXPECT_LT (median (k1_errors), tolerance) << number << ' ' << nearest;
    EXPECT_LT (median (k2_errors), 2.0 * tolerance) << number << ' ' << nearest;
    EXPECT_LT (median (t1_errors), 0.01) << number << ' ' << nearest;
  }
}

TEST (ScaleFit, LiesNearerToTheSurfaceThanItsNode)
{
  const Cloud::Ptr exact = oracle::sample (oracle::sphere (1.0), 8000);
  const double noise = 0.3 * oracle::meanSpacing (*exact);
  const oracle::ScaleFits run = fitsAt (*oracle::withNoise (*exact, noise), 0, 28);
  std::vector<double> node;
  std::vector<double> fit;
  for (std::size_t i = 0; i < run.fits.size(); ++i) {
    const Eigen::Vector3d p = run.level.positions[i].cast<double>();
    node.push_back (std::abs (p.norm() - 1.0));
    fit.push_back (std::abs (
        (p + run.fits[i].offset * run.fits[i].normal.cast<double>()).norm() - 1.0));
  }
  EXPECT_LT (median (fit), 0.6 * median (node));
}

TEST (ScaleFit, ErrorsAreThoseOfNoisyCylinders)
{
  struct Case {
    int level, nearest;
    double noise;
  };
  // Noise small enough that k1 is certain, or the fit takes the larger of two that are
  // not, and large enough to hide what a cubic cannot follow.
  const Cloud::Ptr exact = oracle::sample (oracle::cylinder (0.5), 20000);
  const double h = oracle::meanSpacing (*exact);
  for (const Case& c : {Case{0, 28, 0.01},
                        Case{1, 28, 0.05},
                        Case{1, 28, 0.2},
                        Case{1, 44, 0.2},
                        Case{1, 70, 0.2}}) {
    const Cloud::Ptr cloud = oracle::withNoise (*exact, c.noise * h);
    const oracle::ScaleFits run = fitsAt (*cloud, c.level, c.nearest);
    std::vector<double> z;
    std::vector<double> noises;
    for (std::size_t i = 0; i < run.fits.size(); ++i)
      if (run.fits[i].valid && std::abs (run.level.positions[i].z()) < 0.6) {
        z.push_back ((run.fits[i].k1 - 2.0) / run.fits[i].k1_error);
        noises.push_back (run.fits[i].noise / (c.noise * h));
      }
    EXPECT_NEAR (median (noises), 1.0, 0.1) << c.level << ' ' << c.nearest;
    EXPECT_GT (variance (z), 0.7) << c.level << ' ' << c.nearest;
    EXPECT_LT (variance (z), 1.4) << c.level << ' ' << c.nearest;
  }
}

TEST (CrestProfile, NoisyCylindersAreNotResolved)
{
  const Cloud::Ptr exact = oracle::sample (oracle::cylinder (0.2), 20000);
  const double h = oracle::meanSpacing (*exact);
  for (const double noise : {0.005, 0.01, 0.2}) {
    const oracle::SurfaceStages stages =
        oracle::surfaceStages (*oracle::withNoise (*exact, noise * h));
    std::size_t resolved = 0;
    for (const CrestProfile& profile : profileCrests (
             stages.points, stages.graph, treeOver (stages.points.positions, 1), 0))
      resolved += profile.resolved ? 1 : 0;
    EXPECT_LT (resolved, stages.points.size() / 50) << noise;
  }
}

TEST (CrestProfile, TurningAngleIsThatOfTheParabola)
{
  EXPECT_NEAR (turningAngle (115.0), 10.0, 0.1);
  EXPECT_NEAR (turningAngle (18.7), 25.0, 0.1);
  EXPECT_EQ (turningAngle (0.01), 180.0);
  EXPECT_EQ (turningAngle (-1.0), 180.0);
}

TEST (ScaleFit, TakesTheNearestOfAHub)
{
  // A hub that has all others as its star, in rings of which more than one is left
  // over.
  constexpr int OTHERS = 400;
  constexpr int NEAREST = 28;
  PyramidLevel level;
  std::vector<double> distances;
  for (int i = 0; i <= OTHERS; ++i) {
    const double r = 0.01 * (i * 37 % (OTHERS + 1));
    level.positions.emplace_back (r * std::cos (i), r * std::sin (i), -0.1 * r * r);
    level.normals.push_back (Eigen::Vector3f::UnitZ());
    level.weights.push_back (1.0F);
    level.node_of.push_back (i);
    distances.push_back (level.positions.back().norm());
  }
  level.graph.offsets.push_back (0);
  for (int i = 0; i <= OTHERS; ++i) {
    for (int j = i == 0 ? 1 : 0; j <= (i == 0 ? OTHERS : 0); ++j)
      level.graph.neighbors.push_back (j);
    level.graph.offsets.push_back (level.graph.neighbors.size());
  }
  level.tree = treeOver (level.positions, 1);
  std::vector<std::uint8_t> needed (level.size(), 0);
  needed[0] = 1;
  const ScaleFit fit = fitAtScale (level, NEAREST, needed, 1)[0];
  ASSERT_TRUE (fit.valid);
  std::sort (distances.begin(), distances.end());
  // The hub is one of them.
  EXPECT_NEAR (fit.radius, 1.02 * distances[NEAREST - 1], 1e-6);
  EXPECT_NEAR (fit.k1, 0.2, 1e-3);
}

namespace {

/** \brief A plate of two plane sides, or a step between two levels, as a level whose
 * nodes are neighbours on their own side alone.
 */
struct FlatSides {
  static constexpr int SIZE = 24;

  PyramidLevel level;

  void
  add (const Eigen::Vector3f& position, const Eigen::Vector3f& normal)
  {
    level.node_of.push_back (static_cast<index_t> (level.size()));
    level.positions.push_back (position);
    level.normals.push_back (normal);
    level.weights.push_back (1.0F);
  }

  /** \brief Makes neighbours of what is near and may be so. */
  template <typename MayBe>
  std::vector<ScaleFit>
  fit (const MayBe& may_be)
  {
    const auto size = static_cast<index_t> (level.size());
    level.graph.offsets.push_back (0);
    for (index_t p = 0; p < size; ++p) {
      for (index_t q = 0; q < size; ++q)
        if (p != q && (level.positions[p] - level.positions[q]).norm() < 1.6F &&
            may_be (p, q))
          level.graph.neighbors.push_back (q);
      level.graph.offsets.push_back (level.graph.neighbors.size());
    }
    level.tree = treeOver (level.positions, 1);
    return fitAtScale (level, 28, std::vector<std::uint8_t> (level.size(), 1), 1);
  }
};

/** \brief Irregular, as lattices leave terms open, but on the plane. */
Eigen::Vector3f
scattered (int i, int j)
{
  const auto x = static_cast<float> (i);
  const auto y = static_cast<float> (j);
  return {
      x + 0.2F * std::sin (7.0F * x + 3.0F * y), y + 0.2F * std::cos (5.0F * x), 0.0F};
}

} // namespace

TEST (ScaleFit, SeesOneSideOfAPlateAlone)
{
  FlatSides sides;
  for (int i = 0; i < FlatSides::SIZE; ++i)
    for (int j = 0; j < FlatSides::SIZE; ++j) {
      sides.add (scattered (i, j), Eigen::Vector3f::UnitZ());
      sides.add (scattered (j, i) - 0.5F * Eigen::Vector3f::UnitZ(),
                 -Eigen::Vector3f::UnitZ());
    }
  const std::vector<ScaleFit> fits = sides.fit ([&sides] (index_t p, index_t q) {
    return sides.level.normals[p].z() == sides.level.normals[q].z();
  });
  for (const ScaleFit& fit : fits) {
    ASSERT_TRUE (fit.valid);
    EXPECT_NEAR (fit.k1, 0.0, 1e-6);
    EXPECT_NEAR (fit.offset, 0.0, 1e-6);
  }
}

TEST (ScaleFit, DoesNotLookAcrossNodesThatTheGraphLeavesAlone)
{
  // The level falls by half a spacing where a strip of nodes is alone.
  constexpr int STRIP = FlatSides::SIZE / 2;
  FlatSides sides;
  std::vector<int> columns;
  for (int i = 0; i < FlatSides::SIZE; ++i)
    for (int j = 0; j < FlatSides::SIZE; ++j) {
      columns.push_back (i);
      sides.add (scattered (i, j) -
                     (i < STRIP ? 0.0F : 0.5F) * Eigen::Vector3f::UnitZ(),
                 Eigen::Vector3f::UnitZ());
    }
  const std::vector<ScaleFit> fits = sides.fit ([&columns] (index_t p, index_t q) {
    return columns[p] != STRIP && columns[q] != STRIP &&
           (columns[p] < STRIP) == (columns[q] < STRIP);
  });
  for (std::size_t i = 0; i < fits.size(); ++i) {
    EXPECT_EQ (fits[i].valid, columns[i] != STRIP);
    EXPECT_NEAR (fits[i].k1, 0.0, 1e-6);
  }
}
