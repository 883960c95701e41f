// SPDX-License-Identifier: BSD-3-Clause
// The Feature: what PCL's users expect of its setters, outputs and errors.
#include <pcl_crest/crest_line_estimation.h>

#include <pcl/common/io.h>
#include <pcl/console/print.h>
#include <pcl/search/brute_force.h>
#include <pcl/search/kdtree.h>
#include <pcl/search/octree.h>
#include <pcl/search/organized.h>
#include <pcl/conversions.h>

#include <gtest/gtest.h>

#include "support/analytic_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <new>
#include <random>
#include <stdexcept>
#include <thread>

using namespace pcl::crest;
using Cloud = pcl::PointCloud<pcl::PointNormal>;
using Labels = pcl::PointCloud<pcl::Label>;
using Estimation = pcl::CrestLineEstimation<pcl::PointNormal>;

namespace {

Cloud::Ptr
ridgeAndValley ()
{
  static const Cloud::ConstPtr cloud = oracle::sample (oracle::ridgeAndValley(), 6000);
  return pcl::make_shared<Cloud> (*cloud);
}

std::vector<std::uint32_t>
codes (const Labels& labels)
{
  std::vector<std::uint32_t> result;
  for (const pcl::Label& label : labels)
    result.push_back (label.label);
  return result;
}

std::vector<std::uint32_t>
labelsOf (Estimation& estimation)
{
  Labels labels;
  estimation.compute (labels);
  return codes (labels);
}

std::vector<std::uint32_t>
labelsOf (const Cloud::ConstPtr& cloud, Preset preset = Preset::AUTO)
{
  Estimation estimation;
  estimation.setPreset (preset);
  estimation.setInputCloud (cloud);
  return labelsOf (estimation);
}

/** \brief Expects that compute refuses, says so in words that hold `words`, and leaves
 * nothing in outputs that were full before.
 */
void
expectRefused (Estimation& estimation, const std::string& words)
{
  Labels labels;
  labels.resize (3);
  pcl::PolygonMesh lines;
  lines.polygons.resize (2);
  testing::internal::CaptureStderr();
  estimation.compute (labels, lines);
  const std::string said = testing::internal::GetCapturedStderr();
  EXPECT_NE (said.find (words), std::string::npos) << said;
  EXPECT_NE (said.find ("pcl::CrestLineEstimation"), std::string::npos) << said;
  EXPECT_TRUE (labels.empty());
  EXPECT_EQ (labels.width * labels.height, 0U);
  EXPECT_TRUE (lines.polygons.empty());
  EXPECT_TRUE (lines.cloud.data.empty());
  EXPECT_TRUE (estimation.getLines().empty());
  EXPECT_TRUE (estimation.getPrincipalCurvatures().empty());
}

template <typename PointT>
class OfPointType : public testing::Test {};
using PointTypes = testing::Types<pcl::PointNormal,
                                  pcl::PointXYZINormal,
                                  pcl::PointXYZRGBNormal,
                                  pcl::PointXYZLNormal,
                                  pcl::PointSurfel>;
TYPED_TEST_SUITE (OfPointType, PointTypes);

} // namespace

TYPED_TEST (OfPointType, GivesTheSameLabels)
{
  const Cloud::Ptr cloud = ridgeAndValley();
  const auto typed = pcl::make_shared<pcl::PointCloud<TypeParam>>();
  pcl::copyPointCloud (*cloud, *typed);
  pcl::CrestLineEstimation<TypeParam> estimation;
  estimation.setInputCloud (typed);
  Labels labels;
  estimation.compute (labels);
  EXPECT_EQ (codes (labels), labelsOf (cloud));
}

class OfPreset : public testing::TestWithParam<Preset> {};
INSTANTIATE_TEST_SUITE_P (Both,
                          OfPreset,
                          testing::Values (Preset::AUTO, Preset::PAPER),
                          [] (const auto& info) {
                            return info.param == Preset::AUTO ? "auto" : "paper";
                          });

TEST (CrestLineEstimation, LinesThroughSamplesRunThroughTheSurfaceItself)
{
  const Cloud::Ptr cloud = ridgeAndValley();
  const auto lineCloud = [&] (const Parameters& parameters) {
    Estimation estimation;
    estimation.setParameters (parameters);
    estimation.setInputCloud (cloud);
    Labels labels;
    estimation.compute (labels);
    return estimation.getLineCloud();
  };
  Parameters parameters;
  EXPECT_NE (lineCloud (parameters), cloud);
  parameters.positions = Positions::SAMPLES;
  EXPECT_EQ (lineCloud (parameters), cloud);
  parameters = Parameters();
  parameters.preset = Preset::PAPER;
  EXPECT_EQ (lineCloud (parameters), cloud);
}

TEST_P (OfPreset, LabelsMatchTheLines)
{
  const Cloud::Ptr cloud = ridgeAndValley();
  Estimation estimation;
  estimation.setPreset (GetParam());
  estimation.setInputCloud (cloud);
  Labels labels;
  pcl::PolygonMesh mesh;
  estimation.compute (labels, mesh);
  ASSERT_EQ (labels.size(), cloud->size());
  EXPECT_EQ (mesh.cloud.width * mesh.cloud.height, cloud->size());

  std::vector<bool> on_line (cloud->size(), false);
  std::size_t polylines = 0;
  ASSERT_GE (estimation.getLines().size(), 2U);
  for (const CrestLine& line : estimation.getLines()) {
    double length = 0.0;
    for (const auto& polyline : line.polylines) {
      const pcl::Indices& vertices = mesh.polygons[polylines++].vertices;
      EXPECT_TRUE (std::equal (
          vertices.begin(), vertices.end(), polyline.begin(), polyline.end()));
      for (std::size_t i = 0; i < polyline.size(); ++i) {
        on_line[polyline[i]] = true;
        const std::uint32_t label = labels[polyline[i]].label;
        EXPECT_TRUE (line.type == CrestType::RIDGE
                         ? label == LABEL_RIDGE || label == LABEL_RIDGE_GROWN
                         : label == LABEL_VALLEY || label == LABEL_VALLEY_GROWN);
        if (i > 0)
          length += ((*estimation.getLineCloud())[polyline[i]].getVector3fMap() -
                     (*estimation.getLineCloud())[polyline[i - 1]].getVector3fMap())
                        .norm();
      }
    }
    EXPECT_NEAR (line.length, length, 1e-4 * length);
    EXPECT_GE (line.size, GetParam() == Preset::PAPER ? 10U : 2U);
  }
  EXPECT_EQ (mesh.polygons.size(), polylines);
  for (std::size_t i = 0; i < labels.size(); ++i) {
    const bool grown =
        labels[i].label == LABEL_RIDGE_GROWN || labels[i].label == LABEL_VALLEY_GROWN;
    EXPECT_TRUE (!grown || on_line[i]);
  }
}

