// SPDX-License-Identifier: BSD-3-Clause
// The auto preset with nothing but its defaults: against exact crest lines, with noise
// and estimated normals; on surfaces that have none; and what must not change it.
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "crests/crest_profile.h"
#include "support/benchmark_surfaces.h"
#include "support/crest_truth.h"
#include "support/extraction.h"
#include "support/flipped_labels.h"
#include "support/noisy_cloud.h"
#include "support/sharp_solids.h"
#include "support/surface_cases.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <random>
#include <set>

using namespace pcl::crest;
using oracle::countDifferent;
using oracle::CrestRun;
using oracle::extract;
using oracle::totalLength;
using Cloud = pcl::PointCloud<pcl::PointNormal>;

namespace oracle {

static std::ostream&
operator<< (std::ostream& stream, const AnalyticSurface& surface)
{
  return stream << surface.name;
}

} // namespace oracle

namespace {

std::set<pcl::index_t>
pointsOf (const std::vector<CrestLine>& lines, CrestType type)
{
  std::set<pcl::index_t> points;
  for (const CrestLine& line : lines)
    if (line.type == type)
      for (const auto& polyline : line.polylines)
        points.insert (polyline.begin(), polyline.end());
  return points;
}

/** \brief How far any of some points is from the nearest of others. */
double
farthestFrom (const Cloud& cloud,
              const std::set<pcl::index_t>& others,
              const std::set<pcl::index_t>& points)
{
  double farthest = 0.0;
  for (const pcl::index_t p : points) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const pcl::index_t q : others)
      nearest = std::min<double> (
          nearest, (cloud[p].getVector3fMap() - cloud[q].getVector3fMap()).norm());
    farthest = std::max (farthest, nearest);
  }
  return farthest;
}

constexpr std::size_t SAMPLES = 20000;

/** \brief The precision and recall that were measured at a noise (in spacings), and
 * what a test may fall short of them: less than a loss that one would see.
 */
struct Quality {
  double noise;
  double precision;
  double recall;
};
constexpr double MARGIN = 0.02;

struct QualityCase {
  oracle::AnalyticSurface surface;
  CrestType type;
  std::vector<Quality> expected;
};

std::ostream&
operator<< (std::ostream& stream, const QualityCase& c)
{
  return stream << c.surface.name;
}

std::vector<QualityCase>
qualityCases ()
{
  const auto ridge = CrestType::RIDGE;
  const auto valley = CrestType::VALLEY;
  return {{oracle::ellipsoid (1.0, 0.7, 0.45),
           ridge,
           {{0.0, 1.0, 1.0}, {0.05, 1.0, 1.0}, {0.2, 0.99, 0.99}}},
          {oracle::wavyRidge(),
           ridge,
           {{0.0, 1.0, 1.0}, {0.05, 0.98, 0.99}, {0.2, 0.98, 0.98}}},
          {oracle::bumpySphere(),
           ridge,
           {{0.0, 1.0, 1.0}, {0.05, 1.0, 0.99}, {0.2, 0.99, 1.0}}},
          {oracle::ellipticTorus(),
           ridge,
           {{0.0, 1.0, 1.0}, {0.05, 1.0, 1.0}, {0.2, 1.0, 1.0}}},
          {oracle::ridgeAndValley(),
           valley,
           {{0.0, 1.0, 0.99}, {0.05, 1.0, 1.0}, {0.2, 1.0, 1.0}}},
          {oracle::roundedBox(),
           ridge,
           {{0.0, 1.0, 1.0}, {0.05, 1.0, 1.0}, {0.2, 1.0, 0.99}}}};
}

} // namespace

class AutoQuality : public testing::TestWithParam<QualityCase> {};

TEST_P (AutoQuality, IsWhatItWas)
{
  const QualityCase& c = GetParam();
  const Cloud::Ptr exact = oracle::sample (c.surface, SAMPLES);
  const double h = oracle::meanSpacing (*exact);
  const auto truth = oracle::trueCrestLines (c.surface);
  for (const Quality& expected : c.expected) {
    const CrestRun run = extract (oracle::withNoise (*exact, expected.noise * h));
    const oracle::LineScore score =
        oracle::scoreLines (run.lines, *run.line_cloud, truth, c.type, 1.5 * h);
    EXPECT_GE (score.precision, expected.precision - MARGIN) << expected.noise;
    EXPECT_GE (score.recall, expected.recall - MARGIN) << expected.noise;
    // In units of the tolerance: half a spacing.
    EXPECT_LE (score.error, 0.5 / 1.5) << expected.noise;
  }
}

