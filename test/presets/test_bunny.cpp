// SPDX-License-Identifier: BSD-3-Clause
// The method on a real scan: what has to hold whatever the lines look like.
#include <pcl_crest/crest_line_estimation.h>
#include <pcl_crest/io/read_cloud.h>

#include <pcl/search/kdtree.h>

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "support/flipped_labels.h"

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <random>
#include <set>

using namespace pcl::crest;
using Cloud = pcl::PointCloud<pcl::PointNormal>;
using Estimation = pcl::CrestLineEstimation<pcl::PointNormal>;

namespace {

class Bunny : public testing::Test {
protected:
  void
  SetUp () override
  {
    InputCloud input;
    std::string error;
    ASSERT_TRUE (readCloud (PCL_CREST_BUNNY, 24, 0, input, error))
        << error << " (scripts/fetch_meshes takes it out of a Debian package)";
    ASSERT_EQ (input.normals, NormalSource::FACES);
    cloud_ = input.points;
  }

  static std::vector<std::uint32_t>
  labelsAt (double m, const Cloud::ConstPtr& cloud, Estimation& estimation)
  {
    estimation.setInputCloud (cloud);
    estimation.setPreset (Preset::PAPER);
    estimation.setMaximality (m);
    pcl::PointCloud<pcl::Label> labels;
    estimation.compute (labels);
    std::vector<std::uint32_t> codes;
    for (const pcl::Label& label : labels)
      codes.push_back (label.label);
    return codes;
  }

  std::vector<std::uint32_t>
  labelsAt (double m) const
  {
    Estimation estimation;
    return labelsAt (m, cloud_, estimation);
  }

  Cloud::Ptr cloud_;
};

bool
isCrest (std::uint32_t label)
{
  return label == LABEL_RIDGE || label == LABEL_VALLEY;
}

} // namespace

TEST_F (Bunny, IsReadWhole) { EXPECT_EQ (cloud_->size(), 37706U); }

TEST_F (Bunny, HigherMKeepsASubset)
{
  std::vector<std::uint32_t> before = labelsAt (0.01);
  for (const double m : {1.0, 3.0, 6.0}) {
    const std::vector<std::uint32_t> after = labelsAt (m);
    std::size_t lost = 0;
    for (std::size_t i = 0; i < after.size(); ++i) {
      if (isCrest (after[i]))
        ASSERT_EQ (after[i], before[i]) << i;
      else
        lost += isCrest (before[i]) ? 1 : 0;
    }
    EXPECT_GT (lost, 500U);
    before = after;
  }
}

TEST_F (Bunny, CrestPointsAreMaximaByTheirCurvatures)
{
  // From the outputs alone, without the graph: some point nearby in the direction of t1
  // has a lower |k1|, and so on the other side. Hardly any crest point may fail this,
  // many others have to.
  Estimation estimation;
  const std::vector<std::uint32_t> labels = labelsAt (0.01, cloud_, estimation);
  const auto& curvatures = estimation.getPrincipalCurvatures();
  pcl::search::KdTree<pcl::PointNormal> tree;
  tree.setInputCloud (cloud_);
  pcl::Indices found;
  std::vector<float> squared;
  const auto isMaximum = [&] (std::size_t i) {
    const pcl::PointNormal& p = (*cloud_)[i];
    const Eigen::Vector3f t (curvatures[i].principal_curvature_x,
                             curvatures[i].principal_curvature_y,
                             curvatures[i].principal_curvature_z);
    tree.nearestKSearch (p, 16, found, squared);
    bool lower[2] = {false, false};
    for (const pcl::index_t q : found) {
      const Eigen::Vector3f e = (*cloud_)[q].getVector3fMap() - p.getVector3fMap();
      if (std::abs (e.dot (t)) > 0.7F * e.norm() &&
          std::abs (curvatures[q].pc1) < std::abs (curvatures[i].pc1))
        lower[e.dot (t) > 0.0F ? 0 : 1] = true;
    }
    return lower[0] && lower[1];
  };
  double crests = 0.0;
  double crest_maxima = 0.0;
  double others = 0.0;
  double other_maxima = 0.0;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    (isCrest (labels[i]) ? crests : others) += 1.0;
    (isCrest (labels[i]) ? crest_maxima : other_maxima) += isMaximum (i) ? 1.0 : 0.0;
    EXPECT_TRUE (!isCrest (labels[i]) ||
                 (curvatures[i].pc1 > 0.0F) == (labels[i] == LABEL_RIDGE));
  }
  EXPECT_GT (crests, 5000.0);
  EXPECT_GE (crest_maxima, 0.99 * crests);
  EXPECT_LE (other_maxima, 0.6 * others);
}