TEST (Feature, IndicesRestrictTheLabelsNotTheSurface)
{
  const Cloud::Ptr cloud = ridgeAndValley();
  const std::vector<std::uint32_t> all = labelsOf (cloud);
  const auto indices = pcl::make_shared<pcl::Indices>();
  for (int i = 5990; i > 0; i -= 7)
    if (i < static_cast<int> (cloud->size()))
      indices->push_back (i);
  Estimation estimation;
  estimation.setInputCloud (cloud);
  estimation.setIndices (indices);
  const std::vector<std::uint32_t> some = labelsOf (estimation);
  ASSERT_EQ (some.size(), indices->size());
  for (std::size_t i = 0; i < some.size(); ++i)
    EXPECT_EQ (some[i], all[(*indices)[i]]);
  EXPECT_EQ (estimation.getPrincipalCurvatures().size(), indices->size());
}

TEST (Feature, SearchSurfaceGivesTheGeometry)
{
  const Cloud::Ptr surface = ridgeAndValley();
  const std::vector<std::uint32_t> all = labelsOf (surface);
  const Cloud::Ptr input = pcl::make_shared<Cloud>();
  for (std::size_t i = 0; i < surface->size(); i += 11)
    input->push_back ((*surface)[i]);
  input->push_back (pcl::PointNormal (std::numeric_limits<float>::quiet_NaN(), 0, 0));
  input->is_dense = false;
  Estimation estimation;
  estimation.setInputCloud (input);
  estimation.setSearchSurface (surface);
  Labels labels;
  pcl::PolygonMesh lines;
  estimation.compute (labels, lines);
  ASSERT_EQ (labels.size(), input->size());
  for (std::size_t i = 0; i + 1 < labels.size(); ++i)
    EXPECT_EQ (labels[i].label, all[i * 11]);
  EXPECT_EQ (labels.back().label, LABEL_INVALID);
  EXPECT_EQ (lines.cloud.width, surface->size());
}

TEST (Feature, InputPointsOffTheSearchSurfaceAreRefused)
{
  const Cloud::Ptr surface = ridgeAndValley();
  const Cloud::Ptr input = pcl::make_shared<Cloud> (*surface);
  (*input)[17].z += 0.01F;
  Estimation estimation;
  estimation.setInputCloud (input);
  estimation.setSearchSurface (surface);
  expectRefused (estimation, "Input point 17 is not a point of the search surface");
}

TEST (Feature, EverySearchMethodGivesTheSameLabels)
{
  const Cloud::Ptr cloud = ridgeAndValley();
  const std::vector<std::uint32_t> expected = labelsOf (cloud);
  for (const pcl::search::Search<pcl::PointNormal>::Ptr& method :
       {pcl::search::Search<pcl::PointNormal>::Ptr (
            new pcl::search::KdTree<pcl::PointNormal>),
        pcl::search::Search<pcl::PointNormal>::Ptr (
            new pcl::search::BruteForce<pcl::PointNormal>),
        pcl::search::Search<pcl::PointNormal>::Ptr (
            new pcl::search::Octree<pcl::PointNormal> (0.05))}) {
    Estimation estimation;
    estimation.setInputCloud (cloud);
    estimation.setSearchMethod (method);
    EXPECT_EQ (labelsOf (estimation), expected) << method->getName();
  }
}

TEST (Feature, EverySearchMethodChoosesTheSameOfManyEquallyFar)
{
  const Cloud::Ptr cone = pcl::make_shared<Cloud> (1, 1);
  cone->back().getNormalVector3fMap() = Eigen::Vector3f::UnitZ();
  for (int i = 0; i < 4 * 360; ++i) {
    const double angle = (i % 360) * M_PI / 180.0;
    const Eigen::Vector3d out (std::cos (angle), std::sin (angle), 0.0);
    pcl::PointNormal point;
    point.getVector3fMap() =
        ((1 + i / 360) * (out - Eigen::Vector3d::UnitZ())).cast<float>();
    point.getNormalVector3fMap() =
        (out + Eigen::Vector3d::UnitZ()).normalized().cast<float>();
    cone->push_back (point);
  }
  Estimation estimation;
  estimation.setPreset (Preset::PAPER);
  estimation.setInputCloud (cone);
  estimation.setUseBatchedSearch (true);
  labelsOf (estimation);
  const auto expected = estimation.getPrincipalCurvatures();
  estimation.setUseBatchedSearch (false);
  for (const pcl::search::Search<pcl::PointNormal>::Ptr& method :
       {pcl::search::Search<pcl::PointNormal>::Ptr(),
        pcl::search::Search<pcl::PointNormal>::Ptr (
            new pcl::search::KdTree<pcl::PointNormal>),
        pcl::search::Search<pcl::PointNormal>::Ptr (
            new pcl::search::BruteForce<pcl::PointNormal>),
        pcl::search::Search<pcl::PointNormal>::Ptr (
            new pcl::search::Octree<pcl::PointNormal> (0.05))}) {
    estimation.setSearchMethod (method);
    labelsOf (estimation);
    const auto& found = estimation.getPrincipalCurvatures();
    ASSERT_EQ (found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i)
      EXPECT_TRUE (found[i].pc1 == expected[i].pc1 ||
                   (std::isnan (found[i].pc1) && std::isnan (expected[i].pc1)))
          << i;
  }
}

