// SPDX-License-Identifier: BSD-3-Clause
// The lines of solids whose edges are known, by the auto preset's defaults.
#include <pcl_crest/crest_line_estimation.h>

#include <gtest/gtest.h>

#include "support/noisy_cloud.h"
#include "support/sharp_solids.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <set>

using namespace pcl::crest;
using Cloud = pcl::PointCloud<pcl::PointNormal>;

namespace {

struct Drawn {
  std::vector<CrestLine> ridges;
  std::vector<CrestLine> valleys;
  Cloud::ConstPtr cloud;
  pcl::PointCloud<pcl::Label> labels;
};

Drawn
draw (const Cloud::ConstPtr& cloud, double angle = Parameters().angle)
{
  pcl::CrestLineEstimation<pcl::PointNormal> estimation;
  estimation.setInputCloud (cloud);
  estimation.setPreset (Preset::AUTO);
  estimation.setTurningAngle (angle);
  Drawn drawn;
  estimation.compute (drawn.labels);
  for (const CrestLine& line : estimation.getLines())
    (line.type == CrestType::RIDGE ? drawn.ridges : drawn.valleys).push_back (line);
  drawn.cloud = estimation.getLineCloud();
  return drawn;
}

/** \brief The points that polylines of a line end in. */
std::set<index_t>
corners (const CrestLine& line)
{
  std::set<index_t> points;
  for (const auto& polyline : line.polylines) {
    points.insert (polyline.front());
    points.insert (polyline.back());
  }
  return points;
}

/** \brief Each solid at random and on grids, without noise and with. */
std::vector<Cloud::Ptr>
clouds (const oracle::SharpSolid& solid, std::size_t count)
{
  std::vector<Cloud::Ptr> result;
  for (const Cloud::Ptr& exact :
       {oracle::sample (solid, count), oracle::sampleOnGrids (solid, count)}) {
    result.push_back (exact);
    result.push_back (oracle::withNoise (*exact, 0.05 * oracle::meanSpacing (*exact)));
  }
  return result;
}

void
expectExact (const Drawn& drawn, const oracle::SharpSolid& solid, double h)
{
  for (const CrestType type : CREST_TYPES) {
    const auto& lines = type == CrestType::RIDGE ? drawn.ridges : drawn.valleys;
    if (lines.empty())
      continue;
    const oracle::LineScore score = oracle::scoreLines (
        lines, *drawn.cloud, oracle::trueCrestLines (solid), type, 2.0 * h);
    EXPECT_GE (score.precision, 0.99);
    EXPECT_GE (score.recall, 0.98);
    EXPECT_LE (2.0 * score.error, 0.15);
    // Single lines: nothing is drawn twice.
    EXPECT_LE (score.drawn_length, 1.02 * score.salient_length);
  }
}

} // namespace

TEST (CreaseLines, CubeHasTwelveEdgesAndEightCorners)
{
  const oracle::SharpSolid solid = oracle::box (1.0, 1.0, 1.0);
  for (const Cloud::Ptr& cloud : clouds (solid, 5000)) {
    const Drawn drawn = draw (cloud);
    ASSERT_EQ (drawn.ridges.size(), 1U);
    EXPECT_TRUE (drawn.valleys.empty());
    EXPECT_EQ (drawn.ridges[0].polylines.size(), 12U);
    EXPECT_EQ (corners (drawn.ridges[0]).size(), 8U);
    EXPECT_NEAR (drawn.ridges[0].turning_angle, 90.0, 2.0);
    expectExact (drawn, solid, oracle::meanSpacing (*cloud));
    for (const index_t corner : corners (drawn.ridges[0])) {
      const auto p = (*drawn.cloud)[corner].getVector3fMap();
      EXPECT_LT ((p.cwiseAbs() - Eigen::Vector3f::Constant (0.5F)).norm(),
                 0.4F * oracle::meanSpacing (*cloud));
      EXPECT_EQ (drawn.labels[corner].label, LABEL_RIDGE);
    }
  }
}

TEST (CreaseLines, DodecahedronHasTwentyCorners)
{
  const oracle::SharpSolid solid = oracle::dodecahedron();
  for (const Cloud::Ptr& cloud : clouds (solid, 10000)) {
    const Drawn drawn = draw (cloud);
    ASSERT_EQ (drawn.ridges.size(), 1U);
    EXPECT_EQ (drawn.ridges[0].polylines.size(), 30U);
    EXPECT_EQ (corners (drawn.ridges[0]).size(), 20U);
    expectExact (drawn, solid, oracle::meanSpacing (*cloud));
  }
}

TEST (CreaseLines, RimsOfABarAreClosed)
{
  const oracle::SharpSolid solid = oracle::roundBar (0.5, 0.8);
  for (const Cloud::Ptr& cloud : clouds (solid, 6000)) {
    const Drawn drawn = draw (cloud);
    ASSERT_EQ (drawn.ridges.size(), 2U);
    EXPECT_TRUE (drawn.ridges[0].closed);
    EXPECT_TRUE (drawn.ridges[1].closed);
    expectExact (drawn, solid, oracle::meanSpacing (*cloud));
  }
}

