// SPDX-License-Identifier: BSD-3-Clause
// Lines smoothed against the curves that their points were scattered around.
#include <gtest/gtest.h>

#include "lines/line_smoothing.h"

#include <cmath>

using namespace pcl::crest;

namespace {

/** \brief Points on lines of spacing 1, with the profiles and graph that smoothing asks
 * for the radius and the spacing of each.
 */
struct Net {
  OrientedPoints points;
  std::vector<CrestProfile> profiles;
  SurfaceGraph graph;
  std::vector<CrestLine> lines;

  index_t
  add (const Eigen::Vector3f& p)
  {
    points.positions.push_back (p);
    CrestProfile profile;
    profile.radius = 8.0F;
    profiles.push_back (profile);
    graph.spacing.push_back (1.0F);
    return static_cast<index_t> (points.size() - 1);
  }

  /** \brief A circle of a circumference in the plane z = 0 whose points are off to both
   * sides in turn; its first point is at (radius, 0), from where it goes on.
   */
  std::vector<index_t>
  addCircle (int circumference, float off, index_t first)
  {
    const float radius = radiusOf (circumference);
    std::vector<index_t> loop{first};
    for (int i = 1; i < circumference; ++i) {
      const float angle =
          2.0F * static_cast<float> (M_PI * i) / static_cast<float> (circumference);
      const float r = radius + (i % 2 == 0 ? off : -off);
      loop.push_back (add ({r * std::cos (angle), r * std::sin (angle), 0.0F}));
    }
    loop.push_back (first);
    return loop;
  }

  static float
  radiusOf (int circumference)
  {
    return static_cast<float> (circumference / (2.0 * M_PI));
  }

  void
  smooth (unsigned threads = 1)
  {
    const std::vector<LinePlaces> places =
        smoothLines (lines, profiles, graph, points.positions, threads);
    for (std::size_t i = 0; i < lines.size(); ++i)
      movePoints (lines[i], places[i], points.positions);
  }
};

CrestLine
lineOf (const std::vector<std::vector<index_t>>& polylines, bool closed)
{
  CrestLine line;
  line.polylines = polylines;
  line.closed = closed;
  return line;
}

constexpr int CIRCUMFERENCE = 200;
constexpr float OFF = 0.4F;

/** \brief A net of one closed circle. */
Net
circle ()
{
  Net net;
  const index_t first = net.add ({Net::radiusOf (CIRCUMFERENCE) + OFF, 0.0F, 0.0F});
  net.lines = {lineOf ({net.addCircle (CIRCUMFERENCE, OFF, first)}, true)};
  return net;
}

} // namespace

TEST (LineSmoothing, PutsTheZigzagOfALoopOnItsCircle)
{
  Net net = circle();
  net.smooth();
  for (const Eigen::Vector3f& p : net.points.positions)
    EXPECT_NEAR (p.norm(), Net::radiusOf (CIRCUMFERENCE), 0.05);
}

TEST (LineSmoothing, TakesNoPointFartherThanTwoSpacings)
{
  Net net = circle();
  for (CrestProfile& profile : net.profiles)
    profile.radius = 16.0F;
  const std::size_t stray = net.points.size() / 2;
  net.points.positions[stray] *= 1.0F + 5.0F / Net::radiusOf (CIRCUMFERENCE);
  const Eigen::Vector3f before = net.points.positions[stray];
  net.smooth();
  EXPECT_NEAR ((net.points.positions[stray] - before).norm(), 2.0, 1e-4);
}

TEST (LineSmoothing, TurnsNoLineBack)
{
  // Of a straight line two points stand in each other's place, with fits too narrow to
  // tell; of another one, sharp, they stay.
  for (const bool sharp : {false, true}) {
    Net net;
    std::vector<index_t> polyline;
    for (const float x : {0.0F, 1.0F, 2.0F, 3.4F, 2.9F, 5.0F, 6.0F, 7.0F}) {
      polyline.push_back (net.add ({x, 0.0F, 0.0F}));
      net.profiles.back().radius = 1.0F;
      net.profiles.back().sharp = sharp;
    }
    net.lines = {lineOf ({polyline}, false)};
    net.smooth();
    const std::vector<Eigen::Vector3f>& p = net.points.positions;
    int back = 0;
    for (std::size_t i = 1; i < p.size(); ++i)
      back += p[i].x() < p[i - 1].x() ? 1 : 0;
    EXPECT_EQ (back, sharp ? 1 : 0);
    EXPECT_EQ (p.front().x(), 0.0F);
    EXPECT_EQ (p.back().x(), 7.0F);
  }
}

TEST (LineSmoothing, LeavesSharpPointsAndEnds)
{
  Net net;
  std::vector<index_t> polyline;
  for (int i = 0; i < 30; ++i)
    polyline.push_back (
        net.add ({static_cast<float> (i), i % 2 == 0 ? OFF : -OFF, 0.0F}));
  net.profiles[15].sharp = true;
  net.lines = {lineOf ({polyline}, false)};
  const std::vector<Eigen::Vector3f> before = net.points.positions;
  net.smooth();
  for (const std::size_t i : {0U, 15U, 29U})
    EXPECT_EQ (net.points.positions[i], before[i]);
  for (const std::size_t i : {10U, 14U, 16U, 20U})
    EXPECT_LT (std::abs (net.points.positions[i].y()), 0.5 * OFF);
}

// A loop on a stem: both have to end where they met, whichever comes first.
TEST (LineSmoothing, LeavesTheJunctionOfALoopAndItsStem)
{
  for (const bool stem_first : {true, false}) {
    Net net;
    const Eigen::Vector3f at (Net::radiusOf (CIRCUMFERENCE) + OFF, 0.0F, 0.0F);
    const index_t junction = net.add (at);
    const auto loop = net.addCircle (CIRCUMFERENCE, OFF, junction);
    std::vector<index_t> stem{junction};
    for (int i = 1; i < 30; ++i)
      stem.push_back (
          net.add (at + Eigen::Vector3f (static_cast<float> (i), 0.0F, OFF * (i % 2))));
    net.lines = {stem_first ? lineOf ({stem, loop}, false)
                            : lineOf ({loop, stem}, false)};
    net.smooth();
    EXPECT_EQ (net.points.positions[junction], at);
    // Nor is there a kink beside it.
    for (const index_t beside : {loop[1], loop[CIRCUMFERENCE - 1], stem[1]})
      EXPECT_LT ((net.points.positions[beside] - at).norm(), 1.6);
  }
}

TEST (LineSmoothing, IsTheSameForAnyNumberOfThreads)
{
  Net one = circle();
  const index_t other = one.add ({100.0F, 0.0F, 0.0F});
  one.lines.push_back (lineOf ({one.addCircle (61, OFF, other)}, true));
  Net two = one;
  one.smooth (1);
  two.smooth (2);
  EXPECT_EQ (one.points.positions, two.points.positions);
}
