// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_crest/visualization/view.h>

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <cmath>
#include <fstream>

using namespace pcl::crest;

namespace {

const Eigen::Vector2i SIZE{800, 600};

/** The corners of a box, all with one normal. */
pcl::PointCloud<pcl::PointNormal>
box (const Eigen::Vector3f& low,
     const Eigen::Vector3f& high,
     const Eigen::Vector3f& normal)
{
  pcl::PointCloud<pcl::PointNormal> cloud;
  for (int corner = 0; corner < 8; ++corner) {
    pcl::PointNormal point;
    for (int axis = 0; axis < 3; ++axis)
      point.data[axis] = (corner >> axis & 1) != 0 ? high[axis] : low[axis];
    point.getNormalVector3fMap() = normal;
    cloud.push_back (point);
  }
  return cloud;
}

Eigen::Vector3d
towardViewer (const View& view)
{
  return (view.position - view.focal_point).normalized();
}

/** Where a point is in the window, from -1 to 1 in x and y. */
Eigen::Vector2d
inWindow (const View& view, const Eigen::Vector3d& point)
{
  const Eigen::Vector3d ray = point - view.position;
  const Eigen::Vector3d right = view.up.cross (towardViewer (view));
  const double depth = -ray.dot (towardViewer (view));
  EXPECT_GT (depth, view.clip[0]);
  EXPECT_LT (depth, view.clip[1]);
  const double tan_y = std::tan (view.field_of_view / 2.0);
  const double tan_x = tan_y * view.window_size.x() / view.window_size.y();
  return {ray.dot (right) / depth / tan_x, ray.dot (view.up) / depth / tan_y};
}

} // namespace

TEST (FitView, FillsTheWindow)
{
  const Eigen::Vector3f shift (500000.0f, -3.0f, 70.0f);
  for (const Eigen::Vector3f& sizes : {Eigen::Vector3f (4.0f, 3.0f, 1.0f),
                                       Eigen::Vector3f (1.0f, 9.0f, 5.0f),
                                       Eigen::Vector3f (8.0f, 1.0f, 1.5f)}) {
    const auto cloud = box (shift, shift + sizes, Eigen::Vector3f::Zero());
    const View view = fitView (cloud, SIZE);
    Eigen::AlignedBox2d seen;
    for (const auto& point : cloud)
      seen.extend (inWindow (view, point.getVector3fMap().cast<double>()));
    EXPECT_GT (seen.sizes().maxCoeff(), 1.85);
    EXPECT_LT (seen.sizes().maxCoeff(), 2.0);
    EXPECT_LT (seen.center().norm(), 1e-3);
  }
}

// A point that is far from all others leaves them as large in the window as they were.
TEST (FitView, IsNotLedAwayByFewPoints)
{
  pcl::PointCloud<pcl::PointNormal> cloud;
  for (int row = 0; row < 30; ++row)
    for (int column = 0; column < 30; ++column)
      cloud.emplace_back (0.1F * column, 0.1F * row, 0.01F * (column % 7), 0, 0, 1);
  const View alone = fitView (cloud, SIZE);
  for (const Eigen::Vector3f& far : {Eigen::Vector3f (500.0F, 1.0F, 0.0F),
                                     Eigen::Vector3f (1.0F, -90.0F, 7.0F),
                                     Eigen::Vector3f (1.0F, 1.0F, -60.0F),
                                     Eigen::Vector3f (2.0F, 2.0F, 3000.0F)}) {
    auto with = cloud;
    with.emplace_back (far.x(), far.y(), far.z(), 0, 0, 1);
    const View view = fitView (with, SIZE);
    EXPECT_TRUE (view.position.isApprox (alone.position)) << far.transpose();
    EXPECT_TRUE (view.focal_point.isApprox (alone.focal_point)) << far.transpose();
    EXPECT_GT (view.clip[0], 0.0);
    EXPECT_GT (view.clip[1], view.clip[0]);
  }
  // What is but sparse is part of it.
  cloud.emplace_back (4.5F, 1.5F, 0.0F, 0, 0, 1);
  EXPECT_FALSE (fitView (cloud, SIZE).position.isApprox (alone.position));
}

