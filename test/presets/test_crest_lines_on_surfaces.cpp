// SPDX-License-Identifier: BSD-3-Clause
// The paper's whole method against the exact crest lines of analytic surfaces, and what
// must not change the result.
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "support/crest_truth.h"
#include "support/extraction.h"
#include "support/flipped_labels.h"
#include "support/surface_cases.h"

#include <algorithm>
#include <numeric>
#include <random>

using namespace pcl::crest;
using oracle::countDifferent;
using oracle::CrestRun;
using oracle::extract;
using Cloud = pcl::PointCloud<pcl::PointNormal>;

namespace {

constexpr std::size_t SAMPLES = 20000;

} // namespace

class OnSurface : public testing::TestWithParam<oracle::SurfaceCase> {};

TEST_P (OnSurface, LinesAreWhereTheTruthIs)
{
  const oracle::SurfaceCase& c = GetParam();
  const Cloud::Ptr cloud = oracle::sample (c.surface, SAMPLES);
  ASSERT_NEAR (static_cast<double> (cloud->size()), SAMPLES, 0.1 * SAMPLES);
  const double tolerance = 1.5 * oracle::meanSpacing (*cloud);
  const auto truth = oracle::trueCrestLines (c.surface);
  const CrestRun run = extract (cloud, c.parameters());
  for (const CrestType type : CREST_TYPES) {
    const bool salient =
        std::find (c.types.begin(), c.types.end(), type) != c.types.end();
    const bool in_truth = std::any_of (
        truth.begin(), truth.end(), [type] (const auto& s) { return s.type == type; });
    if (!salient) {
      EXPECT_TRUE (in_truth || std::none_of (run.lines.begin(),
                                             run.lines.end(),
                                             [type] (const CrestLine& line) {
                                               return line.type == type;
                                             }))
          << "lines of a type that the surface does not have";
      continue;
    }
    const oracle::Score score =
        oracle::score (run.lines, *cloud, truth, type, tolerance);
    const char* name = type == CrestType::RIDGE ? "ridges" : "valleys";
    EXPECT_GE (score.precision, 0.95) << c.surface.name << ' ' << name;
    EXPECT_GE (score.recall, 0.95) << c.surface.name << ' ' << name;
    EXPECT_GE (score.salient_part, 0.25) << c.surface.name << ' ' << name;
  }
}

TEST_P (OnSurface, FlippedNormalsSwapRidgesAndValleys)
{
  const oracle::SurfaceCase& c = GetParam();
  const Cloud::Ptr cloud = oracle::sample (c.surface, SAMPLES);
  const Cloud::Ptr flipped = pcl::make_shared<Cloud> (*cloud);
  for (pcl::PointNormal& point : *flipped)
    point.getNormalVector3fMap() *= -1.0F;
  Parameters parameters = c.parameters();
  const CrestRun run = extract (cloud, parameters);
  std::swap (parameters.maximality.ridge, parameters.maximality.valley);
  CrestRun swapped = extract (flipped, parameters);
  for (pcl::Label& label : swapped.labels)
    label.label = oracle::flipped (label.label);
  EXPECT_EQ (countDifferent (run.labels, swapped.labels), 0U);
  EXPECT_EQ (run.lines.size(), swapped.lines.size());
}

TEST_P (OnSurface, OrderOfPointsAndThreadsDoNotMatter)
{
  const oracle::SurfaceCase& c = GetParam();
  const Cloud::Ptr cloud = oracle::sample (c.surface, SAMPLES);
  Parameters parameters = c.parameters();
  parameters.threads = 1;
  const CrestRun run = extract (cloud, parameters);
  parameters.threads = 2;
  EXPECT_EQ (countDifferent (run.labels, extract (cloud, parameters).labels), 0U);

  std::vector<std::size_t> order (cloud->size());
  std::iota (order.begin(), order.end(), 0);
  std::shuffle (order.begin(), order.end(), std::mt19937 (5));
  const Cloud::Ptr shuffled = pcl::make_shared<Cloud>();
  for (const std::size_t i : order)
    shuffled->push_back ((*cloud)[i]);
  const CrestRun other = extract (shuffled, parameters);
  pcl::PointCloud<pcl::Label> back = other.labels;
  for (std::size_t i = 0; i < order.size(); ++i)
    back[order[i]] = other.labels[i];
  EXPECT_EQ (countDifferent (run.labels, back), 0U);
  ASSERT_EQ (run.lines.size(), other.lines.size());
  for (std::size_t i = 0; i < run.lines.size(); ++i)
    EXPECT_EQ (run.lines[i].length, other.lines[i].length);
}

TEST_P (OnSurface, ScaleDoesNotMatterToARelativeM)
{
  const oracle::SurfaceCase& c = GetParam();
  const Cloud::Ptr cloud = oracle::sample (c.surface, SAMPLES);
  Parameters parameters = c.parameters();
  parameters.absolute_maximality = false;
  // The surfaces are about two units wide, and the relative unit is a tenth of that.
  for (const CrestType type : CREST_TYPES)
    parameters.maximality[type] *= 0.04;
  const CrestRun run = extract (cloud, parameters);
  // Powers of two change no digit of a float: the labels are the same to the last one.
  // Others round the coordinates, and some threshold decides differently.
  for (const float scale : {1.0F / 8192.0F, 8192.0F, 1e-4F, 1e4F}) {
    const Cloud::Ptr scaled = pcl::make_shared<Cloud> (*cloud);
    for (pcl::PointNormal& point : *scaled)
      point.getVector3fMap() *= scale;
    const bool exact = scale == 8192.0F || scale == 1.0F / 8192.0F;
    const std::size_t different =
        countDifferent (run.labels, extract (scaled, parameters).labels);
    EXPECT_LE (different, exact ? 0 : 5) << "scale " << scale;
  }
}

TEST_P (OnSurface, RotationDoesNotMatter)
{
  const oracle::SurfaceCase& c = GetParam();
  const Cloud::Ptr cloud = oracle::sample (c.surface, SAMPLES);
  const CrestRun run = extract (cloud, c.parameters());
  const Eigen::Quaternionf turn =
      Eigen::Quaternionf (0.2F, 0.4F, -0.7F, 0.5F).normalized();
  const Cloud::Ptr turned = pcl::make_shared<Cloud> (*cloud);
  for (pcl::PointNormal& point : *turned) {
    point.getVector3fMap() = (turn * point.getVector3fMap()).eval();
    point.getNormalVector3fMap() = (turn * point.getNormalVector3fMap()).eval();
  }
  const std::size_t different =
      countDifferent (run.labels, extract (turned, c.parameters()).labels);
  EXPECT_LE (different, cloud->size() / 1000);
}

INSTANTIATE_TEST_SUITE_P (Analytic,
                          OnSurface,
                          testing::ValuesIn (oracle::surfaceCases()),
                          [] (const auto& info) {
                            std::string name = info.param.surface.name;
                            std::replace (name.begin(), name.end(), ' ', '_');
                            return name;
                          });

TEST (Method, RingIsOneClosedLine)
{
  const oracle::AnalyticSurface surface = oracle::ellipticTorus();
  const Cloud::Ptr cloud = oracle::sample (surface, 5000);
  Parameters parameters;
  parameters.preset = Preset::PAPER;
  parameters.absolute_maximality = true;
  parameters.maximality = {0.3, 0.3};
  const CrestRun run = extract (cloud, parameters);
  ASSERT_EQ (run.lines.size(), 2U);
  for (const CrestLine& line : run.lines)
    EXPECT_TRUE (line.closed) << line.size;
}
