// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "support/analytic_surface.h"
#include "support/kd_tree.h"
#include "support/stage_inputs.h"
#include "surface/neighbor_search.h"

#include <cmath>
#include <limits>
#include <random>
#include <set>

using namespace pcl::crest;

namespace {

Parameters
withNeighbors (int k, int points_per_quadrant = 2)
{
  Parameters parameters;
  parameters.k = k;
  parameters.points_per_quadrant = points_per_quadrant;
  return parameters;
}

/** \brief Section 4.1 written down once more, plainly: for each interval look at all
 * points and keep those nearest. Reference axis: the nearest point, of equidistant ones
 * that whose normal differs most.
 */
std::set<index_t>
filterPlainly (const OrientedPoints& points,
               index_t p,
               const std::vector<index_t>& found,
               int points_per_quadrant)
{
  const Eigen::Vector3d n = points.normals[p].cast<double>();
  std::vector<index_t> candidates;
  for (const index_t q : found)
    if (q != p && points.normals[q].cast<double>().dot (n) > 0.0)
      candidates.push_back (q);
  const auto edge = [&] (index_t q) -> Eigen::Vector3d {
    return (points.positions[q] - points.positions[p]).cast<double>();
  };
  const auto squared = [&] (index_t q) { return edge (q).squaredNorm(); };
  double least = std::numeric_limits<double>::infinity();
  for (const index_t q : candidates)
    least = std::min (least, squared (q));
  index_t nearest = -1;
  const auto cosine = [&] (index_t q) {
    return points.normals[q].cast<double>().dot (n);
  };
  for (const index_t q : candidates)
    if (squared (q) <= least * (1.0 + EQUIDISTANT) &&
        (nearest < 0 || cosine (q) < cosine (nearest)))
      nearest = q;
  const Eigen::Vector3d x = (edge (nearest) - edge (nearest).dot (n) * n).normalized();
  const double width = M_PI / 2.0 / points_per_quadrant;
  std::set<index_t> chosen;
  for (int interval = 0; interval < 4 * points_per_quadrant; ++interval) {
    double best = std::numeric_limits<double>::infinity();
    std::vector<index_t> inside;
    const Eigen::Vector3d axis = Eigen::AngleAxisd (interval * width, n) * x;
    for (const index_t q : candidates) {
      const Eigen::Vector3d projected = edge (q) - edge (q).dot (n) * n;
      const double angle = std::acos (
          std::max (-1.0, std::min (1.0, projected.normalized().dot (axis))));
      if (angle < width / 2.0) {
        inside.push_back (q);
        best = std::min (best, squared (q));
      }
    }
    for (const index_t q : inside)
      if (squared (q) <= best * (1.0 + EQUIDISTANT))
        chosen.insert (q);
  }
  return chosen;
}

std::set<index_t>
starOf (const SurfaceGraph& graph, index_t p)
{
  return {graph.star (p).begin(), graph.star (p).end()};
}

pcl::PointCloud<pcl::PointNormal>
lattice (int side)
{
  pcl::PointCloud<pcl::PointNormal> cloud;
  for (int i = 0; i < side; ++i)
    for (int j = 0; j < side; ++j) {
      pcl::PointNormal point;
      point.x = static_cast<float> (i);
      point.y = static_cast<float> (j);
      point.normal_z = 1.0F;
      cloud.push_back (point);
    }
  return cloud;
}

} // namespace

class QuadrantFilter : public testing::TestWithParam<int> {};

TEST_P (QuadrantFilter, EqualsThePlainFilterMadeSymmetric)
{
  const int points_per_quadrant = GetParam();
  const auto cloud = oracle::sample (oracle::bumpySphere(), 1500);
  const OrientedPoints points = oracle::pack (*cloud);
  const NeighborSearch search = oracle::bruteForceSearch (points, 24);
  const SurfaceGraph graph =
      buildSurfaceGraph (points, search, withNeighbors (24, points_per_quadrant));

  std::vector<std::set<index_t>> expected (points.size());
  std::vector<index_t> found;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto p = static_cast<index_t> (i);
    search (p, found);
    for (const index_t q : filterPlainly (points, p, found, points_per_quadrant)) {
      expected[p].insert (q);
      expected[q].insert (p);
    }
  }
  for (std::size_t i = 0; i < points.size(); ++i)
    ASSERT_EQ (starOf (graph, static_cast<index_t> (i)), expected[i]) << i;
}

INSTANTIATE_TEST_SUITE_P (PointsPerQuadrant,
                          QuadrantFilter,
                          testing::Values (1, 2, 3, 16));

