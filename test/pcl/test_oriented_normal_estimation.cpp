// SPDX-License-Identifier: BSD-3-Clause
// Normals through the API of PCL, by themselves and within CrestLineEstimation.
#include <pcl_crest/crest_line_estimation.h>
#include <pcl_crest/oriented_normal_estimation.h>

#include <pcl/common/io.h>
#include <pcl/search/kdtree.h>

#include <gtest/gtest.h>

#include "support/analytic_surface.h"
#include "support/sharp_solids.h"

#include <cmath>
#include <limits>

using pcl::crest::SURE_SIGN;

namespace {

pcl::PointCloud<pcl::PointXYZ>::Ptr
positionsOf (const pcl::PointCloud<pcl::PointNormal>& cloud)
{
  auto positions = pcl::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
  pcl::copyPointCloud (cloud, *positions);
  return positions;
}

class OrientedNormals : public testing::Test {
protected:
  const pcl::PointCloud<pcl::PointNormal>::Ptr exact_ =
      oracle::sample (oracle::box (1.0, 0.8, 0.6), 12000);
  const pcl::PointCloud<pcl::PointXYZ>::Ptr cloud_ = positionsOf (*exact_);
  pcl::OrientedNormalEstimation<pcl::PointXYZ, pcl::Normal> estimation_;
  pcl::PointCloud<pcl::Normal> normals_;

  /** \brief Computes, and gives what was said. */
  std::string
  compute ()
  {
    testing::internal::CaptureStderr();
    testing::internal::CaptureStdout();
    estimation_.compute (normals_);
    return testing::internal::GetCapturedStdout() +
           testing::internal::GetCapturedStderr();
  }