TEST (Feature, RadiusTakesThePlaceOfK)
{
  const Cloud::Ptr cloud = ridgeAndValley();
  // The quadrant filter needs only the nearest: a radius that holds some 24 points.
  Estimation estimation;
  estimation.setInputCloud (cloud);
  const double radius = 3.0 * oracle::meanSpacing (*cloud);
  estimation.setRadiusSearch (radius);
  const std::vector<std::uint32_t> by_radius = labelsOf (estimation);
  const std::vector<std::uint32_t> by_k = labelsOf (cloud);
  std::size_t different = 0;
  for (std::size_t i = 0; i < by_k.size(); ++i)
    different += by_k[i] != by_radius[i] ? 1 : 0;
  EXPECT_LT (different, by_k.size() / 50);
  // A radius that reaches no one leaves no star to fit a quadric to.
  estimation.setRadiusSearch (1e-6);
  for (const std::uint32_t label : labelsOf (estimation))
    EXPECT_EQ (label, LABEL_INVALID);
}

TEST (Feature, ARadiusCanBeSetAfterAllParameters)
{
  const Cloud::Ptr cloud = ridgeAndValley();
  const double radius = 3.0 * oracle::meanSpacing (*cloud);
  Estimation by_radius;
  by_radius.setInputCloud (cloud);
  by_radius.setRadiusSearch (radius);
  const std::vector<std::uint32_t> expected = labelsOf (by_radius);
  Parameters parameters;
  for (const int k : {parameters.k, 16}) {
    parameters.k = k;
    Estimation estimation;
    estimation.setInputCloud (cloud);
    estimation.setParameters (parameters);
    EXPECT_EQ (estimation.getParameters().k, k);
    estimation.setRadiusSearch (radius);
    EXPECT_EQ (labelsOf (estimation), expected);
    estimation.setRadiusSearch (0.0);
    EXPECT_EQ (estimation.getParameters().k, k);
  }
}

TEST (Feature, ARadiusThatHoldsTooManyIsRefused)
{
  const Cloud::Ptr cloud = ridgeAndValley();
  Estimation estimation;
  estimation.setInputCloud (cloud);
  estimation.setRadiusSearch (1000.0);
  const std::string words = "radius of 1000 holds " + std::to_string (cloud->size()) +
                            " points around one of them, but must hold at most 1000";
  for (const unsigned threads : {1U, 2U}) {
    estimation.setNumberOfThreads (threads);
    expectRefused (estimation, words);
  }
  estimation.setSearchMethod (
      pcl::make_shared<pcl::search::KdTree<pcl::PointNormal>>());
  expectRefused (estimation, words);
}

TEST (Feature, CopiesOfAPointAreNotTooManyForARadius)
{
  const Cloud::Ptr cloud = ridgeAndValley();
  Estimation estimation;
  estimation.setInputCloud (cloud);
  estimation.setRadiusSearch (3.0 * oracle::meanSpacing (*cloud));
  estimation.setSearchMethod (
      pcl::make_shared<pcl::search::KdTree<pcl::PointNormal>>());
  const std::vector<std::uint32_t> expected = labelsOf (estimation);
  const pcl::PointNormal again = (*cloud)[100];
  for (int i = 0; i < 2000; ++i)
    cloud->push_back (again);
  const std::vector<std::uint32_t> labels = labelsOf (estimation);
  ASSERT_EQ (labels.size(), cloud->size());
  EXPECT_TRUE (std::equal (expected.begin(), expected.end(), labels.begin()));
}

TEST (Feature, TheBatchedSearchGivesTheSameLabels)
{
  Estimation estimation;
  estimation.setInputCloud (ridgeAndValley());
  const std::vector<std::uint32_t> expected = labelsOf (estimation);
  estimation.setUseBatchedSearch (true);
  EXPECT_EQ (labelsOf (estimation), expected);
  // It has no radius: that stays with the KdTree.
  estimation.setRadiusSearch (3.0 * oracle::meanSpacing (*ridgeAndValley()));
  const std::vector<std::uint32_t> by_radius = labelsOf (estimation);
  estimation.setUseBatchedSearch (false);
  EXPECT_EQ (labelsOf (estimation), by_radius);
}

TEST (Feature, TheBatchedSearchBesideASearchMethodIsRefused)
{
  Estimation estimation;
  estimation.setInputCloud (ridgeAndValley());
  estimation.setSearchMethod (
      pcl::make_shared<pcl::search::KdTree<pcl::PointNormal>>());
  estimation.setUseBatchedSearch (true);
  expectRefused (estimation, "Both a search method and the batched search are set");
  estimation.setUseBatchedSearch (false);
  EXPECT_FALSE (labelsOf (estimation).empty());
}

TEST (Feature, CurvaturesAreThoseOfASphere)
{
  const Cloud::Ptr cloud = oracle::sample (oracle::sphere (2.0), 8000);
  Estimation estimation;
  estimation.setInputCloud (cloud);
  // Where the preset auto takes what a coarse cubic misses of a sphere for a likely
  // crest, it has the curvature of that.
  labelsOf (estimation);
  std::size_t coarse = 0;
  for (const pcl::PrincipalCurvatures& k : estimation.getPrincipalCurvatures()) {
    coarse += std::abs (k.pc1 - 0.5F) > 5e-3F ? 1 : 0;
    EXPECT_NEAR (k.pc1, 0.5F, 0.06F);
  }
  EXPECT_LT (coarse, cloud->size() / 10);
  estimation.setPreset (Preset::PAPER);
  labelsOf (estimation);
  const auto& curvatures = estimation.getPrincipalCurvatures();
  ASSERT_EQ (curvatures.size(), cloud->size());
  for (std::size_t i = 0; i < curvatures.size(); ++i) {
    EXPECT_NEAR (curvatures[i].pc1, 0.5F, 5e-3F);
    EXPECT_NEAR (curvatures[i].pc2, 0.5F, 5e-3F);
    const Eigen::Vector3f direction (curvatures[i].principal_curvature_x,
                                     curvatures[i].principal_curvature_y,
                                     curvatures[i].principal_curvature_z);
    EXPECT_NEAR (direction.norm(), 1.0F, 1e-4F);
    EXPECT_NEAR (direction.dot ((*cloud)[i].getNormalVector3fMap()), 0.0F, 1e-4F);
  }
}