INSTANTIATE_TEST_SUITE_P (Analytic,
                          AutoQuality,
                          testing::ValuesIn (qualityCases()),
                          [] (const auto& info) {
                            std::string name = info.param.surface.name;
                            std::replace (name.begin(), name.end(), ' ', '_');
                            return name;
                          });

TEST (AutoPreset, NarrowRoundCrestsAreNoSharpEdges)
{
  // Two planes fit these better than a cubic of the same window does, but the line
  // where they meet is a fifth of a spacing off.
  const oracle::AnalyticSurface surface = oracle::parallelRidges();
  const Cloud::Ptr exact = oracle::sample (surface, SAMPLES);
  const double h = oracle::meanSpacing (*exact);
  const auto truth = oracle::trueCrestLines (surface);
  for (const double noise : {0.0, 0.05}) {
    const CrestRun run = extract (oracle::withNoise (*exact, noise * h));
    const oracle::LineScore score = oracle::scoreLines (
        run.lines, *run.line_cloud, truth, CrestType::RIDGE, 1.5 * h);
    EXPECT_GE (score.recall, 0.98) << noise;
    EXPECT_LE (1.5 * score.error, 0.14) << noise;
  }
}

TEST (AutoPreset, CrestsBesideABorderAreDrawn)
{
  // Of the valleys a third lies within 12 spacings of where the data end.
  const oracle::AnalyticSurface surface = oracle::gentleWaves();
  const Cloud::Ptr exact = oracle::sample (surface, SAMPLES);
  const double h = oracle::meanSpacing (*exact);
  const CrestRun run = extract (exact);
  const oracle::LineScore score = oracle::scoreLines (run.lines,
                                                      *run.line_cloud,
                                                      oracle::trueCrestLines (surface),
                                                      CrestType::VALLEY,
                                                      1.5 * h);
  EXPECT_GE (score.precision, 0.98);
  EXPECT_GE (score.recall, 0.88);
}

class AutoSilence : public testing::TestWithParam<oracle::AnalyticSurface> {};

TEST_P (AutoSilence, NothingIsDrawnOfNoise)
{
  const Cloud::Ptr exact = oracle::sample (GetParam(), 8000);
  const double h = oracle::meanSpacing (*exact);
  for (const double noise : {0.0, 0.1, 0.5, 1.0})
    for (const unsigned seed : {1U, 2U}) {
      const CrestRun run = extract (oracle::withNoise (*exact, noise * h, seed));
      EXPECT_TRUE (run.lines.empty()) << noise << " seed " << seed;
    }
}

INSTANTIATE_TEST_SUITE_P (Analytic,
                          AutoSilence,
                          testing::Values (oracle::plane(),
                                           oracle::sphere (1.0),
                                           oracle::cylinder (0.5),
                                           oracle::torus (1.0, 0.4)),
                          [] (const auto& info) { return info.param.name; });

TEST (AutoLines, RingsAreClosed)
{
  for (const double noise : {0.0, 0.2}) {
    const Cloud::Ptr exact = oracle::sample (oracle::ellipsoid (1.0, 0.7, 0.45), 8000);
    const double h = oracle::meanSpacing (*exact);
    const CrestRun run = extract (oracle::withNoise (*exact, noise * h));
    ASSERT_EQ (run.lines.size(), 1U);
    const CrestLine& ring = run.lines[0];
    EXPECT_TRUE (ring.closed);
    EXPECT_EQ (
        ring.ends,
        (std::vector<std::array<LineEnd, 2>>{{LineEnd::CLOSED, LineEnd::CLOSED}}));
  }
}

TEST (AutoLines, RoundedBoxHasTwelveEdgesAndEightCorners)
{
  const Cloud::Ptr cloud = oracle::sample (oracle::roundedBox(), SAMPLES);
  const CrestRun run = extract (cloud);
  ASSERT_EQ (run.lines.size(), 1U);
  std::vector<pcl::index_t> corners;
  for (const auto& polyline : run.lines[0].polylines)
    for (const pcl::index_t end : {polyline.front(), polyline.back()})
      corners.push_back (end);
  std::sort (corners.begin(), corners.end());
  corners.erase (std::unique (corners.begin(), corners.end()), corners.end());
  EXPECT_EQ (corners.size(), 8U);
  EXPECT_EQ (run.lines[0].polylines.size(), 12U);
  for (const auto& [first, last] : run.lines[0].ends) {
    EXPECT_EQ (first, LineEnd::JUNCTION);
    EXPECT_EQ (last, LineEnd::JUNCTION);
  }
}