TEST (SurfaceGraph, IsSymmetricSortedAndWithoutDuplicates)
{
  const auto cloud = oracle::sample (oracle::ellipticTorus(), 3000);
  const OrientedPoints points = oracle::pack (*cloud);
  const Parameters parameters;
  const SurfaceGraph graph =
      buildSurfaceGraph (points, oracle::kdTreeSearch (points, parameters), parameters);
  ASSERT_EQ (graph.size(), points.size());
  for (index_t p = 0; p < static_cast<index_t> (graph.size()); ++p) {
    const Star star = graph.star (p);
    EXPECT_TRUE (std::is_sorted (star.begin(), star.end()));
    EXPECT_EQ (starOf (graph, p).size(), star.size());
    EXPECT_EQ (starOf (graph, p).count (p), 0U);
    for (const index_t q : star)
      EXPECT_EQ (starOf (graph, q).count (p), 1U);
  }
}

TEST (SurfaceGraph, PclsTreeFindsWhatBruteForceFinds)
{
  const auto cloud = oracle::sample (oracle::wavyRidge(), 2000);
  const OrientedPoints points = oracle::pack (*cloud);
  const Parameters parameters = withNeighbors (16);
  const SurfaceGraph by_tree =
      buildSurfaceGraph (points, oracle::kdTreeSearch (points, parameters), parameters);
  const SurfaceGraph by_force =
      buildSurfaceGraph (points, oracle::bruteForceSearch (points, 16), parameters);
  EXPECT_EQ (by_tree.offsets, by_force.offsets);
  EXPECT_EQ (by_tree.neighbors, by_force.neighbors);
}

TEST (SurfaceGraph, IsTheSameFarAway)
{
  // The plane is narrow, but its height is near the largest float.
  const auto graphAt = [] (float height) {
    auto cloud = *oracle::sample (oracle::plane(), 1000);
    for (pcl::PointNormal& point : cloud)
      point.z = height;
    const OrientedPoints points = oracle::pack (cloud);
    const Parameters parameters = withNeighbors (24);
    SurfaceGraph by_leaves =
        buildSurfaceGraph (points, treeOver (points.positions, 1), parameters);
    const SurfaceGraph by_tree = buildSurfaceGraph (
        points, oracle::kdTreeSearch (points, parameters), parameters);
    EXPECT_EQ (by_leaves.neighbors, by_tree.neighbors) << height;
    return by_leaves;
  };
  const SurfaceGraph near = graphAt (0.0F);
  const SurfaceGraph far = graphAt (3e38F);
  EXPECT_GT (near.neighbors.size(), 4000U);
  EXPECT_EQ (near.neighbors, far.neighbors);
  EXPECT_EQ (near.spacing, far.spacing);
}

TEST (SurfaceGraph, LatticePointsAreJoinedWithTheEightAround)
{
  const OrientedPoints points = oracle::pack (lattice (9));
  const Parameters parameters = withNeighbors (9);
  const SurfaceGraph graph =
      buildSurfaceGraph (points, oracle::kdTreeSearch (points, parameters), parameters);
  const index_t center = points.packed_index[4 * 9 + 4];
  std::set<index_t> around;
  for (const int i : {3, 4, 5})
    for (const int j : {3, 4, 5})
      if (i != 4 || j != 4)
        around.insert (points.packed_index[i * 9 + j]);
  EXPECT_EQ (starOf (graph, center), around);
}

TEST (SurfaceGraph, EquidistantPointsOfOneIntervalAreAllKept)
{
  // One point ahead fixes the axis; two more, equally far, share the interval at 45
  // degrees but for what rounding leaves; a third one just behind does not count.
  const auto direction = [] (double degrees, float length) {
    const double a = degrees * M_PI / 180.0;
    return Eigen::Vector3f (length * static_cast<float> (std::cos (a)),
                            length * static_cast<float> (std::sin (a)),
                            0.0F);
  };
  const OrientedPoints points = oracle::pointsAt ({Eigen::Vector3f::Zero(),
                                                   direction (0, 1.0F),
                                                   direction (35, 2.0001F),
                                                   direction (55, 2.0F),
                                                   direction (45, 2.01F)});
  std::vector<index_t> everything{0, 1, 2, 3, 4};
  const NeighborSearch search = [&] (index_t p, std::vector<index_t>& found) {
    found = p == 0 ? everything : std::vector<index_t>{p};
  };
  const SurfaceGraph graph = buildSurfaceGraph (points, search, withNeighbors (5));
  EXPECT_EQ (starOf (graph, 0), (std::set<index_t>{1, 2, 3}));
}

TEST (SurfaceGraph, SheetsBackToBackAreNotJoined)
{
  pcl::PointCloud<pcl::PointNormal> sheets = lattice (12);
  for (const pcl::PointNormal& top : lattice (12)) {
    pcl::PointNormal bottom = top;
    bottom.z = -0.3F;
    bottom.normal_z = -1.0F;
    sheets.push_back (bottom);
  }
  const OrientedPoints points = oracle::pack (sheets);
  const Parameters parameters = withNeighbors (24);
  const SurfaceGraph graph =
      buildSurfaceGraph (points, oracle::kdTreeSearch (points, parameters), parameters);
  for (index_t p = 0; p < static_cast<index_t> (graph.size()); ++p)
    for (const index_t q : graph.star (p))
      EXPECT_EQ (points.positions[p].z(), points.positions[q].z());
}