TEST (Feature, OneTypeAloneIsThatOfBoth)
{
  const Cloud::Ptr cloud = ridgeAndValley();
  Estimation both;
  both.setInputCloud (cloud);
  const std::vector<std::uint32_t> all = labelsOf (both);
  Estimation ridges;
  ridges.setInputCloud (cloud);
  ridges.setWantedTypes (true, false);
  const std::vector<std::uint32_t> only = labelsOf (ridges);
  for (std::size_t i = 0; i < all.size(); ++i)
    EXPECT_EQ (only[i],
               all[i] == LABEL_VALLEY || all[i] == LABEL_VALLEY_GROWN ? LABEL_NONE
                                                                      : all[i]);
  std::size_t expected = 0;
  for (const CrestLine& line : both.getLines())
    expected += line.type == CrestType::RIDGE ? 1 : 0;
  EXPECT_EQ (ridges.getLines().size(), expected);
  EXPECT_TRUE (ridges.getStatistics().line_sizes.valley.empty());
}

TEST (Feature, SizesTellWhatSRemoved)
{
  const Cloud::Ptr cloud = ridgeAndValley();
  Estimation estimation;
  estimation.setPreset (Preset::PAPER);
  estimation.setInputCloud (cloud);
  estimation.setMinSize (0);
  labelsOf (estimation);
  const std::size_t all = estimation.getLines().size();
  const auto before = estimation.getStatistics().line_sizes;
  estimation.setRidgeMinSize (60);
  estimation.setValleyMinSize (20);
  labelsOf (estimation);
  const auto after = estimation.getStatistics().line_sizes;
  EXPECT_EQ (before.ridge, after.ridge);
  EXPECT_EQ (before.valley, after.valley);
  std::size_t counted = 0;
  std::size_t left = 0;
  for (const CrestType type : CREST_TYPES)
    for (const auto& [size, count] : before[type]) {
      counted += count;
      left += size >= (type == CrestType::RIDGE ? 60U : 20U) ? count : 0;
    }
  EXPECT_EQ (counted, all);
  EXPECT_EQ (estimation.getLines().size(), left);
  EXPECT_LT (left, all);
}

TEST (Feature, InvalidPointsAreLabelledAndDoNotDisturb)
{
  const Cloud::Ptr cloud = ridgeAndValley();
  const std::vector<std::uint32_t> expected = labelsOf (cloud);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const Cloud::Ptr with_holes = pcl::make_shared<Cloud> (*cloud);
  pcl::PointNormal nowhere (nan, nan, nan);
  pcl::PointNormal without_normal (0.1F, 0.1F, 0.1F);
  with_holes->insert (with_holes->begin(), nowhere);
  with_holes->push_back (without_normal);
  // A cloud that lies about being dense is no reason to crash.
  for (const bool dense : {false, true}) {
    with_holes->is_dense = dense;
    std::vector<std::uint32_t> labels = labelsOf (with_holes);
    ASSERT_EQ (labels.size(), expected.size() + 2);
    EXPECT_EQ (labels.front(), LABEL_INVALID);
    EXPECT_EQ (labels.back(), LABEL_INVALID);
    EXPECT_EQ (std::vector<std::uint32_t> (labels.begin() + 1, labels.end() - 1),
               expected);
  }
}

TEST (Feature, OwnSearchMethodOnACloudThatLiesAboutBeingDense)
{
  const Cloud::Ptr cloud = ridgeAndValley();
  (*cloud)[5].x = std::numeric_limits<float>::infinity();
  cloud->is_dense = true;
  Estimation estimation;
  estimation.setInputCloud (cloud);
  estimation.setSearchMethod (
      pcl::make_shared<pcl::search::KdTree<pcl::PointNormal>>());
  expectRefused (estimation, "Point 5 is not finite");
  cloud->is_dense = false;
  EXPECT_EQ (labelsOf (estimation).at (5), LABEL_INVALID);
}

TEST (Feature, SearchMethodOfACloudThatHasChanged)
{
  const Cloud::Ptr cloud = ridgeAndValley();
  const auto tree = pcl::make_shared<pcl::search::KdTree<pcl::PointNormal>>();
  tree->setInputCloud (cloud);
  const Cloud::Ptr other = oracle::sample (oracle::wavyRidge(), 2000);
  *cloud = *other;
  Estimation estimation;
  estimation.setInputCloud (cloud);
  estimation.setSearchMethod (tree);
  EXPECT_EQ (labelsOf (estimation), labelsOf (other));
}

/** \brief Searches another cloud than the one it is given. */
class ForgetfulSearch : public pcl::search::BruteForce<pcl::PointNormal> {
public:
  using Base = pcl::search::BruteForce<pcl::PointNormal>;
  int
  nearestKSearch (const pcl::PointNormal& point,
                  int k,
                  pcl::Indices& found,
                  std::vector<float>& distances) const override
  {
    const int count = Base::nearestKSearch (point, k, found, distances);
    found.front() = 1000000;
    return count;
  }
};

TEST (Feature, SearchMethodThatReturnsStrangeIndices)
{
  Estimation estimation;
  estimation.setInputCloud (oracle::sample (oracle::wavyRidge(), 500));
  estimation.setSearchMethod (pcl::make_shared<ForgetfulSearch>());
  expectRefused (estimation, "returned points outside the cloud");
}

/** \brief Returns fewer distances than points. */
class CarelessSearch : public pcl::search::BruteForce<pcl::PointNormal> {
public:
  using Base = pcl::search::BruteForce<pcl::PointNormal>;
  explicit CarelessSearch (std::size_t distances) : distances_ (distances) {}

  int
  nearestKSearch (const pcl::PointNormal& point,
                  int k,
                  pcl::Indices& found,
                  std::vector<float>& distances) const override
  {
    const int count = Base::nearestKSearch (point, k, found, distances);
    distances.resize (distances_);
    return count;
  }

private:
  std::size_t distances_;
};

TEST (Feature, SearchMethodThatReturnsFewDistances)
{
  Estimation estimation;
  estimation.setInputCloud (oracle::sample (oracle::wavyRidge(), 500));
  for (const std::size_t distances : {0U, 3U}) {
    estimation.setSearchMethod (pcl::make_shared<CarelessSearch> (distances));
    expectRefused (estimation,
                   "The search method failed: it returned 25 points with " +
                       std::to_string (distances) + " distances");
  }
}

