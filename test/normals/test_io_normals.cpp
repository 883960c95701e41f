// SPDX-License-Identifier: BSD-3-Clause
// Normals from faces, and estimated ones made consistent, against analytic normals.
#include <pcl_crest/io/read_cloud.h>

#include <pcl/io/pcd_io.h>

#include <gtest/gtest.h>

#include "support/sphere_mesh.h"
#include "support/temporary_directory.h"

#include <cmath>
#include <functional>
#include <limits>
#include <sstream>

using namespace pcl::crest;
using Cloud = pcl::PointCloud<pcl::PointNormal>;

namespace {

constexpr double PI = 3.14159265358979323846;

/** \brief A curve in the half plane (radius, height), by arc length, with the unit
 * normal that points away from the solid it bounds when turned about the z axis.
 */
struct Profile {
  double length;
  std::function<std::array<double, 4> (double)> at;
};

/** \brief Points on a surface of revolution, `spacing` apart, turned by random angles.
 */
Cloud
revolve (const Profile& profile, double spacing, const Eigen::Vector3d& center)
{
  std::mt19937 random (3);
  std::uniform_real_distribution<double> angle (0.0, 2.0 * PI);
  Cloud cloud;
  for (double s = 0.5 * spacing; s < profile.length; s += spacing) {
    const auto [r, z, nr, nz] = profile.at (s);
    const int count = std::max (1, static_cast<int> (2.0 * PI * r / spacing));
    const double first = angle (random);
    for (int i = 0; i < count; ++i) {
      const double a = first + 2.0 * PI * i / count;
      const Eigen::Vector3d p =
          center + Eigen::Vector3d (r * std::cos (a), r * std::sin (a), z);
      pcl::PointNormal point (p.x(), p.y(), p.z());
      point.getNormalVector3fMap() =
          Eigen::Vector3d (nr * std::cos (a), nr * std::sin (a), nz).cast<float>();
      cloud.push_back (point);
    }
  }
  return cloud;
}

/** \brief An arc around (r, z) from one angle to another, the normal turned outward
 * from it, or inward.
 */
Profile
arc (double r, double z, double radius, double from, double to, bool inward = false)
{
  const double step = (to > from ? 1.0 : -1.0) / radius;
  return {std::abs (to - from) * radius, [=] (double s) -> std::array<double, 4> {
            const double a = from + step * s;
            const double sign = inward ? -1.0 : 1.0;
            return {r + radius * std::cos (a),
                    z + radius * std::sin (a),
                    sign * std::cos (a),
                    sign * std::sin (a)};
          }};
}

Profile
join (const std::vector<Profile>& pieces)
{
  double length = 0.0;
  for (const Profile& piece : pieces)
    length += piece.length;
  return {length, [pieces] (double s) {
            std::size_t i = 0;
            while (i + 1 < pieces.size() && s > pieces[i].length)
              s -= pieces[i++].length;
            return pieces[i].at (s);
          }};
}

Cloud
sphere (double radius, double spacing, const Eigen::Vector3d& center)
{
  return revolve (arc (0, 0, radius, -PI / 2, PI / 2), spacing, center);
}

/** \brief A hemispherical bowl of this wall thickness, with a rounded rim. */
Cloud
bowl (double thickness, double spacing)
{
  const double middle = 1.0 - thickness / 2;
  return revolve (join ({arc (0, 0, 1.0, -PI / 2, 0),
                         arc (middle, 0, thickness / 2, 0, PI),
                         arc (0, 0, 1.0 - thickness, 0, -PI / 2, true)}),
                  spacing,
                  Eigen::Vector3d::Zero());
}

Cloud
heightField (double sign)
{
  Cloud cloud;
  for (int i = 0; i < 70; ++i)
    for (int j = 0; j < 70; ++j) {
      const double x = 0.03 * i;
      const double y = 0.03 * j;
      pcl::PointNormal point (x, y, 0.25 * std::sin (4 * x) * std::cos (3 * y));
      point.getNormalVector3fMap() =
          sign * Eigen::Vector3d (-std::cos (4 * x) * std::cos (3 * y),
                                  0.75 * std::sin (4 * x) * std::sin (3 * y),
                                  1.0)
                     .normalized()
                     .cast<float>();
      cloud.push_back (point);
    }
  return cloud;
}

/** \brief The share of points whose normals are on the same side in both clouds. */
double
agreement (const Cloud& a, const Cloud& b)
{
  std::size_t same = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    same += a[i].getNormalVector3fMap().dot (b[i].getNormalVector3fMap()) > 0.0F;
  return static_cast<double> (same) / static_cast<double> (a.size());
}

class IoNormals : public testing::Test {
protected:
  const oracle::TemporaryDirectory directory_;