TEST (AutoLines, MeasuresAreThoseOfTheSurface)
{
  // Against the true ridge, whose ends at the border of the samples are not drawn:
  // there is no curvature to speak of, so that its strength shows it less than its
  // angle.
  const oracle::AnalyticSurface surface = oracle::wavyRidge();
  double true_length = 0.0;
  double strength = 0.0;
  double angle = 0.0;
  for (const oracle::TruthSegment& s : oracle::trueCrestLines (surface))
    if (s.type == CrestType::RIDGE) {
      const double length = (s.b - s.a).norm();
      true_length += length;
      strength += length * s.curvature;
      angle += length * turningAngle (s.sharpness / std::pow (s.curvature, 3));
    }
  const Cloud::Ptr cloud = oracle::sample (surface, SAMPLES);
  const CrestRun run = extract (cloud);
  const auto ridge =
      std::find_if (run.lines.begin(), run.lines.end(), [] (const CrestLine& line) {
        return line.type == CrestType::RIDGE;
      });
  ASSERT_NE (ridge, run.lines.end());
  EXPECT_NEAR (ridge->strength, strength, 0.05 * strength);
  EXPECT_NEAR (ridge->strength, ridge->mean_curvature * ridge->length, 1e-6);
  EXPECT_NEAR (ridge->turning_angle, angle / true_length, 10.0);
  EXPECT_GT (ridge->scale, 0.0);
  EXPECT_EQ (ridge->ends[0][0], LineEnd::BOUNDARY);
  EXPECT_EQ (ridge->ends[0][1], LineEnd::BOUNDARY);
}

TEST (AutoLines, RunAlongSamplesOnRequest)
{
  const Cloud::Ptr cloud = oracle::sample (oracle::ellipticTorus(), 8000);
  Parameters parameters;
  const CrestRun crest = extract (cloud, parameters);
  parameters.positions = Positions::SAMPLES;
  const CrestRun samples = extract (cloud, parameters);
  EXPECT_EQ (countDifferent (crest.labels, samples.labels), 0U);
  ASSERT_EQ (crest.lines.size(), samples.lines.size());
  for (std::size_t i = 0; i < crest.lines.size(); ++i) {
    EXPECT_EQ (crest.lines[i].polylines, samples.lines[i].polylines);
    EXPECT_LT (crest.lines[i].length, samples.lines[i].length);
  }
  for (std::size_t i = 0; i < cloud->size(); ++i)
    EXPECT_EQ ((*samples.line_cloud)[i].getVector3fMap(), (*cloud)[i].getVector3fMap());
}

TEST (AutoCurvature, HasADirectionOnAnExactPlane)
{
  const auto cloud = pcl::make_shared<Cloud>();
  for (int i = 0; i < 30; ++i)
    for (int j = 0; j < 30; ++j) {
      pcl::PointNormal point (static_cast<float> (i), static_cast<float> (j), 0.0F);
      point.normal_z = 1.0F;
      cloud->push_back (point);
    }
  pcl::CrestLineEstimation<pcl::PointNormal> estimation;
  estimation.setInputCloud (cloud);
  pcl::PointCloud<pcl::Label> labels;
  estimation.compute (labels);
  for (const pcl::PrincipalCurvatures& c : estimation.getPrincipalCurvatures())
    ASSERT_NEAR (
        Eigen::Map<const Eigen::Vector3f> (c.principal_curvature).norm(), 1.0F, 1e-5F);
}

TEST (AutoParameters, AngleLengthAndConfidenceOnlyRemove)
{
  const Cloud::Ptr exact = oracle::sample (oracle::bumpySphere(), 12000);
  const Cloud::Ptr cloud =
      oracle::withNoise (*exact, 0.2 * oracle::meanSpacing (*exact));
  const double h = oracle::meanSpacing (*cloud);
  const std::vector<CrestLine> usual = extract (cloud).lines;
  const auto fewer = [&] (const Parameters& parameters, double largest_step) {
    std::vector<CrestLine> lines = extract (cloud, parameters).lines;
    EXPECT_FALSE (lines.empty());
    EXPECT_LT (totalLength (lines), totalLength (usual));
    for (const CrestType type : CREST_TYPES)
      EXPECT_LE (farthestFrom (*cloud, pointsOf (usual, type), pointsOf (lines, type)),
                 largest_step);
    return lines;
  };
  Parameters parameters;
  parameters.angle = 90.0;
  fewer (parameters, 0.0);
  // Lines that stay may take another way past samples, or another branch at their end.
  parameters = Parameters();
  parameters.min_length = 40.0;
  for (const CrestLine& line : fewer (parameters, 3.0 * h))
    EXPECT_GT (line.length, 30.0 * h);
  parameters = Parameters();
  parameters.confidence = 6.0;
  fewer (parameters, 2.0 * h);
}