/** \brief Throws what it is given. */
template <typename Exception>
class ThrowingSearch : public pcl::search::BruteForce<pcl::PointNormal> {
public:
  explicit ThrowingSearch (Exception exception) : exception_ (std::move (exception)) {}

  int
  nearestKSearch (const pcl::PointNormal&,
                  int,
                  pcl::Indices&,
                  std::vector<float>&) const override
  {
    throw exception_;
  }

private:
  Exception exception_;
};

/** \brief Takes no cloud. */
class UnwillingSearch : public pcl::search::BruteForce<pcl::PointNormal> {
public:
  using Base = pcl::search::BruteForce<pcl::PointNormal>;
  // Not the same in all versions of PCL.
  using Taken = decltype (std::declval<Base&>().setInputCloud (Cloud::ConstPtr(),
                                                               pcl::IndicesConstPtr()));

  Taken
  setInputCloud (const Cloud::ConstPtr&, const pcl::IndicesConstPtr&) override
  {
    throw std::runtime_error ("out of luck");
  }
};

TEST (Feature, SearchMethodThatThrows)
{
  Estimation estimation;
  estimation.setInputCloud (ridgeAndValley());
  for (const unsigned threads : {1U, 2U}) {
    estimation.setNumberOfThreads (threads);
    estimation.setSearchMethod (pcl::make_shared<ThrowingSearch<std::runtime_error>> (
        std::runtime_error ("out of luck")));
    expectRefused (estimation, "The search method failed: out of luck");
    estimation.setSearchMethod (pcl::make_shared<ThrowingSearch<int>> (7));
    expectRefused (estimation, "The search method failed: it threw no std::exception");
    estimation.setSearchMethod (pcl::make_shared<UnwillingSearch>());
    expectRefused (estimation, "The search method failed: out of luck");
  }
  estimation.setSearchMethod (nullptr);
  EXPECT_EQ (labelsOf (estimation), labelsOf (ridgeAndValley()));
}

TEST (Feature, MemoryThatDoesNotSufficeLeavesNothing)
{
  Estimation estimation;
  estimation.setInputCloud (ridgeAndValley());
  labelsOf (estimation);
  estimation.setSearchMethod (
      pcl::make_shared<ThrowingSearch<std::bad_alloc>> (std::bad_alloc()));
  Labels labels;
  pcl::PolygonMesh lines;
  lines.polygons.resize (2);
  EXPECT_THROW (estimation.compute (labels, lines), std::bad_alloc);
  EXPECT_TRUE (labels.empty());
  EXPECT_EQ (labels.width * labels.height, 0U);
  EXPECT_TRUE (lines.polygons.empty());
  EXPECT_TRUE (estimation.getLines().empty());
  EXPECT_TRUE (estimation.getPrincipalCurvatures().empty());
}

TEST (Feature, OrganizedSearchOfAnUnorganizedCloudIsRefused)
{
  Estimation estimation;
  estimation.setInputCloud (ridgeAndValley());
  estimation.setSearchMethod (
      pcl::make_shared<pcl::search::OrganizedNeighbor<pcl::PointNormal>>());
  expectRefused (estimation, "OrganizedNeighbor cannot search this cloud");
}

TEST_P (OfPreset, LargestAndSmallestUnitsGiveTheSameLabels)
{
  const Cloud::Ptr cloud = ridgeAndValley();
  const std::vector<std::uint32_t> expected = labelsOf (cloud, GetParam());
  for (const float scale : {std::ldexp (1.0F, 120), std::ldexp (1.0F, -100)}) {
    const Cloud::Ptr scaled = pcl::make_shared<Cloud> (*cloud);
    for (pcl::PointNormal& point : *scaled)
      point.getVector3fMap() *= scale;
    EXPECT_EQ (labelsOf (scaled, GetParam()), expected) << scale;
  }
}

TEST_P (OfPreset, StraysDoNotDisturbTheOthers)
{
  const Cloud::Ptr cloud = ridgeAndValley();
  const std::vector<std::uint32_t> expected = labelsOf (cloud, GetParam());
  for (const float far : {1e5F, std::numeric_limits<float>::max()})
    for (const std::size_t strays : {1U, 40U}) {
      const Cloud::Ptr with_strays = pcl::make_shared<Cloud> (*cloud);
      for (std::size_t i = 0; i < strays; ++i) {
        pcl::PointNormal stray = (*cloud)[i];
        // Some on the other side, so that they are more than any float apart.
        stray.data[i % 3] = i % 2 == 0 ? far : -far;
        with_strays->push_back (stray);
      }
      std::vector<std::uint32_t> found = labelsOf (with_strays, GetParam());
      ASSERT_EQ (expected.size() + strays, found.size());
      for (std::size_t i = 0; i < strays; ++i)
        EXPECT_EQ (LABEL_INVALID, found[expected.size() + i]);
      found.resize (expected.size());
      EXPECT_EQ (expected, found) << far << " " << strays;
    }
}

TEST_P (OfPreset, CloudsThatFloatsDoNotMeasureAreRefused)
{
  Estimation estimation;
  estimation.setPreset (GetParam());
  const Cloud::Ptr cloud = ridgeAndValley();
  const Eigen::Vector3f first = (*cloud)[0].getVector3fMap();
  float width = 0.0F;
  for (const pcl::PointNormal& point : *cloud)
    width = std::max (width, (point.getVector3fMap() - first).cwiseAbs().maxCoeff());
  // From one side to the other more than the largest float, less than the least
  // whose inverse is one, or hardly any bits.
  for (const float scale :
       {std::numeric_limits<float>::max() / width, 1e-36F, 1e-39F, 1e-43F}) {
    const Cloud::Ptr scaled = pcl::make_shared<Cloud> (*cloud);
    for (pcl::PointNormal& point : *scaled)
      point.getVector3fMap() = scale * (point.getVector3fMap() - first);
    if (scale > 1.0F)
      for (std::size_t i = 0; i < scaled->size(); i += 2)
        (*scaled)[i].getVector3fMap() *= -1.0F;
    estimation.setInputCloud (scaled);
    expectRefused (estimation, "for floats to hold its lengths and curvatures");
  }
}