  /** \brief What is read of the positions of a cloud. */
  InputCloud
  estimated (const Cloud& cloud, double scale = 1.0, double offset = 0.0) const
  {
    std::ostringstream text;
    text.precision (17);
    for (const pcl::PointNormal& p : cloud)
      text << scale * p.x + offset << ' ' << scale * p.y + offset << ' '
           << scale * p.z + offset << '\n';
    InputCloud read;
    std::string error;
    EXPECT_TRUE (readCloud (directory_.file ("a.xyz", text.str()), 16, 2, read, error))
        << error;
    EXPECT_EQ (NormalSource::ESTIMATED, read.normals);
    return read;
  }

  /** \brief The same of a PCD file, with the viewpoint of the cloud. */
  InputCloud
  estimatedOfPcd (const pcl::PointCloud<pcl::PointXYZ>& cloud) const
  {
    const std::string path = directory_.file ("a.pcd");
    pcl::PCDWriter().writeBinary (path, cloud);
    InputCloud read;
    std::string error;
    EXPECT_TRUE (readCloud (path, 16, 2, read, error)) << error;
    EXPECT_EQ (NormalSource::ESTIMATED, read.normals);
    return read;
  }
};

TEST_F (IoNormals, OfFacesAreWeightedByArea)
{
  const oracle::TriangleMesh mesh = oracle::cubeSphere (24);
  for (const double scale : {1.0, 1e-4, 1e4}) {
    std::ostringstream text;
    text.precision (9);
    text << "OFF\n" << mesh.points.size() + 1 << ' ' << mesh.triangles.size() << " 0\n";
    for (const Eigen::Vector3f& p : mesh.points)
      text << (scale * p.cast<double>()).transpose() << '\n';
    text << "0 0 0\n";
    for (const auto& t : mesh.triangles)
      text << "3 " << t[0] << ' ' << t[1] << ' ' << t[2] << '\n';
    InputCloud cloud;
    std::string error;
    ASSERT_TRUE (readCloud (directory_.file ("a.off", text.str()), 12, 1, cloud, error))
        << error;
    EXPECT_EQ (NormalSource::FACES, cloud.normals);
    for (std::size_t i = 0; i < mesh.points.size(); ++i)
      ASSERT_GT ((*cloud.points)[i].getNormalVector3fMap().dot (mesh.points[i]),
                 std::cos (0.02));
    EXPECT_TRUE (cloud.points->back().getNormalVector3fMap().isZero (0.0F));
    const std::string size = std::to_string (mesh.points.size() + 1);
    EXPECT_EQ ("1 of " + size +
                   " points are in no face that has an area, and have no normal.",
               cloud.notes.at (0));
  }
  // Areas 1 and 3 in two planes at a right angle, met at the first two points.
  InputCloud cloud;
  std::string error;
  ReadOptions vertices;
  vertices.samples_faces = false;
  ASSERT_TRUE (readCloud (directory_.file ("b.off",
                                           "OFF\n6 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n"
                                           "1 0 -3\n0 0 -3\n4 0 1 2 3\n4 1 0 5 4\n"),
                          12,
                          1,
                          cloud,
                          error,
                          vertices))
      << error;
  const Eigen::Vector3f expected = Eigen::Vector3f (0, -3, 1).normalized();
  EXPECT_LT (((*cloud.points)[0].getNormalVector3fMap() - expected).norm(), 1e-6F);
}

TEST_F (IoNormals, OfFacesFollowTheirWinding)
{
  // Seen from the origin, which lies outside, computeApproximateNormals would flip.
  const std::string points = "OFF\n3 1 0\n5 5 5\n6 5 5\n5 6 5\n";
  for (const bool turned : {false, true}) {
    InputCloud cloud;
    std::string error;
    ASSERT_TRUE (readCloud (
        directory_.file ("a.off", points + (turned ? "3 0 2 1\n" : "3 0 1 2\n")),
        12,
        1,
        cloud,
        error))
        << error;
    for (const pcl::PointNormal& point : *cloud.points)
      EXPECT_EQ (turned ? -1.0F : 1.0F, point.normal_z);
  }
}

TEST_F (IoNormals, ClosedSurfacesLookOutward)
{
  const Profile circle = arc (1.0, 0, 0.3, 0, 2 * PI);
  Cloud two = sphere (1.0, 0.06, {0, 0, 0});
  two += sphere (0.5, 0.06, {1, 2, 5});
  const std::vector<std::pair<const char*, Cloud>> shapes{
      {"sphere", sphere (1.0, 0.06, {3, -2, 1})},
      {"torus", revolve (circle, 0.05, Eigen::Vector3d (0, 0, -4))},
      {"two spheres", two},
      {"bowl of a wall of 3 spacings", bowl (0.12, 0.04)},
      {"bowl of a wall of 2 spacings", bowl (0.08, 0.04)},
      {"bowl of a wall of 1 spacing", bowl (0.04, 0.04)}};
  for (const auto& [name, cloud] : shapes) {
    const InputCloud read = estimated (cloud);
    EXPECT_GE (agreement (cloud, *read.points), 0.995) << name;
    EXPECT_NE (std::string::npos, read.notes.at (0).find ("closed: outward")) << name;
  }
}

TEST_F (IoNormals, ScaleAndPlaceDoNotMatter)
{
  const Cloud cloud = sphere (1.0, 0.08, {0, 0, 0});
  EXPECT_GE (agreement (cloud, *estimated (cloud, 1e-4).points), 0.995);
  EXPECT_GE (agreement (cloud, *estimated (cloud, 1e6).points), 0.995);
  EXPECT_GE (agreement (cloud, *estimated (cloud, 1.0, 500.0).points), 0.995);
  const InputCloud far = estimated (cloud, 1.0, 1e4);
  EXPECT_NE (std::string::npos, far.notes.at (0).find ("far from the origin"));
}

TEST_F (IoNormals, OpenSurfacesLookUpOrToTheViewpoint)
{
  const Cloud up = heightField (1.0);
  EXPECT_GE (agreement (up, *estimated (up).points), 0.995);

  pcl::PointCloud<pcl::PointXYZ> seen_from_below;
  pcl::copyPointCloud (up, seen_from_below);
  seen_from_below.sensor_origin_ = Eigen::Vector4f (1, 1, -10, 0);
  const InputCloud read = estimatedOfPcd (seen_from_below);
  EXPECT_GE (agreement (heightField (-1.0), *read.points), 0.995);
  EXPECT_NE (std::string::npos, read.notes.at (0).find ("toward the viewpoint"));
}

TEST_F (IoNormals, ScansLookToTheirSensorEverywhere)
{
  // What a sensor at the origin sees of a ball that hangs before a corner of three
  // walls, of which two are far away and seen at a grazing angle.
  pcl::PointCloud<pcl::PointXYZ> scan;
  const Eigen::Vector3d ball (0.0, 0.0, 3.0);
  constexpr double RADIUS = 0.5;
  for (int i = -80; i <= 80; ++i)
    for (int j = -80; j <= 80; ++j) {
      const Eigen::Vector3d ray =
          Eigen::Vector3d (0.01 * i, 0.01 * j, 1.0).normalized();
      double t = 5.0 / ray.z();
      if (ray.x() > 0.0)
        t = std::min (t, 1.5 / ray.x());
      if (ray.y() > 0.0)
        t = std::min (t, 1.5 / ray.y());
      const double middle = ray.dot (ball);
      const double squared = middle * middle - ball.squaredNorm() + RADIUS * RADIUS;
      if (squared > 0.0)
        t = std::min (t, middle - std::sqrt (squared));
      const Eigen::Vector3f p = (t * ray).cast<float>();
      scan.push_back ({p.x(), p.y(), p.z()});
    }
  const InputCloud read = estimatedOfPcd (scan);
  const auto faces = [] (const pcl::PointNormal& p) {
    return p.getNormalVector3fMap().dot (p.getVector3fMap()) < 0.0F;
  };
  EXPECT_GE (static_cast<double> (
                 std::count_if (read.points->begin(), read.points->end(), faces)),
             0.995 * static_cast<double> (read.points->size()));
  EXPECT_NE (std::string::npos, read.notes.at (0).find ("which all points are seen"));
}

TEST_F (IoNormals, ModelsLookOutwardWhereverTheViewpointIs)
{
  // Within the ball nothing is hidden either, but it is closed.
  for (const float z : {0.0F, 10.0F}) {
    const Cloud cloud = sphere (1.0, 0.06, {0, 0, 0});
    pcl::PointCloud<pcl::PointXYZ> model;
    pcl::copyPointCloud (cloud, model);
    model.sensor_origin_ = Eigen::Vector4f (0, 0, z, 0);
    const InputCloud read = estimatedOfPcd (model);
    EXPECT_GE (agreement (cloud, *read.points), 0.995) << z;
    EXPECT_NE (std::string::npos, read.notes.at (0).find ("closed: outward")) << z;
  }
}

TEST_F (IoNormals, OrganizedCloudsLookToTheirSensor)
{
  // The image of a folded wall: turned over as a whole it would be as consistent.
  pcl::PointCloud<pcl::PointXYZ> image (60, 40);
  for (std::uint32_t row = 0; row < image.height; ++row)
    for (std::uint32_t column = 0; column < image.width; ++column) {
      const float x = (static_cast<float> (column) - 29.5F) / 30.0F;
      const float y = (static_cast<float> (row) - 19.5F) / 30.0F;
      const float z = 2.0F + std::abs (std::fmod (x + 2.0F, 0.5F) - 0.25F);
      image.at (column, row) = {z * x, z * y, z};
    }
  image.at (7, 7).x = std::numeric_limits<float>::quiet_NaN();
  image.is_dense = false;
  const InputCloud read = estimatedOfPcd (image);
  EXPECT_EQ (60U, read.points->width);
  for (const pcl::PointNormal& point : *read.points)
    EXPECT_FALSE (point.getNormalVector3fMap().dot (point.getVector3fMap()) > 0.0F);
  EXPECT_NE (std::string::npos, read.notes.back().find ("toward the viewpoint"));
}

TEST_F (IoNormals, CoincidentAndInvalidPointsDoNoHarm)
{
  Cloud cloud = sphere (1.0, 0.08, {0, 0, 0});
  const std::size_t size = cloud.size();
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (int i = 0; i < 40; ++i)
    cloud.push_back (cloud[5]);
  cloud.push_back (pcl::PointNormal (nan, 0, 0));
  const InputCloud read = estimated (cloud);
  ASSERT_EQ (size + 41, read.points->size());
  EXPECT_FALSE (read.points->is_dense);
  EXPECT_TRUE (read.points->back().getNormalVector3fMap().isZero (0.0F));
  cloud.resize (size + 40);
  read.points->resize (size + 40);
  EXPECT_GE (agreement (cloud, *read.points), 0.995);
}

TEST_F (IoNormals, NormalsOfTheFileAreLeftOutOnRequest)
{
  const std::string path =
      directory_.file ("a.xyz", "0 0 0 1 0 0\n1 0 0 1 0 0\n0 1 0 1 0 0\n1 1 0 1 0 0\n");
  for (const bool always_estimate : {false, true}) {
    InputCloud cloud;
    std::string error;
    ReadOptions options;
    options.normals.always_estimate = always_estimate;
    ASSERT_TRUE (readCloud (path, 4, 1, cloud, error, options)) << error;
    EXPECT_EQ (always_estimate ? NormalSource::ESTIMATED : NormalSource::FILE,
               cloud.normals);
    for (const pcl::PointNormal& point : *cloud.points)
      EXPECT_NEAR (always_estimate ? 1.0F : 0.0F, std::abs (point.normal_z), 1e-5F);
  }
}

TEST_F (IoNormals, WhereThereAreNoneTheNotesSaySo)
{
  const InputCloud read = estimated (Cloud (20, 1));
  EXPECT_EQ ("Normals could not be estimated: no three points span a plane.",
             read.notes.at (0));
}

TEST_F (IoNormals, UselessNormalsOfTheFileAreReplaced)
{
  const auto read = [this] (const std::string& text) {
    InputCloud cloud;
    std::string error;
    EXPECT_TRUE (readCloud (directory_.file ("a.xyz", text), 4, 1, cloud, error))
        << error;
    return cloud;
  };
  const InputCloud all =
      read ("x y z nx ny nz\n0 0 0 0 0 0\n1 0 0 nan 0 0\n0 1 0 0 0 0\n1 1 0 0 inf 0\n");
  EXPECT_EQ (NormalSource::ESTIMATED, all.normals);
  EXPECT_NE (std::string::npos, all.notes.at (1).find ("all zero or not finite"));
  for (const pcl::PointNormal& point : *all.points)
    EXPECT_NEAR (1.0F, point.normal_z, 1e-5F);
  const InputCloud some =
      read ("x y z nx ny nz\n0 0 0 0 0 9\n1 0 0 nan 0 0\n0 1 0 0 0 0\n1 1 0 0 0 1\n");
  EXPECT_EQ (NormalSource::FILE, some.normals);
  EXPECT_EQ ("2 of 4 normals of the file are zero or not finite.", some.notes.at (1));
  EXPECT_EQ (9.0F, some.points->front().normal_z);
  EXPECT_FALSE (some.points->is_dense);
}

} // namespace