class NormalJump : public testing::Test {
protected:
  /** \brief The neighbours of the first point where those around it have normals turned
   * by 0, 45, 90 and 100 degrees, with a limit to the angle.
   */
  static std::set<index_t>
  starWithLimit (double degrees)
  {
    OrientedPoints points =
        oracle::pointsAt ({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}});
    points.normals[2] = Eigen::Vector3f (0, 1, 1).normalized();
    points.normals[3] = Eigen::Vector3f::UnitX();
    points.normals[4] = Eigen::Vector3f (0, 1, -0.176F).normalized();
    const NeighborSearch search = [] (index_t p, std::vector<index_t>& found) {
      found = p == 0 ? std::vector<index_t>{0, 1, 2, 3, 4} : std::vector<index_t>{p};
    };
    Parameters parameters = withNeighbors (5);
    parameters.max_normal_angle = degrees;
    return starOf (buildSurfaceGraph (points, search, parameters), 0);
  }
};

TEST_F (NormalJump, RightAnglesAreNone)
{
  EXPECT_EQ (starWithLimit (90.0), (std::set<index_t>{1, 2, 3}));
}

TEST_F (NormalJump, LimitIsTheParameter)
{
  EXPECT_EQ (starWithLimit (30.0), (std::set<index_t>{1}));
  EXPECT_EQ (starWithLimit (60.0), (std::set<index_t>{1, 2}));
  EXPECT_EQ (starWithLimit (180.0), (std::set<index_t>{1, 2, 3, 4}));
}

TEST (SurfaceGraph, TurnsWithTheCloudAndFlipsWithItsNormals)
{
  const auto cloud = oracle::sample (oracle::wavyRidge(), 3000);
  const Eigen::Quaterniond turn = Eigen::Quaterniond (0.3, -0.5, 0.2, 0.8).normalized();
  pcl::PointCloud<pcl::PointNormal> turned = *cloud;
  pcl::PointCloud<pcl::PointNormal> flipped = *cloud;
  for (std::size_t i = 0; i < cloud->size(); ++i) {
    turned[i].getVector3fMap() =
        (turn * (*cloud)[i].getVector3fMap().cast<double>()).cast<float>();
    turned[i].getNormalVector3fMap() =
        (turn * (*cloud)[i].getNormalVector3fMap().cast<double>()).cast<float>();
    flipped[i].getNormalVector3fMap() *= -1.0F;
  }
  const Parameters parameters;
  const auto edgesOf = [&] (const pcl::PointCloud<pcl::PointNormal>& input) {
    const OrientedPoints points = oracle::pack (input);
    const SurfaceGraph graph = buildSurfaceGraph (
        points, oracle::kdTreeSearch (points, parameters), parameters);
    std::set<std::pair<index_t, index_t>> edges;
    for (index_t p = 0; p < static_cast<index_t> (graph.size()); ++p)
      for (const index_t q : graph.star (p))
        edges.emplace (points.cloud_index[p], points.cloud_index[q]);
    return edges;
  };
  const auto edges = edgesOf (*cloud);
  EXPECT_EQ (edges, edgesOf (flipped));
  const auto turned_edges = edgesOf (turned);
  std::vector<std::pair<index_t, index_t>> different;
  std::set_symmetric_difference (edges.begin(),
                                 edges.end(),
                                 turned_edges.begin(),
                                 turned_edges.end(),
                                 std::back_inserter (different));
  // Rounding decides where a neighbour lies on the border of two intervals.
  EXPECT_LE (different.size(), edges.size() / 2000);
}

TEST (SurfaceGraph, BoundaryIsWhereTheSurfaceEnds)
{
  const auto open = oracle::sample (oracle::plane(), 4000);
  const OrientedPoints points = oracle::pack (*open);
  const Parameters parameters;
  const SurfaceGraph graph =
      buildSurfaceGraph (points, oracle::kdTreeSearch (points, parameters), parameters);
  int at_border = 0;
  int border_found = 0;
  int inside = 0;
  int inside_found = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double from_border =
        1.0 - points.positions[i].head<2>().cwiseAbs().maxCoeff();
    if (from_border < 0.1 * graph.mean_spacing) {
      ++at_border;
      border_found += graph.boundary[i];
    }
    else if (from_border > 3.0 * graph.mean_spacing) {
      ++inside;
      inside_found += graph.boundary[i];
    }
  }
  ASSERT_GT (at_border, 10);
  ASSERT_GT (inside, 3000);
  EXPECT_GE (border_found, 0.97 * at_border);
  EXPECT_LE (inside_found, 0.01 * inside);
}