TEST (Feature, PruneSizeDecidesWhichBranchesStay)
{
  const Cloud::Ptr cloud = oracle::sample (oracle::bumpySphere(), 6000);
  const auto shortestBranch = [&] (int prune) {
    Estimation estimation;
    estimation.setPreset (Preset::PAPER);
    estimation.setInputCloud (cloud);
    estimation.setPruneSize (prune);
    labelsOf (estimation);
    std::size_t shortest = 1000;
    for (const CrestLine& line : estimation.getLines()) {
      std::map<pcl::index_t, int> ends;
      for (const auto& polyline : line.polylines) {
        ++ends[polyline.front()];
        ++ends[polyline.back()];
      }
      for (const auto& polyline : line.polylines)
        if (line.polylines.size() > 1 &&
            (ends[polyline.front()] == 1 || ends[polyline.back()] == 1))
          shortest = std::min (shortest, polyline.size() - 1);
    }
    return shortest;
  };
  EXPECT_EQ (shortestBranch (0), 2U);
  EXPECT_EQ (shortestBranch (4), 5U);
  EXPECT_GT (shortestBranch (10), 10U);
}

TEST (Feature, CloudThatChangedBehindTheSamePointer)
{
  const Cloud::Ptr cloud = ridgeAndValley();
  Estimation estimation;
  estimation.setInputCloud (cloud);
  labelsOf (estimation);
  cloud->resize (cloud->size() / 2);
  EXPECT_EQ (labelsOf (estimation), labelsOf (pcl::make_shared<Cloud> (*cloud)));
}

TEST (Feature, CoincidentPointsShareTheirLabel)
{
  const Cloud::Ptr cloud = ridgeAndValley();
  const std::vector<std::uint32_t> expected = labelsOf (cloud);
  const Cloud::Ptr twice = pcl::make_shared<Cloud> (*cloud);
  *twice += *cloud;
  const std::vector<std::uint32_t> labels = labelsOf (twice);
  EXPECT_EQ (std::vector<std::uint32_t> (
                 labels.begin(), labels.begin() + static_cast<long> (cloud->size())),
             expected);
  EXPECT_EQ (std::vector<std::uint32_t> (
                 labels.begin() + static_cast<long> (cloud->size()), labels.end()),
             expected);
}

TEST (Feature, FiftyThousandCoincidentPointsAreOne)
{
  const Cloud::Ptr cloud = ridgeAndValley();
  const std::vector<std::uint32_t> expected = labelsOf (cloud);
  const pcl::PointNormal again = (*cloud)[100];
  for (int i = 0; i < 50000; ++i)
    cloud->push_back (again);
  const std::vector<std::uint32_t> labels = labelsOf (cloud);
  EXPECT_TRUE (std::equal (expected.begin(), expected.end(), labels.begin()));
  EXPECT_EQ (labels.back(), expected[100]);
}

TEST (Feature, ACloudWithoutWidthAndHeightIsOneRow)
{
  const Cloud::Ptr cloud = ridgeAndValley();
  const auto labelsOf = [&cloud] {
    Estimation estimation;
    estimation.setInputCloud (cloud);
    Labels labels;
    estimation.compute (labels);
    return labels;
  };
  const Labels expected = labelsOf();
  cloud->width = 0;
  cloud->height = 0;
  const Labels labels = labelsOf();
  EXPECT_EQ (labels.width, cloud->size());
  EXPECT_EQ (labels.height, 1U);
  ASSERT_EQ (labels.size(), expected.size());
  for (std::size_t i = 0; i < labels.size(); ++i)
    ASSERT_EQ (labels[i].label, expected[i].label) << i;
}

TEST (Feature, OrganizedCloudWithHoles)
{
  // A depth camera at the origin looks at a wavy wall; some pixels see nothing.
  const Cloud::Ptr cloud = pcl::make_shared<Cloud> (96, 72);
  cloud->is_dense = false;
  const float nan = std::numeric_limits<float>::quiet_NaN();
  std::mt19937 random (4);
  for (std::uint32_t row = 0; row < cloud->height; ++row)
    for (std::uint32_t column = 0; column < cloud->width; ++column) {
      const float x = (static_cast<float> (column) - 47.2F) / 60.0F;
      const float y = (static_cast<float> (row) - 35.5F) / 60.0F;
      const float depth = 2.0F - 0.15F * std::exp (-(x * x) / (2.0F * 0.05F * 0.05F));
      pcl::PointNormal point (x * depth, y * depth, depth);
      const float slope = 0.15F * x / (0.05F * 0.05F) *
                          std::exp (-(x * x) / (2.0F * 0.05F * 0.05F)) / depth;
      point.getNormalVector3fMap() = Eigen::Vector3f (slope, 0.0F, -1.0F).normalized();
      if (random() % 10 == 0)
        point.x = point.y = point.z = nan;
      cloud->at (column, row) = point;
    }
  Estimation estimation;
  estimation.setInputCloud (cloud);
  Labels labels;
  estimation.compute (labels);
  EXPECT_EQ (labels.width, cloud->width);
  EXPECT_EQ (labels.height, cloud->height);
  EXPECT_EQ (estimation.getPrincipalCurvatures().width, cloud->width);
  EXPECT_EQ (estimation.getPrincipalCurvatures().height, cloud->height);
  EXPECT_FALSE (estimation.getPrincipalCurvatures().is_dense);
  std::size_t ridge_in_the_middle = 0;
  for (std::uint32_t row = 0; row < cloud->height; ++row)
    for (std::uint32_t column = 0; column < cloud->width; ++column) {
      const bool hole = !std::isfinite (cloud->at (column, row).x);
      EXPECT_EQ (labels.at (column, row).label == LABEL_INVALID, hole);
      if (labels.at (column, row).label == LABEL_RIDGE && column >= 46 && column <= 49)
        ++ridge_in_the_middle;
    }
  EXPECT_GT (ridge_in_the_middle, 60U);

  Estimation organized;
  organized.setInputCloud (cloud);
  organized.setSearchMethod (
      pcl::make_shared<pcl::search::OrganizedNeighbor<pcl::PointNormal>>());
  const std::vector<std::uint32_t> other = labelsOf (organized);
  std::size_t different = 0;
  for (std::size_t i = 0; i < other.size(); ++i)
    different += other[i] != labels[i].label ? 1 : 0;
  EXPECT_LE (different, labels.size() / 100);
}