  void
  expectRefused (const std::string& why)
  {
    const std::string said = compute();
    EXPECT_NE (said.find (why), std::string::npos) << said;
    EXPECT_TRUE (normals_.empty());
    EXPECT_TRUE (estimation_.getTrust().empty());
  }
};

TEST_F (OrientedNormals, LookOutOfABox)
{
  estimation_.setInputCloud (cloud_);
  EXPECT_EQ (compute(), "");
  ASSERT_EQ (normals_.size(), exact_->size());
  ASSERT_EQ (estimation_.getTrust().size(), exact_->size());
  EXPECT_TRUE (normals_.is_dense);
  std::size_t right = 0;
  for (std::size_t i = 0; i < exact_->size(); ++i)
    right += normals_[i].getNormalVector3fMap().dot (
                 (*exact_)[i].getNormalVector3fMap()) > 0.99F;
  EXPECT_GE (static_cast<double> (right), 0.93 * static_cast<double> (exact_->size()));
  ASSERT_EQ (estimation_.getParts().size(), 1U);
  EXPECT_EQ (estimation_.getParts()[0].side, pcl::crest::NormalSide::OUTWARD);
  EXPECT_GE (estimation_.getParts()[0].trust, 0.99F);
}

TEST_F (OrientedNormals, OfIndicesAreThoseOfTheWholeCloud)
{
  estimation_.setInputCloud (cloud_);
  compute();
  const pcl::PointCloud<pcl::Normal> all = normals_;
  const auto indices = pcl::make_shared<pcl::Indices> (pcl::Indices{5, 0, 11000});
  estimation_.setIndices (indices);
  compute();
  ASSERT_EQ (normals_.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_EQ (normals_[i].getNormalVector3fMap(),
               all[(*indices)[i]].getNormalVector3fMap());
  EXPECT_EQ (estimation_.getTrust().size(), 3U);

  pcl::OrientedNormalEstimation<pcl::PointXYZ, pcl::Normal> of_surface;
  auto some = pcl::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
  pcl::copyPointCloud (*cloud_, *indices, *some);
  of_surface.setInputCloud (some);
  of_surface.setSearchSurface (cloud_);
  pcl::PointCloud<pcl::Normal> found;
  of_surface.compute (found);
  ASSERT_EQ (found.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_EQ (found[i].getNormalVector3fMap(), normals_[i].getNormalVector3fMap());
}

TEST_F (OrientedNormals, AreNotANumberWhereThereAreNone)
{
  (*cloud_)[7].x = std::numeric_limits<float>::quiet_NaN();
  cloud_->is_dense = false;
  estimation_.setInputCloud (cloud_);
  compute();
  EXPECT_FALSE (normals_.is_dense);
  EXPECT_TRUE (std::isnan (normals_[7].normal_x));
  EXPECT_TRUE (std::isnan (normals_[7].curvature));
  EXPECT_EQ (estimation_.getTrust()[7], 0.0F);
  EXPECT_EQ (estimation_.getPartOfPoints()[7], -1);
}

TEST_F (OrientedNormals, LookToTheViewpointThatIsAskedFor)
{
  auto terrain = positionsOf (*oracle::sample (oracle::wavyRidge(), 8000));
  terrain->sensor_origin_ = Eigen::Vector4f (0.0F, 0.0F, -100.0F, 0.0F);
  estimation_.setInputCloud (terrain);
  const auto partUp = [this] {
    compute();
    std::size_t up = 0;
    for (const pcl::Normal& normal : normals_)
      up += normal.normal_z > 0.0F ? 1 : 0;
    return static_cast<double> (up) / static_cast<double> (normals_.size());
  };
  EXPECT_LT (partUp(), 0.01);
  estimation_.setViewPoint (0.0F, 0.0F, 100.0F);
  EXPECT_GT (partUp(), 0.99);
  estimation_.useSensorOriginAsViewPoint();
  EXPECT_LT (partUp(), 0.01);
  terrain->sensor_origin_.setZero();
  pcl::OrientedNormalEstimation<pcl::PointXYZ, pcl::Normal> down;
  down.setInputCloud (terrain);
  down.setUpDirection (0.0F, 0.0F, -1.0F);
  down.compute (normals_);
  EXPECT_LT (normals_[0].normal_z, 0.0F);
}

TEST_F (OrientedNormals, MistakesAreSaid)
{
  expectRefused ("No input cloud was given");
  estimation_.setInputCloud (pcl::make_shared<pcl::PointCloud<pcl::PointXYZ>>());
  expectRefused ("The input cloud is empty");
  estimation_.setInputCloud (cloud_);
  estimation_.setRadiusSearch (0.1);
  expectRefused ("A radius of 0.1");
  estimation_.setRadiusSearch (0.0);
  estimation_.setKSearch (2);
  expectRefused ("k is 2, but normals need at least 3 neighbours");
  estimation_.setKSearch (24);
  estimation_.setIndices (pcl::make_shared<pcl::Indices> (pcl::Indices{99999}));
  expectRefused ("Index 99999 is outside the input cloud");
  estimation_.setIndices (pcl::IndicesPtr());
  estimation_.setInputCloud (cloud_);
  auto other = pcl::make_shared<pcl::PointCloud<pcl::PointXYZ>> (*cloud_);
  (*other)[3].x += 1.0F;
  estimation_.setSearchSurface (other);
  expectRefused ("Input point 3 is not a point of the search surface");
  estimation_.setSearchSurface (cloud_);
  estimation_.setSearchMethod (pcl::make_shared<pcl::search::KdTree<pcl::PointXYZ>>());
  EXPECT_NE (compute().find ("The search method is not used"), std::string::npos);
  EXPECT_EQ (normals_.size(), cloud_->size());
}

/** \brief What lines are, in short. */
std::vector<std::vector<pcl::crest::index_t>>
pointsOf (const std::vector<pcl::crest::CrestLine>& lines)
{
  std::vector<std::vector<pcl::crest::index_t>> points;
  for (const pcl::crest::CrestLine& line : lines)
    points.insert (points.end(), line.polylines.begin(), line.polylines.end());
  return points;
}

TEST_F (OrientedNormals, CrestLinesNeedNone)
{
  estimation_.setInputCloud (cloud_);
  compute();
  pcl::CrestLineEstimation<pcl::PointXYZ> by_itself;
  by_itself.setInputCloud (cloud_);
  pcl::PointCloud<pcl::Label> labels;
  by_itself.compute (labels);
  ASSERT_EQ (labels.size(), cloud_->size());
  EXPECT_FALSE (by_itself.getLines().empty());
  ASSERT_NE (by_itself.getNormalEstimate(), nullptr);
  for (const pcl::crest::CrestLine& line : by_itself.getLines()) {
    EXPECT_EQ (line.type, pcl::crest::CrestType::RIDGE);
    EXPECT_GE (line.sign_trust, SURE_SIGN);
  }

  pcl::CrestLineEstimation<pcl::PointXYZ> with_normals;
  with_normals.setInputCloud (cloud_);
  with_normals.setInputNormals (
      pcl::make_shared<pcl::PointCloud<pcl::Normal>> (normals_));
  pcl::PointCloud<pcl::Label> same;
  with_normals.compute (same);
  EXPECT_EQ (with_normals.getNormalEstimate(), nullptr);
  EXPECT_EQ (pointsOf (with_normals.getLines()), pointsOf (by_itself.getLines()));

  auto joined = pcl::make_shared<pcl::PointCloud<pcl::PointNormal>>();
  pcl::concatenateFields (*cloud_, normals_, *joined);
  pcl::CrestLineEstimation<pcl::PointNormal> of_points;
  of_points.setInputCloud (joined);
  of_points.compute (same);
  EXPECT_EQ (pointsOf (of_points.getLines()), pointsOf (by_itself.getLines()));
  for (std::size_t i = 0; i < labels.size(); ++i)
    ASSERT_EQ (same[i].label, labels[i].label);
}

TEST_F (OrientedNormals, AnAnalysisKeepsTheNormals)
{
  pcl::CrestLineEstimation<pcl::PointXYZ> estimation;
  estimation.setInputCloud (cloud_);
  estimation.setKeepAnalysis (true);
  pcl::PointCloud<pcl::Label> labels;
  estimation.compute (labels);
  const auto normals = estimation.getNormalEstimate();
  estimation.setAnalysis (estimation.getAnalysis());
  estimation.setTurningAngle (40.0);
  estimation.compute (labels);
  EXPECT_EQ (estimation.getNormalEstimate(), normals);
  estimation.setUpDirection (1.0F, 0.0F, 0.0F);
  testing::internal::CaptureStderr();
  estimation.compute (labels);
  EXPECT_NE (
      testing::internal::GetCapturedStderr().find ("another viewpoint or direction up"),
      std::string::npos);
  EXPECT_TRUE (labels.empty());
}

TEST_F (OrientedNormals, LinesOfUnsureSignsAreFlagged)
{
  pcl::CrestLineEstimation<pcl::PointNormal> estimation;
  estimation.setInputCloud (exact_);
  pcl::PointCloud<pcl::Label> labels;
  estimation.compute (labels);
  const auto lines = pointsOf (estimation.getLines());
  ASSERT_FALSE (lines.empty());
  EXPECT_EQ (estimation.getLines()[0].sign_trust, 1.0);
  estimation.setSignTrust (
      std::make_shared<const std::vector<float>> (exact_->size(), 0.25F));
  estimation.compute (labels);
  EXPECT_EQ (pointsOf (estimation.getLines()), lines);
  EXPECT_NEAR (estimation.getLines()[0].sign_trust, 0.25, 1e-6);
  estimation.setSignTrust (std::make_shared<const std::vector<float>> (3, 1.0F));
  testing::internal::CaptureStderr();
  estimation.compute (labels);
  EXPECT_NE (
      testing::internal::GetCapturedStderr().find ("There are 3 trusts of signs"),
      std::string::npos);
  EXPECT_TRUE (labels.empty());
}

TEST_F (OrientedNormals, OfAnotherNumberAreRefused)
{
  pcl::CrestLineEstimation<pcl::PointXYZ> estimation;
  estimation.setInputCloud (cloud_);
  estimation.setInputNormals (pcl::make_shared<pcl::PointCloud<pcl::Normal>> (5, 1));
  pcl::PointCloud<pcl::Label> labels;
  testing::internal::CaptureStderr();
  estimation.compute (labels);
  EXPECT_NE (testing::internal::GetCapturedStderr().find (
                 "There are 5 input normals for a surface of"),
             std::string::npos);
  EXPECT_TRUE (labels.empty());
}

} // namespace
