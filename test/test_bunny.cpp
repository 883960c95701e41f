// SPDX-License-Identifier: BSD-3-Clause
// The method on a real scan: what has to hold whatever the lines look like.
#include <pcl_crest/crest_line_estimation.h>
#include <pcl_crest/io/read_cloud.h>

#include <pcl/search/kdtree.h>

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "support/flipped_labels.h"

#include <algorithm>
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

TEST_F (Bunny, BothSearchesGiveTheSameLines)
{
  for (const Preset preset : {Preset::PAPER, Preset::AUTO}) {
    const auto run = [&] (bool batched, pcl::PointCloud<pcl::Label>& labels) {
      Estimation estimation;
      estimation.setInputCloud (cloud_);
      estimation.setPreset (preset);
      estimation.setUseBatchedSearch (batched);
      estimation.compute (labels);
      return estimation;
    };
    pcl::PointCloud<pcl::Label> labels, expected_labels;
    const Estimation estimation = run (true, labels);
    const Estimation expected = run (false, expected_labels);
    ASSERT_EQ (labels.size(), cloud_->size());
    for (std::size_t i = 0; i < labels.size(); ++i)
      ASSERT_EQ (labels[i].label, expected_labels[i].label) << i;
    EXPECT_EQ (estimation.getStatistics().mean_spacing,
               expected.getStatistics().mean_spacing);
    ASSERT_GT (expected.getLines().size(), 10U);
    ASSERT_EQ (estimation.getLines().size(), expected.getLines().size());
    for (std::size_t l = 0; l < expected.getLines().size(); ++l) {
      const CrestLine& line = estimation.getLines()[l];
      EXPECT_EQ (line.polylines, expected.getLines()[l].polylines);
      EXPECT_EQ (line.length, expected.getLines()[l].length);
      EXPECT_EQ (line.strength, expected.getLines()[l].strength);
    }
  }
}

TEST_F (Bunny, OrderThreadsAndNormalsGiveTheSame)
{
  Estimation estimation;
  estimation.setNumberOfThreads (1);
  const std::vector<std::uint32_t> expected = labelsAt (1.0, cloud_, estimation);
  Estimation threaded;
  threaded.setNumberOfThreads (2);
  EXPECT_EQ (labelsAt (1.0, cloud_, threaded), expected);

  std::vector<std::size_t> order (cloud_->size());
  std::iota (order.begin(), order.end(), 0);
  std::shuffle (order.begin(), order.end(), std::mt19937 (1));
  const Cloud::Ptr shuffled = pcl::make_shared<Cloud>();
  for (const std::size_t i : order) {
    shuffled->push_back ((*cloud_)[i]);
    shuffled->back().getNormalVector3fMap() *= -1.0F;
  }
  Estimation other;
  const std::vector<std::uint32_t> labels = labelsAt (1.0, shuffled, other);
  std::size_t different = 0;
  for (std::size_t i = 0; i < order.size(); ++i)
    different += oracle::flipped (labels[i]) != expected[order[i]] ? 1 : 0;
  EXPECT_EQ (different, 0U);
}