class AutoInvariance : public testing::Test {
protected:
  void
  SetUp () override
  {
    const Cloud::Ptr exact = oracle::sample (oracle::bumpySphere(), 12000);
    h_ = oracle::meanSpacing (*exact);
    cloud_ = oracle::withNoise (*exact, 0.1 * h_);
    run_ = extract (cloud_);
    ASSERT_FALSE (run_.lines.empty());
  }

  double h_ = 0.0;
  Cloud::Ptr cloud_;
  CrestRun run_;
};

TEST_F (AutoInvariance, Threads)
{
  Parameters parameters;
  parameters.threads = 1;
  const CrestRun one = extract (cloud_, parameters);
  parameters.threads = 3;
  const CrestRun three = extract (cloud_, parameters);
  EXPECT_EQ (countDifferent (one.labels, three.labels), 0U);
  ASSERT_EQ (one.lines.size(), three.lines.size());
  for (std::size_t i = 0; i < one.lines.size(); ++i)
    EXPECT_EQ (one.lines[i].length, three.lines[i].length);
}

TEST_F (AutoInvariance, OrderOfPoints)
{
  std::vector<std::size_t> order (cloud_->size());
  std::iota (order.begin(), order.end(), 0);
  std::shuffle (order.begin(), order.end(), std::mt19937 (5));
  const Cloud::Ptr shuffled = pcl::make_shared<Cloud>();
  for (const std::size_t i : order)
    shuffled->push_back ((*cloud_)[i]);
  const CrestRun other = extract (shuffled);
  pcl::PointCloud<pcl::Label> back = other.labels;
  for (std::size_t i = 0; i < order.size(); ++i)
    back[order[i]] = other.labels[i];
  EXPECT_EQ (countDifferent (run_.labels, back), 0U);
  ASSERT_EQ (run_.lines.size(), other.lines.size());
  for (std::size_t i = 0; i < run_.lines.size(); ++i)
    EXPECT_EQ (run_.lines[i].length, other.lines[i].length);
}

TEST_F (AutoInvariance, Scale)
{
  for (const float scale : {1.0F / 1048576.0F, 1048576.0F}) {
    const Cloud::Ptr scaled = pcl::make_shared<Cloud> (*cloud_);
    for (pcl::PointNormal& point : *scaled)
      point.getVector3fMap() *= scale;
    const CrestRun other = extract (scaled);
    EXPECT_EQ (countDifferent (run_.labels, other.labels), 0U);
    ASSERT_EQ (run_.lines.size(), other.lines.size());
    for (std::size_t i = 0; i < run_.lines.size(); ++i)
      EXPECT_EQ (run_.lines[i].polylines, other.lines[i].polylines);
  }
}

TEST_F (AutoInvariance, FlippedNormalsSwapRidgesAndValleys)
{
  const Cloud::Ptr flipped = pcl::make_shared<Cloud> (*cloud_);
  for (pcl::PointNormal& point : *flipped)
    point.getNormalVector3fMap() *= -1.0F;
  CrestRun swapped = extract (flipped);
  for (pcl::Label& label : swapped.labels)
    label.label = oracle::flipped (label.label);
  EXPECT_EQ (countDifferent (run_.labels, swapped.labels), 0U);
  EXPECT_EQ (run_.lines.size(), swapped.lines.size());
}

