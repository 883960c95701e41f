// SPDX-License-Identifier: BSD-3-Clause
// The scores of the benchmark on lines whose scores are known.
#include <gtest/gtest.h>

#include "sharp_edges.h"
#include "support/benchmark_surfaces.h"

#include <cmath>

using namespace pcl::crest;

namespace {

/** \brief A line along x from 0 to `length` in unit steps, at the given y. */
accuracy::TimedRun
straightLine (double length, double y, CrestType type)
{
  auto cloud = pcl::make_shared<pcl::PointCloud<pcl::PointNormal>>();
  CrestLine line;
  line.type = type;
  line.polylines.emplace_back();
  for (int i = 0; i <= static_cast<int> (length); ++i) {
    pcl::PointNormal point;
    point.x = static_cast<float> (i);
    point.y = static_cast<float> (y);
    line.polylines[0].push_back (i);
    cloud->push_back (point);
  }
  line.ends = {{LineEnd::FREE, LineEnd::FREE}};
  accuracy::TimedRun run;
  run.lines = {line};
  run.line_cloud = cloud;
  return run;
}

std::vector<oracle::TruthSegment>
truthAlongX (double length, CrestType type)
{
  std::vector<oracle::TruthSegment> truth;
  for (double x = 0.0; x < length - 0.05; x += 0.1)
    truth.push_back ({{x, 0.0, 0.0}, {x + 0.1, 0.0, 0.0}, type, 1.0, 1.0});
  return truth;
}

} // namespace

TEST (Scores, OfALineAtAKnownOffset)
{
  // Half of what is drawn lies beside the truth, half a spacing off; of the truth,
  // which is half as long as the line, everything is found.
  const accuracy::TimedRun run = straightLine (40.0, 0.5, CrestType::RIDGE);
  const accuracy::TypeScore score =
      accuracy::scoreType (run.lines,
                           *run.line_cloud,
                           truthAlongX (20.0, CrestType::RIDGE),
                           CrestType::RIDGE,
                           1.0,
                           1.5);
  // Beyond its end, too, the truth is near for 1.5 spacings.
  EXPECT_NEAR (score.precision, (20.0 + std::sqrt (1.5 * 1.5 - 0.25)) / 40.0, 0.01);
  EXPECT_NEAR (score.recall, 1.0, 1e-9);
  EXPECT_NEAR (score.error, 0.5, 0.05);
  EXPECT_NEAR (score.drawn_length, 40.0, 1e-6);
  EXPECT_NEAR (score.salient_length, 20.0, 1e-6);
  EXPECT_EQ (score.lines, 1U);
}

TEST (Scores, AreInSpacings)
{
  const accuracy::TimedRun run = straightLine (40.0, 1.0, CrestType::RIDGE);
  const auto truth = truthAlongX (40.0, CrestType::RIDGE);
  const auto scoreAt = [&] (double spacing) {
    return accuracy::scoreType (
        run.lines, *run.line_cloud, truth, CrestType::RIDGE, spacing, 1.5);
  };
  EXPECT_NEAR (scoreAt (2.0).error, 0.5, 0.05);
  EXPECT_NEAR (scoreAt (2.0).drawn_length, 20.0, 1e-6);
  EXPECT_EQ (scoreAt (0.5).precision, 0.0);
  EXPECT_EQ (scoreAt (0.5).recall, 0.0);
}

TEST (Scores, OfTheOtherTypeDoNotCount)
{
  const accuracy::TimedRun run = straightLine (40.0, 0.0, CrestType::VALLEY);
  const auto truth = truthAlongX (40.0, CrestType::RIDGE);
  const auto scoreOf = [&] (CrestType type) {
    return accuracy::scoreType (run.lines, *run.line_cloud, truth, type, 1.0, 1.5);
  };
  EXPECT_EQ (scoreOf (CrestType::RIDGE).recall, 0.0);
  EXPECT_TRUE (std::isnan (scoreOf (CrestType::RIDGE).precision));
  EXPECT_EQ (scoreOf (CrestType::VALLEY).precision, 0.0);
  EXPECT_TRUE (std::isnan (scoreOf (CrestType::VALLEY).recall));
}

TEST (SharpScores, CountTheCornersWhereLinesMeet)
{
  // Three edges meet in the origin and three more at the other end of the first.
  constexpr auto RIDGE = CrestType::RIDGE;
  const Eigen::Vector3d o (0.0, 0.0, 0.0);
  const Eigen::Vector3d p (20.0, 0.0, 0.0);
  const std::vector<accuracy::SharpEdge> edges{{o, p, RIDGE, 90.0},
                                               {o, {0.0, 20.0, 0.0}, RIDGE, 90.0},
                                               {o, {0.0, 0.0, 20.0}, RIDGE, 90.0},
                                               {p, {20.0, 20.0, 0.0}, RIDGE, 90.0},
                                               {p, {20.0, 0.0, 20.0}, RIDGE, 90.0}};
  ASSERT_EQ (accuracy::cornersOf (edges).size(), 2U);
  accuracy::TimedRun run = straightLine (20.0, 0.0, RIDGE);
  EXPECT_EQ (accuracy::scoreSharp (run, edges, 1.0).joined, 0U);
  run.lines[0].ends[0][0] = LineEnd::JUNCTION;
  const accuracy::SharpScore joined = accuracy::scoreSharp (run, edges, 1.0);
  EXPECT_EQ (joined.corners, 2U);
  EXPECT_EQ (joined.joined, 1U);
  EXPECT_NEAR (joined.types[0].precision, 1.0, 1e-9);
  EXPECT_NEAR (joined.types[0].recall, 0.2 + 4 * 0.02, 0.03);
}

TEST (Truth, OfARingIsOneCircleOnItsRadius)
{
  double length = 0.0;
  for (const oracle::TruthSegment& s :
       oracle::trueCrestLines (oracle::ringRidge(), 200))
    if (s.type == CrestType::RIDGE) {
      EXPECT_NEAR (s.a.head<2>().norm(), 0.6, 1e-3);
      length += (s.b - s.a).norm();
    }
  EXPECT_NEAR (length, 2.0 * 3.14159265 * 0.6, 0.02);
}

TEST (Truth, CountsTheSeamOfAClosedSurfaceOnce)
{
  // One of the knot's two ridges runs along the seam of its parameters.
  double length = 0.0;
  for (const oracle::TruthSegment& s :
       oracle::trueCrestLines (oracle::ellipticKnot(), 200))
    length += (s.b - s.a).norm();
  const oracle::AnalyticSurface knot = oracle::ellipticKnot();
  double expected = 0.0;
  constexpr int STEPS = 2000;
  for (const double v : {0.0, 3.14159265358979})
    for (int i = 0; i < STEPS; ++i) {
      const auto at = [&] (int step) {
        return knot.position (knot.u_min + (knot.u_max - knot.u_min) * step / STEPS, v);
      };
      expected += (at (i + 1) - at (i)).norm();
    }
  EXPECT_NEAR (length, expected, 0.02 * expected);
}