TEST_F (Bunny, LinesAreTreesWithoutShortBranches)
{
  Estimation estimation;
  estimation.setMinSize (15);
  labelsAt (1.0, cloud_, estimation);
  ASSERT_GT (estimation.getLines().size(), 10U);
  std::set<pcl::index_t> ridge_points;
  std::set<pcl::index_t> valley_points;
  for (const CrestLine& line : estimation.getLines()) {
    std::map<pcl::index_t, std::size_t> degree;
    std::set<std::pair<pcl::index_t, pcl::index_t>> edges;
    for (const auto& polyline : line.polylines)
      for (std::size_t i = 1; i < polyline.size(); ++i) {
        ++degree[polyline[i - 1]];
        ++degree[polyline[i]];
        edges.insert (std::minmax (polyline[i - 1], polyline[i]));
      }
    EXPECT_EQ (degree.size(), line.size);
    EXPECT_EQ (edges.size(), line.closed ? line.size : line.size - 1);
    EXPECT_GE (line.size, 15U);
    for (const auto& polyline : line.polylines) {
      const bool branch = line.polylines.size() > 1 && (degree[polyline.front()] == 1 ||
                                                        degree[polyline.back()] == 1);
      EXPECT_GT (polyline.size(), branch ? 11U : 1U);
    }
    for (const auto& [point, count] : degree) {
      auto& points = line.type == CrestType::RIDGE ? ridge_points : valley_points;
      EXPECT_TRUE (points.insert (point).second) << "two lines share " << point;
    }
  }
}

namespace {

/** \brief All that a run gives, each point known by its place in one order. */
struct Outcome {
  std::vector<std::uint32_t> labels;
  /** k1, k2 and the direction of k1 */
  std::vector<std::array<float, 5>> curvatures;
  std::vector<CrestLine> lines;
  std::vector<Eigen::Vector3f> line_points;
  double mean_spacing;
};

struct Run {
  unsigned threads;
  bool batched;
};

/** \brief \param[in] order point i of the cloud is known as order[i] */
Outcome
outcomeOf (const Cloud::ConstPtr& cloud,
           const std::vector<pcl::index_t>& order,
           Preset preset,
           const Run& run)
{
  Estimation estimation;
  estimation.setInputCloud (cloud);
  estimation.setPreset (preset);
  estimation.setNumberOfThreads (run.threads);
  estimation.setUseBatchedSearch (run.batched);
  pcl::PointCloud<pcl::Label> labels;
  estimation.compute (labels);
  Outcome outcome;
  outcome.labels.resize (order.size());
  outcome.curvatures.resize (order.size());
  outcome.line_points.resize (order.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    const pcl::PrincipalCurvatures& k = estimation.getPrincipalCurvatures()[i];
    outcome.labels[order[i]] = labels[i].label;
    outcome.curvatures[order[i]] = {k.pc1,
                                    k.pc2,
                                    k.principal_curvature_x,
                                    k.principal_curvature_y,
                                    k.principal_curvature_z};
    outcome.line_points[order[i]] = (*estimation.getLineCloud())[i].getVector3fMap();
  }
  outcome.mean_spacing = estimation.getStatistics().mean_spacing;
  outcome.lines = estimation.getLines();
  for (CrestLine& line : outcome.lines)
    for (auto& polyline : line.polylines)
      for (pcl::index_t& point : polyline)
        point = order[point];
  return outcome;
}

void
expectSame (const Outcome& a, const Outcome& b)
{
  EXPECT_EQ (a.labels, b.labels);
  EXPECT_EQ (a.curvatures, b.curvatures);
  EXPECT_EQ (a.line_points, b.line_points);
  EXPECT_EQ (a.mean_spacing, b.mean_spacing);
  ASSERT_EQ (a.lines.size(), b.lines.size());
  for (std::size_t i = 0; i < a.lines.size(); ++i) {
    EXPECT_EQ (a.lines[i].type, b.lines[i].type);
    EXPECT_EQ (a.lines[i].polylines, b.lines[i].polylines);
    EXPECT_EQ (a.lines[i].length, b.lines[i].length);
    EXPECT_EQ (a.lines[i].strength, b.lines[i].strength);
  }
}

} // namespace

TEST_F (Bunny, OrderThreadsAndSearchesGiveTheSame)
{
  std::vector<pcl::index_t> in_order (cloud_->size());
  std::iota (in_order.begin(), in_order.end(), 0);
  std::vector<pcl::index_t> order = in_order;
  std::shuffle (order.begin(), order.end(), std::mt19937 (1));
  const Cloud::Ptr shuffled = pcl::make_shared<Cloud>();
  for (const pcl::index_t i : order)
    shuffled->push_back ((*cloud_)[i]);
  for (const Preset preset : {Preset::PAPER, Preset::AUTO}) {
    const Outcome expected = outcomeOf (cloud_, in_order, preset, {1, false});
    ASSERT_GT (expected.lines.size(), 10U);
    expectSame (outcomeOf (cloud_, in_order, preset, {2, true}), expected);
    expectSame (outcomeOf (shuffled, order, preset, {1, true}), expected);
    expectSame (outcomeOf (shuffled, order, preset, {2, false}), expected);
  }
}

TEST_F (Bunny, FlippedNormalsSwapRidgesAndValleys)
{
  const Cloud::Ptr flipped = pcl::make_shared<Cloud> (*cloud_);
  for (pcl::PointNormal& point : *flipped)
    point.getNormalVector3fMap() *= -1.0F;
  std::vector<pcl::index_t> in_order (cloud_->size());
  std::iota (in_order.begin(), in_order.end(), 0);
  for (const Preset preset : {Preset::PAPER, Preset::AUTO}) {
    const Outcome expected = outcomeOf (cloud_, in_order, preset, {2, true});
    const Outcome other = outcomeOf (flipped, in_order, preset, {2, true});
    std::size_t different = 0;
    for (std::size_t i = 0; i < in_order.size(); ++i)
      different += oracle::flipped (other.labels[i]) != expected.labels[i] ? 1 : 0;
    EXPECT_EQ (different, 0U);
  }
}