TEST_F (AutoInvariance, Rotation)
{
  const Eigen::Quaternionf turn =
      Eigen::Quaternionf (0.2F, 0.4F, -0.7F, 0.5F).normalized();
  const auto turned = [] (const Cloud& cloud, const Eigen::Quaternionf& by) {
    Cloud::Ptr result = pcl::make_shared<Cloud> (cloud);
    for (pcl::PointNormal& point : *result) {
      point.getVector3fMap() = (by * point.getVector3fMap()).eval();
      point.getNormalVector3fMap() = (by * point.getNormalVector3fMap()).eval();
    }
    return result;
  };
  const CrestRun other = extract (turned (*cloud_, turn));
  const Cloud::Ptr back = turned (*other.line_cloud, turn.conjugate());
  std::vector<oracle::TruthSegment> segments;
  for (const CrestLine& line : run_.lines)
    for (const auto& polyline : line.polylines)
      for (std::size_t i = 1; i < polyline.size(); ++i) {
        constexpr int PIECES = 8;
        const auto at = [&] (int piece) -> Eigen::Vector3d {
          const auto a = (*run_.line_cloud)[polyline[i - 1]].getVector3fMap();
          const auto b = (*run_.line_cloud)[polyline[i]].getVector3fMap();
          return (a + (b - a) * piece / PIECES).cast<double>();
        };
        for (int piece = 0; piece < PIECES; ++piece)
          segments.push_back ({at (piece), at (piece + 1), line.type, 1.0, 1.0});
      }
  for (const CrestType type : CREST_TYPES) {
    const oracle::LineScore score =
        oracle::scoreLines (other.lines, *back, segments, type, 0.3 * h_);
    EXPECT_GT (score.precision, 0.95);
    EXPECT_GT (score.recall, 0.95);
  }
}

namespace {

/** \brief A strip whose cross section has a curvature that is given, by the length
 * along it from its middle: two planes far from there. Samples are a unit apart.
 */
Cloud::Ptr
sweptSection (const std::function<double (double)>& curvature)
{
  constexpr double HALF = 40.0;
  constexpr int ROWS = 60;
  constexpr double STEP = 0.01;
  auto cloud = pcl::make_shared<Cloud>();
  std::mt19937 random (1);
  std::uniform_real_distribution<double> jitter (-0.4, 0.4);
  std::vector<Eigen::Vector3d> section;
  Eigen::Vector2d place = Eigen::Vector2d::Zero();
  double angle = 0.0;
  for (double s = -HALF; s <= HALF; s += STEP) {
    section.emplace_back (place.x(), place.y(), angle);
    place += STEP * Eigen::Vector2d (std::cos (angle), std::sin (angle));
    angle -= STEP * curvature (s);
  }
  for (int row = 0; row < ROWS; ++row)
    for (double s = -HALF + 1.0; s < HALF - 1.0; s += 1.0) {
      const auto at = static_cast<std::size_t> ((s + jitter (random) + HALF) / STEP);
      const Eigen::Vector3d& here = section[at];
      pcl::PointNormal point;
      point.getVector3fMap() =
          Eigen::Vector3d (here.x(), row + jitter (random), here.y()).cast<float>();
      point.getNormalVector3fMap() =
          Eigen::Vector3d (-std::sin (here.z()), 0.0, std::cos (here.z()))
              .cast<float>();
      cloud->push_back (point);
    }
  return cloud;
}

} // namespace

TEST (AutoBlends, HaveNoCrest)
{
  // A right angle over 20 and over 15 spacings, by one radius and by a smooth crest.
  for (const double width : {20.0, 15.0}) {
    const double mean = 0.5 * M_PI / width;
    const CrestRun blend = extract (sweptSection (
        [&] (double s) { return std::abs (s) < 0.5 * width ? mean : 0.0; }));
    EXPECT_EQ (totalLength (blend.lines), 0.0) << width;
    const CrestRun crest = extract (sweptSection ([&] (double s) {
      return std::abs (s) < width ? mean * 0.5 * (1.0 + std::cos (M_PI * s / width))
                                  : 0.0;
    }));
    EXPECT_GT (totalLength (crest.lines), 45.0) << width;
    EXPECT_LT (totalLength (crest.lines), 65.0) << width;
  }
}

TEST (AutoBoxes, HaveTheirEdgesAloneAndOnce)
{
  const Cloud::Ptr exact = oracle::sample (oracle::box (1.0, 1.0, 1.0), SAMPLES);
  const double h = oracle::meanSpacing (*exact);
  for (const double noise : {0.1, 0.3, 0.4}) {
    const CrestRun run = extract (oracle::withNoise (*exact, noise * h));
    EXPECT_GT (totalLength (run.lines), 0.97 * 12.0) << noise;
    EXPECT_LT (totalLength (run.lines), 1.02 * 12.0) << noise;
  }
}