TEST (Feature, SRemovesLinesOfAutoOnlyWhereItIsSet)
{
  const Cloud::Ptr cloud = oracle::sample (oracle::bumpySphere(), 6000);
  Estimation estimation;
  estimation.setInputCloud (cloud);
  labelsOf (estimation);
  std::size_t kept = 0;
  for (const auto& [size, count] : estimation.getStatistics().line_sizes.ridge)
    kept += count;
  std::map<std::size_t, std::size_t> sizes;
  for (const CrestLine& line : estimation.getLines())
    if (line.type == CrestType::RIDGE)
      ++sizes[line.size];
  EXPECT_EQ (sizes, estimation.getStatistics().line_sizes.ridge);
  ASSERT_GE (sizes.size(), 2U);
  estimation.setRidgeMinSize (static_cast<int> (sizes.rbegin()->first));
  labelsOf (estimation);
  for (const CrestLine& line : estimation.getLines()) {
    EXPECT_TRUE (line.type == CrestType::VALLEY || line.size == sizes.rbegin()->first);
  }
}

TEST (Feature, DegenerateCloudsGiveACorrectEmptyResult)
{
  const auto cloudOf = [] (std::size_t size, const auto& position) {
    Cloud::Ptr cloud = pcl::make_shared<Cloud>();
    for (std::size_t i = 0; i < size; ++i) {
      pcl::PointNormal point;
      point.getVector3fMap() = position (static_cast<float> (i));
      point.normal_z = 1.0F;
      cloud->push_back (point);
    }
    return cloud;
  };
  using V = Eigen::Vector3f;
  const auto same = [] (float) { return V (1, 2, 3); };
  const auto on_a_line = [] (float i) { return V (i, 2 * i, 0); };
  const auto on_a_plane = [] (float i) {
    return V (std::fmod (i, 10.0F), std::floor (i / 10.0F), 0);
  };
  for (const Cloud::Ptr& cloud : {cloudOf (1, same),
                                  cloudOf (100, same),
                                  cloudOf (3, on_a_plane),
                                  cloudOf (100, on_a_line)})
    for (const std::uint32_t label : labelsOf (cloud))
      EXPECT_EQ (label, LABEL_INVALID) << cloud->size();
  // Fewer points than k are no hindrance; a plane has curvature, zero, and no crest.
  for (const Cloud::Ptr& cloud : {cloudOf (20, on_a_plane), cloudOf (100, on_a_plane)})
    for (const std::uint32_t label : labelsOf (cloud))
      EXPECT_EQ (label, LABEL_NONE) << cloud->size();
}

TEST (Feature, AllPointsInvalidIsNoMistake)
{
  const Cloud::Ptr cloud = pcl::make_shared<Cloud> (10, 1);
  Estimation estimation;
  estimation.setInputCloud (cloud);
  Labels labels;
  pcl::PolygonMesh lines;
  testing::internal::CaptureStderr();
  estimation.compute (labels, lines);
  const std::string said = testing::internal::GetCapturedStderr();
  EXPECT_NE (said.find ("No three points span a plane"), std::string::npos) << said;
  EXPECT_EQ (codes (labels), std::vector<std::uint32_t> (10, LABEL_INVALID));
  EXPECT_TRUE (lines.polygons.empty());
}

TEST (Feature, ARadiusThatIsTooSmallIsSaid)
{
  Estimation estimation;
  estimation.setInputCloud (ridgeAndValley());
  estimation.setRadiusSearch (1e-6);
  Labels labels;
  testing::internal::CaptureStderr();
  estimation.compute (labels);
  const std::string said = testing::internal::GetCapturedStderr();
  EXPECT_NE (said.find ("enough neighbours within the radius of 1e-06"),
             std::string::npos)
      << said;
}

TEST (Feature, MistakesAreRefusedInWords)
{
  const Cloud::Ptr cloud = ridgeAndValley();
  {
    Estimation estimation;
    expectRefused (estimation, "call setInputCloud first");
  }
  {
    Estimation estimation;
    estimation.setInputCloud (pcl::make_shared<Cloud>());
    expectRefused (estimation, "The input cloud is empty");
  }
  for (const std::array<std::uint32_t, 2> size :
       {std::array<std::uint32_t, 2>{1, 1}, {3, 2}, {70000, 70000}}) {
    const Cloud::Ptr contradictory = ridgeAndValley();
    contradictory->width = size[0];
    contradictory->height = size[1];
    Estimation estimation;
    estimation.setInputCloud (contradictory);
    expectRefused (estimation,
                   "has a width of " + std::to_string (size[0]) + " and a height of " +
                       std::to_string (size[1]));
  }
  const auto refused = [&] (const auto& set, const std::string& words) {
    Estimation estimation;
    estimation.setInputCloud (cloud);
    set (estimation);
    expectRefused (estimation, words);
  };
  refused ([] (Estimation& e) { e.setSearchSurface (pcl::make_shared<Cloud>()); },
           "The search surface is empty");
  refused (
      [] (Estimation& e) {
        e.setKSearch (10);
        e.setRadiusSearch (0.1);
      },
      "Both k (10) and a radius (0.1");
  refused ([] (Estimation& e) { e.setKSearch (3); }, "k is 3, but must be from 4");
  refused ([] (Estimation& e) { e.setKSearch (-5); }, "k is -5");
  refused ([] (Estimation& e) { e.setKSearch (2147483647); }, "k is 2147483647");
  refused ([] (Estimation& e) { e.setRadiusSearch (-1.0); }, "search radius is -1");
  refused (
      [] (Estimation& e) {
        e.setPreset (Preset::PAPER);
        e.setMaximality (-0.5);
      },
      "M is -0.5");
  refused ([] (Estimation& e) { e.setMinSize (-1); }, "S is -1");
  refused (
      [] (Estimation& e) {
        e.setPreset (Preset::PAPER);
        e.setPruneSize (-1);
      },
      "branch to prune is -1");
  refused ([] (Estimation& e) { e.setTurningAngle (181); }, "turning angle is 181");
  refused ([] (Estimation& e) { e.setMinLength (-1); }, "least length of a line is -1");
  refused ([] (Estimation& e) { e.setConfidence (NAN); }, "the confidence is nan");
  refused ([] (Estimation& e) { e.setPointsPerQuadrant (0); },
           "points per quadrant is 0");
  refused ([] (Estimation& e) { e.setMaxNormalAngle (0.0); }, "normals is 0");
  refused ([] (Estimation& e) { e.setNumberOfThreads (100000); },
           "the number of threads is 100000, but must be at most 1024");
  refused ([] (Estimation& e) { e.setWantedTypes (false, false); },
           "neither ridges nor valleys");
  refused (
      [&] (Estimation& e) {
        e.setIndices (pcl::make_shared<pcl::Indices> (1, 1000000));
      },
      "Index 1000000 is outside the input cloud");
}