TEST (CreaseLines, ValleyOfABracketReachesItsCorners)
{
  const oracle::SharpSolid solid = oracle::lBracket (1.0, 0.8, 0.25);
  for (const Cloud::Ptr& cloud : clouds (solid, 10000)) {
    const Drawn drawn = draw (cloud);
    ASSERT_EQ (drawn.ridges.size(), 1U);
    ASSERT_EQ (drawn.valleys.size(), 1U);
    ASSERT_EQ (drawn.valleys[0].polylines.size(), 1U);
    // Two of the twelve are no ends of ridges, as but two of these meet there.
    EXPECT_EQ (corners (drawn.ridges[0]).size(), 10U);
    std::set<index_t> on_ridges;
    for (const auto& polyline : drawn.ridges[0].polylines)
      on_ridges.insert (polyline.begin(), polyline.end());
    for (const index_t end : corners (drawn.valleys[0]))
      EXPECT_EQ (on_ridges.count (end), 1U);
    for (const LineEnd end : drawn.valleys[0].ends[0])
      EXPECT_EQ (end, LineEnd::JUNCTION);
    expectExact (drawn, solid, oracle::meanSpacing (*cloud));
  }
}

TEST (CreaseLines, BothFacesOfAThinPlateAreFramed)
{
  const double thickness = 0.045;
  const oracle::SharpSolid solid = oracle::box (1.0, 1.0, thickness);
  for (const Cloud::Ptr& cloud : clouds (solid, 10000)) {
    ASSERT_NEAR (thickness / oracle::meanSpacing (*cloud), 3.0, 0.4);
    const Drawn drawn = draw (cloud);
    ASSERT_FALSE (drawn.ridges.empty());
    EXPECT_TRUE (drawn.valleys.empty());
    expectExact (drawn, solid, oracle::meanSpacing (*cloud));
  }
}

TEST (CreaseLines, RimsOfHolesOfTwoSpacingsAreFound)
{
  constexpr double RADIUS = 2.0;
  constexpr double APART = 10.0;
  constexpr int HOLES = 4;
  std::mt19937 random (5);
  std::uniform_real_distribution<double> jitter (-0.2, 0.2);
  const auto cloud = std::make_shared<Cloud>();
  const auto add = [&] (const Eigen::Vector3d& p, const Eigen::Vector3d& n) {
    pcl::PointNormal point;
    point.getVector3fMap() = p.cast<float>();
    point.getNormalVector3fMap() = n.cast<float>();
    cloud->push_back (point);
  };
  const auto centre = [] (int i) {
    return Eigen::Vector3d (i % 2 == 0 ? 0.0 : APART, i < 2 ? 0.0 : APART, 0.0);
  };
  for (int row = -8; row <= 18; ++row)
    for (int column = -8; column <= 18; ++column) {
      const Eigen::Vector3d p (column + jitter (random), row + jitter (random), 0.0);
      bool outside = true;
      for (int i = 0; i < HOLES; ++i)
        outside = outside && (p - centre (i)).norm() > RADIUS + 0.3;
      if (outside)
        add (p, Eigen::Vector3d::UnitZ());
    }
  for (int i = 0; i < HOLES; ++i)
    for (int level = 0; level < 5; ++level)
      for (int k = 0; k < 12; ++k) {
        const double angle = (k + 0.5 * level + jitter (random)) * M_PI / 6.0;
        const Eigen::Vector3d out (std::cos (angle), std::sin (angle), 0.0);
        // The first are on the rim, and of the face.
        const Eigen::Vector3d down = -level * Eigen::Vector3d::UnitZ();
        add (centre (i) + RADIUS * out + down,
             level == 0 ? Eigen::Vector3d::UnitZ() : Eigen::Vector3d (-out));
      }
  const Drawn drawn = draw (cloud);
  EXPECT_TRUE (drawn.valleys.empty());
  double length = 0.0;
  int vertices = 0;
  int far = 0;
  for (const CrestLine& line : drawn.ridges)
    for (const auto& polyline : line.polylines)
      for (std::size_t j = 0; j < polyline.size(); ++j) {
        const Eigen::Vector3d p =
            (*drawn.cloud)[polyline[j]].getVector3fMap().cast<double>();
        double nearest = APART;
        for (int i = 0; i < HOLES; ++i)
          nearest = std::min (nearest, std::abs ((p - centre (i)).norm() - RADIUS));
        ++vertices;
        far += nearest > 0.6 || std::abs (p.z()) > 0.6 ? 1 : 0;
        if (j > 0)
          length += ((*drawn.cloud)[polyline[j]].getVector3fMap() -
                     (*drawn.cloud)[polyline[j - 1]].getVector3fMap())
                        .norm();
      }
  EXPECT_LE (20 * far, vertices);
  EXPECT_GT (length, 0.8 * HOLES * 2.0 * M_PI * RADIUS);
  EXPECT_LT (length, 1.1 * HOLES * 2.0 * M_PI * RADIUS);
}

TEST (CreaseLines, AngleAppliesToThem)
{
  const Cloud::Ptr cloud =
      oracle::sample (oracle::wedge (60.0, CrestType::RIDGE), 3000);
  EXPECT_EQ (draw (cloud, 50.0).ridges.size(), 1U);
  EXPECT_TRUE (draw (cloud, 75.0).ridges.empty());
}