TEST (SurfaceGraph, MeanSpacingIsThatOfTheSixNearest)
{
  const auto cloud = oracle::sample (oracle::sphere (1.0), 2000);
  const OrientedPoints points = oracle::pack (*cloud);
  const Parameters parameters;
  const SurfaceGraph graph =
      buildSurfaceGraph (points, oracle::kdTreeSearch (points, parameters), parameters);
  EXPECT_NEAR (graph.mean_spacing / oracle::meanSpacing (*cloud), 1.0, 1e-5);
}

TEST (SurfaceGraph, StraightAboveThePointIsNoNeighbour)
{
  const OrientedPoints points =
      oracle::pointsAt ({{0, 0, 0}, {0, 0, 0.5F}, {1, 0, 0}, {0, 1, 0}});
  const NeighborSearch search = [] (index_t p, std::vector<index_t>& found) {
    found = p == 0 ? std::vector<index_t>{0, 1, 2, 3} : std::vector<index_t>{p};
  };
  const SurfaceGraph graph = buildSurfaceGraph (points, search, withNeighbors (4));
  EXPECT_EQ (starOf (graph, 0), (std::set<index_t>{2, 3}));
}

TEST (SurfaceGraph, CandidatesFoundTwiceCountOnce)
{
  const OrientedPoints points =
      oracle::pointsAt ({{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {-3, 0, 0}});
  const NeighborSearch search = [] (index_t, std::vector<index_t>& found) {
    found = {0, 1, 1, 2, 2, 2, 3, 3};
  };
  const SurfaceGraph graph = buildSurfaceGraph (points, search, withNeighbors (8));
  EXPECT_EQ (graph.star (0).size(), 3U);
}

TEST (SurfaceGraph, EmptyQuadrantIsSeenWhereverItBegins)
{
  // Neighbours every 45 degrees but for two in a row, which leave a gap of 135 degrees.
  for (int first_missing = 1; first_missing < 7; ++first_missing) {
    std::vector<Eigen::Vector3f> positions{Eigen::Vector3f::Zero()};
    for (int i = 0; i < 8; ++i)
      if (i != first_missing && i != first_missing + 1) {
        const double a = i * M_PI / 4.0;
        // The first is the nearest and so the axis.
        const double r = i == 0 ? 1.0 : 1.1;
        positions.emplace_back (static_cast<float> (r * std::cos (a)),
                                static_cast<float> (r * std::sin (a)),
                                0.0F);
      }
    const OrientedPoints points = oracle::pointsAt (positions);
    const NeighborSearch search = [&] (index_t, std::vector<index_t>& found) {
      found.resize (positions.size());
      std::iota (found.begin(), found.end(), 0);
    };
    const SurfaceGraph graph = buildSurfaceGraph (points, search, withNeighbors (8));
    EXPECT_EQ (graph.boundary[0], 1) << first_missing;
  }
  // The gap around the direction opposite to the axis, and one across interval 0.
  const auto boundary = [] (const std::vector<double>& degrees) {
    std::vector<Eigen::Vector3f> positions{Eigen::Vector3f::Zero()};
    float r = 1.0F;
    for (const double d : degrees) {
      const double a = d * M_PI / 180.0;
      positions.emplace_back (r * static_cast<float> (std::cos (a)),
                              r * static_cast<float> (std::sin (a)),
                              0.0F);
      r = 1.1F;
    }
    const OrientedPoints points = oracle::pointsAt (positions);
    const NeighborSearch search = [&] (index_t, std::vector<index_t>& found) {
      found.resize (positions.size());
      std::iota (found.begin(), found.end(), 0);
    };
    return buildSurfaceGraph (points, search, withNeighbors (8)).boundary[0];
  };
  EXPECT_EQ (boundary ({0, 45, 90, 135, 180, 225, 270, 315}), 0);
  EXPECT_EQ (boundary ({0, 45, 90, 135, 180, 225, 270}), 0);
  EXPECT_EQ (boundary ({0, 45, 90, 135, 180, 225}), 1);
}

// More edges than 32 bits count, without the edges.
TEST (StarOffsets, AreThoseEnteredBeyond32Bits)
{
  const std::vector<std::size_t> entered{0,
                                         7,
                                         0xFFFFFFFF,
                                         0x100000000,
                                         0x100000000,
                                         0x1FFFFFFFF,
                                         0x280000000,
                                         0x300000005};
  StarOffsets offsets;
  for (const std::size_t offset : entered)
    offsets.push_back (offset);
  ASSERT_EQ (offsets.size(), entered.size());
  for (std::size_t i = 0; i < entered.size(); ++i)
    EXPECT_EQ (offsets[i], entered[i]);
}