TEST (Feature, WhatBelongsToTheOtherPresetIsRefused)
{
  const auto refused = [] (Preset preset, const auto& set, const std::string& words) {
    Estimation estimation;
    estimation.setInputCloud (ridgeAndValley());
    estimation.setPreset (preset);
    set (estimation);
    expectRefused (estimation, words);
  };
  const auto refusedByAuto = [&] (const auto& set, const std::string& name) {
    refused (Preset::AUTO,
             set,
             name + " is set, but belongs to the preset paper: choose that with "
                    "setPreset (Preset::PAPER)");
  };
  const auto refusedByPaper = [&] (const auto& set, const std::string& name) {
    refused (Preset::PAPER,
             set,
             name + " is set, but belongs to the preset auto: choose that with "
                    "setPreset (Preset::AUTO)");
  };
  refusedByAuto ([] (Estimation& e) { e.setMaximality (1.0); }, "M");
  refusedByAuto ([] (Estimation& e) { e.setValleyMaximality (1.0); }, "M");
  refusedByAuto ([] (Estimation& e) { e.setAbsoluteMaximality (true); }, "unit of M");
  refusedByAuto ([] (Estimation& e) { e.setPruneSize (5); }, "largest branch to prune");
  refusedByPaper ([] (Estimation& e) { e.setTurningAngle (30); }, "turning angle");
  refusedByPaper ([] (Estimation& e) { e.setMinLength (8); }, "least length of a line");
  refusedByPaper ([] (Estimation& e) { e.setConfidence (3); }, "the confidence");
  refusedByPaper ([] (Estimation& e) { e.setPositions (Positions::SAMPLES); },
                  "where lines run");
}

TEST (Feature, TwoObjectsWorkInTwoThreads)
{
  const std::array<Cloud::ConstPtr, 2> clouds{
      ridgeAndValley(), oracle::sample (oracle::bumpySphere(), 3000)};
  std::array<std::vector<std::uint32_t>, 2> found;
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < clouds.size(); ++i)
    threads.emplace_back ([&, i] { found[i] = labelsOf (clouds[i]); });
  for (std::thread& thread : threads)
    thread.join();
  for (std::size_t i = 0; i < clouds.size(); ++i)
    EXPECT_EQ (labelsOf (clouds[i]), found[i]);
}

TEST (Feature, AfterAMistakeTheNextComputeWorks)
{
  const Cloud::Ptr cloud = ridgeAndValley();
  Estimation estimation;
  estimation.setInputCloud (cloud);
  estimation.setTurningAngle (-1.0);
  expectRefused (estimation, "turning angle is -1");
  estimation.setTurningAngle (Parameters().angle);
  EXPECT_EQ (labelsOf (estimation), labelsOf (cloud));
}

TEST (Feature, TheTypeWhoseThresholdIsWrongIsNamed)
{
  const auto refused = [] (const auto& set, const std::string& words) {
    Estimation estimation;
    estimation.setInputCloud (ridgeAndValley());
    estimation.setPreset (Preset::PAPER);
    set (estimation);
    expectRefused (estimation, words);
  };
  refused ([] (Estimation& e) { e.setRidgeMaximality (-2.0); }, "M of ridges is -2");
  refused ([] (Estimation& e) { e.setValleyMaximality (NAN); }, "M of valleys is nan");
  refused ([] (Estimation& e) { e.setRidgeMinSize (-2); }, "S of ridges is -2");
  refused ([] (Estimation& e) { e.setValleyMinSize (-3); }, "S of valleys is -3");
}

TEST (Feature, MinStrengthRemovesTheWeakerLines)
{
  Estimation estimation;
  estimation.setInputCloud (oracle::sample (oracle::bumpySphere(), 6000));
  labelsOf (estimation);
  const std::vector<CrestLine> all = estimation.getLines();
  const auto [weakest, strongest] = std::minmax_element (
      all.begin(), all.end(), [] (const CrestLine& a, const CrestLine& b) {
        return a.strength < b.strength;
      });
  ASSERT_NE (weakest, strongest);
  const double limit = 0.5 * (weakest->strength + strongest->strength);
  estimation.setMinStrength (limit);
  labelsOf (estimation);
  std::vector<std::vector<std::vector<pcl::index_t>>> expected, left;
  for (const CrestLine& line : all)
    if (line.strength >= limit)
      expected.push_back (line.polylines);
  for (const CrestLine& line : estimation.getLines())
    left.push_back (line.polylines);
  EXPECT_EQ (left, expected);
}

TEST (Feature, RidgeMaximalityLeavesValleysAlone)
{
  const auto linesAt = [] (double ridge, double valley) {
    Estimation estimation;
    estimation.setPreset (Preset::PAPER);
    estimation.setInputCloud (ridgeAndValley());
    estimation.setMaximality (valley);
    estimation.setRidgeMaximality (ridge);
    labelsOf (estimation);
    PerType<std::vector<std::vector<std::vector<pcl::index_t>>>> lines;
    for (const CrestLine& line : estimation.getLines())
      lines[line.type].push_back (line.polylines);
    return lines;
  };
  const auto low = linesAt (0.01, 0.01);
  const auto high = linesAt (5.0, 5.0);
  ASSERT_NE (low.ridge, high.ridge);
  ASSERT_NE (low.valley, high.valley);
  const auto mixed = linesAt (5.0, 0.01);
  EXPECT_EQ (mixed.ridge, high.ridge);
  EXPECT_EQ (mixed.valley, low.valley);
}