TEST (FitView, LooksAtTheBroadestSide)
{
  const Eigen::Vector3f none = Eigen::Vector3f::Zero();
  EXPECT_TRUE (towardViewer (fitView (box (none, {3, 4, 1}, none), SIZE))
                   .isApprox (Eigen::Vector3d::UnitZ()));
  EXPECT_TRUE (towardViewer (fitView (box (none, {3, 1, 4}, none), SIZE))
                   .isApprox (-Eigen::Vector3d::UnitY()));
  EXPECT_TRUE (towardViewer (fitView (box (none, {1, 3, 4}, none), SIZE))
                   .isApprox (Eigen::Vector3d::UnitX()));
}

TEST (FitView, LooksAtTheSideThatTheNormalsFace)
{
  const auto cloud = box ({-2, -1, 3}, {2, 1, 4}, {0, 0, -1});
  const View view = fitView (cloud, SIZE);
  EXPECT_TRUE (towardViewer (view).isApprox (-Eigen::Vector3d::UnitZ()));
  EXPECT_TRUE (view.up.isApprox (-Eigen::Vector3d::UnitY()))
      << "a depth camera's y points down";
}

TEST (FitView, TakesAnyCloud)
{
  pcl::PointCloud<pcl::PointNormal> cloud;
  EXPECT_GT (
      (fitView (cloud, SIZE).position - fitView (cloud, SIZE).focal_point).norm(), 0.0);
  cloud = box ({1, 1, 1}, {1, 1, 1}, {0, 0, 1});
  cloud[3].x = std::numeric_limits<float>::quiet_NaN();
  EXPECT_TRUE (fitView (cloud, SIZE).position.allFinite());
}

TEST (ReadView, ReadsWhatPclViewerSaves)
{
  const std::string text = "0.1,2.5/1,2,3/4,5,-6e-1/0,1,0/0.8575/1280,960/5,25";
  View view;
  std::string wanted;
  ASSERT_TRUE (readView (text, view, wanted)) << wanted;
  EXPECT_EQ (view.clip, Eigen::Vector2d (0.1, 2.5));
  EXPECT_EQ (view.focal_point, Eigen::Vector3d (1, 2, 3));
  EXPECT_EQ (view.position, Eigen::Vector3d (4, 5, -0.6));
  EXPECT_EQ (view.up, Eigen::Vector3d (0, 1, 0));
  EXPECT_EQ (view.field_of_view, 0.8575);
  EXPECT_EQ (view.window_size, Eigen::Vector2i (1280, 960));
  EXPECT_EQ (view.window_position, Eigen::Vector2i (5, 25));

  const std::string file = testing::TempDir() + "test_view.cam";
  std::ofstream (file) << text << "\n";
  View from_file;
  ASSERT_TRUE (readView (file, from_file, wanted)) << wanted;
  EXPECT_EQ (from_file.position, view.position);
}

TEST (ReadView, RefusesWhatIsNoView)
{
  for (const std::string text : {"",
                                 "missing.cam",
                                 "1,2/0,0,0/0,0,1/0,1,0/1/8,6",
                                 "1,2/0,0,0/0,0,1/0,1,0/1/8,6/0,0/0",
                                 "1,2/0,0,0/0,0,1/0,1,x/1/8,6/0,0",
                                 "1,nan/0,0,0/0,0,1/0,1,0/1/8,6/0,0",
                                 "2,1/0,0,0/0,0,1/0,1,0/1/8,6/0,0",
                                 "1,2/0,0,0/0,0,0/0,1,0/1/8,6/0,0",
                                 "1,2/0,0,0/0,0,1/0,0,2/1/8,6/0,0",
                                 "1,2/0,0,0/0,0,1/0,1,0/4/8,6/0,0",
                                 "1,2/0,0,0/0,0,1/0,1,0/1/0,6/0,0",
                                 "1,2/0,0,0/0,0,1/0,1,0/1/1e20,6/0,0"}) {
    View view;
    std::string wanted;
    EXPECT_FALSE (readView (text, view, wanted)) << text;
    EXPECT_FALSE (wanted.empty()) << text;
  }
}
