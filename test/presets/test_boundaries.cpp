// SPDX-License-Identifier: BSD-3-Clause
// Where data ends: nothing is drawn for that reason alone, ends of lines tell it, and
// its points are labelled on request.
#include <gtest/gtest.h>

#include "support/analytic_surface.h"
#include "support/extraction.h"
#include "support/noisy_cloud.h"

#include <cmath>
#include <limits>
#include <random>

using namespace pcl::crest;
using Cloud = pcl::PointCloud<pcl::PointNormal>;
using oracle::CrestRun;
using oracle::extract;

namespace {

struct Disk {
  float x, y, radius;
};
constexpr Disk HOLES[] = {
    {0.0F, 0.0F, 0.2F}, {0.5F, 0.5F, 0.1F}, {-0.5F, 0.4F, 0.15F}, {0.4F, -0.5F, 0.25F}};

/** \brief How far a point of the plane with holes is from its border. */
float
distanceToBorder (const pcl::PointNormal& p)
{
  float distance = 1.0F - std::max (std::abs (p.x), std::abs (p.y));
  for (const Disk& hole : HOLES)
    distance =
        std::min (distance, std::hypot (p.x - hole.x, p.y - hole.y) - hole.radius);
  return distance;
}

template <typename Keep>
Cloud::Ptr
cut (const Cloud& cloud, const Keep& keep)
{
  Cloud::Ptr result = pcl::make_shared<Cloud>();
  for (const pcl::PointNormal& point : cloud)
    if (keep (point))
      result->push_back (point);
  return result;
}

Cloud::Ptr
planeWithHoles ()
{
  return cut (*oracle::sample (oracle::plane(), 9000),
              [] (const pcl::PointNormal& p) { return distanceToBorder (p) > 0.0F; });
}

Cloud::Ptr
paraboloid ()
{
  Cloud::Ptr cloud = oracle::sample (oracle::plane(), 8000);
  for (pcl::PointNormal& p : *cloud) {
    p.z = 0.5F * (p.x * p.x + p.y * p.y);
    p.getNormalVector3fMap() = Eigen::Vector3f (-p.x, -p.y, 1.0F).normalized();
  }
  return cloud;
}

/** \brief A scene in front of a wall as a depth camera at the origin sees it, with its
 * noise along the rays (a part of the depth); some pixels see nothing.
 */
Cloud::Ptr
depthImage (float noise)
{
  constexpr std::uint32_t WIDTH = 160;
  constexpr std::uint32_t HEIGHT = 120;
  constexpr float FOCAL_LENGTH = 140.0F;
  Cloud::Ptr cloud = pcl::make_shared<Cloud> (WIDTH, HEIGHT);
  cloud->is_dense = false;
  std::mt19937 random (7);
  std::normal_distribution<float> error (0.0F, noise);
  for (std::uint32_t row = 0; row < HEIGHT; ++row)
    for (std::uint32_t column = 0; column < WIDTH; ++column) {
      const Eigen::Vector3f ray (
          (static_cast<float> (column) - 0.5F * WIDTH) / FOCAL_LENGTH,
          (static_cast<float> (row) - 0.5F * HEIGHT) / FOCAL_LENGTH,
          1.0F);
      // A wall that is seen askew, a ball and an upright pipe.
      const Eigen::Vector3f wall = Eigen::Vector3f (0.3F, 0.1F, 1.0F).normalized();
      float depth = 3.0F / wall.dot (ray);
      Eigen::Vector3f normal = -wall;
      const auto hit = [&] (const Eigen::Vector3f& centre, float radius, bool ball) {
        // (t ray - centre)^2 = radius^2, without the y of both for the pipe.
        const Eigen::Vector3f axes (1.0F, ball ? 1.0F : 0.0F, 1.0F);
        const Eigen::Vector3f r = axes.cwiseProduct (ray);
        const Eigen::Vector3f c = axes.cwiseProduct (centre);
        const float b = r.dot (c);
        const float d = b * b - r.squaredNorm() * (c.squaredNorm() - radius * radius);
        if (d <= 0.0F)
          return;
        const float t = (b - std::sqrt (d)) / r.squaredNorm();
        if (t < depth) {
          depth = t;
          normal = (t * r - c) / radius;
        }
      };
      hit ({-0.4F, 0.1F, 2.0F}, 0.45F, true);
      hit ({0.6F, 0.0F, 1.8F}, 0.2F, false);
      pcl::PointNormal point;
      point.getVector3fMap() = depth * (1.0F + error (random)) * ray;
      point.getNormalVector3fMap() = normal;
      const bool block = row > 20 && row < 35 && column > 60 && column < 90;
      if (block || random() % 30 == 0)
        point.getVector3fMap().setConstant (std::numeric_limits<float>::quiet_NaN());
      cloud->at (column, row) = point;
    }
  return cloud;
}

struct BorderCase {
  std::string name;
  Cloud::Ptr exact;
};

std::ostream&
operator<< (std::ostream& stream, const BorderCase& c)
{
  return stream << c.name;
}

/** \brief Surfaces without a crest that end somewhere. */
std::vector<BorderCase>
borderCases ()
{
  const Cloud::Ptr ball = oracle::sample (oracle::sphere (1.0), 20000);
  const Cloud::Ptr pipe = oracle::sample (oracle::cylinder (0.7), 12000);
  return {{"cap", cut (*ball, [] (const auto& p) { return p.z > 0.6F; })},
          {"half_pipe", cut (*pipe, [] (const auto& p) { return p.x > 0.1F * p.z; })},
          {"paraboloid", paraboloid()},
          {"plane_with_holes", planeWithHoles()}};
}

class Borders : public testing::TestWithParam<BorderCase> {};

} // namespace

TEST_P (Borders, AreNotDrawn)
{
  const Cloud::Ptr& exact = GetParam().exact;
  const double h = oracle::meanSpacing (*exact);
  for (const double noise : {0.0, 0.2, 0.5}) {
    const CrestRun run = extract (oracle::withNoise (*exact, noise * h));
    EXPECT_TRUE (run.lines.empty()) << noise << ": " << run.lines.size() << " lines";
    for (const pcl::Label& label : run.labels)
      EXPECT_NE (label.label, LABEL_INVALID) << noise;
  }
}

INSTANTIATE_TEST_SUITE_P (Analytic,
                          Borders,
                          testing::ValuesIn (borderCases()),
                          [] (const auto& info) { return info.param.name; });

TEST (Boundaries, OcclusionIsNotDrawn)
{
  for (const float noise : {0.0F, 0.0005F, 0.002F}) {
    const Cloud::Ptr exact = depthImage (noise);
    const CrestRun run = extract (oracle::withNoise (*exact, 0.0));
    EXPECT_TRUE (run.lines.empty()) << noise << ": " << run.lines.size() << " lines";
  }
}

TEST (Boundaries, TerrainHasCrestsAtItsBorderWhereTheyCrossIt)
{
  // A grid, as terrain models are, of waves that run into all its sides.
  constexpr int WIDTH = 120;
  constexpr int HEIGHT = 100;
  constexpr float PERIOD = 30.0F;
  const Eigen::Vector2f direction = Eigen::Vector2f (0.8F, 0.6F);
  Cloud::Ptr cloud = pcl::make_shared<Cloud>();
  for (int y = 0; y < HEIGHT; ++y)
    for (int x = 0; x < WIDTH; ++x) {
      const float turn = 2.0F * static_cast<float> (M_PI) / PERIOD;
      const float phase = turn * (direction.x() * x + direction.y() * y);
      pcl::PointNormal point (x, y, 5.0F * std::cos (phase));
      const Eigen::Vector2f slope = -5.0F * turn * std::sin (phase) * direction;
      point.getNormalVector3fMap() =
          Eigen::Vector3f (-slope.x(), -slope.y(), 1.0F).normalized();
      cloud->push_back (point);
    }
  for (const double noise : {0.0, 0.2}) {
    const CrestRun run = extract (oracle::withNoise (*cloud, noise));
    std::size_t points = 0;
    std::size_t at_border = 0;
    std::size_t strayed = 0;
    for (const CrestLine& line : run.lines)
      for (const auto& polyline : line.polylines)
        for (const pcl::index_t i : polyline) {
          const auto p = (*run.line_cloud)[i].getVector3fMap();
          const float phase = direction.dot (p.head<2>()) / PERIOD -
                              (line.type == CrestType::RIDGE ? 0.0F : 0.5F);
          const float error = PERIOD * std::abs (phase - std::round (phase));
          const bool border =
              std::min ({p.x(), p.y(), WIDTH - 1 - p.x(), HEIGHT - 1 - p.y()}) < 6.0F;
          // What is fitted at a border lies to one side: the last steps may bend.
          EXPECT_LT (error, border ? 4.0F : 1.5F) << noise;
          ++points;
          at_border += border ? 1 : 0;
          strayed += error > 1.5F ? 1 : 0;
        }
    EXPECT_LT (strayed, 0.03 * static_cast<double> (points)) << noise;
    EXPECT_GT (points, 600U) << noise;
    EXPECT_GT (at_border, 20U) << noise;
  }
}

TEST (Boundaries, AreLabelledOnRequest)
{
  const Cloud::Ptr cloud = planeWithHoles();
  const auto h = static_cast<float> (oracle::meanSpacing (*cloud));
  for (const Preset preset : {Preset::AUTO, Preset::PAPER}) {
    Parameters parameters;
    parameters.preset = preset;
    const CrestRun without = extract (cloud, parameters);
    parameters.boundaries = true;
    const CrestRun with = extract (cloud, parameters);
    std::size_t at_border = 0;
    std::size_t labelled = 0;
    for (std::size_t i = 0; i < cloud->size(); ++i) {
      const bool boundary = with.labels[i].label == LABEL_BOUNDARY;
      EXPECT_EQ (without.labels[i].label, boundary ? LABEL_NONE : with.labels[i].label);
      const float distance = distanceToBorder ((*cloud)[i]);
      EXPECT_FALSE (boundary && distance > 2.0F * h) << distance / h;
      at_border += distance < 0.4F * h ? 1 : 0;
      labelled += distance < 0.4F * h && boundary ? 1 : 0;
    }
    EXPECT_GT (at_border, 200U);
    EXPECT_GT (labelled, 0.95 * static_cast<double> (at_border));
  }
}

TEST (Boundaries, CrestLabelsComeFirst)
{
  const Cloud::Ptr cloud = oracle::sample (oracle::wavyRidge(), 8000);
  const CrestRun without = extract (cloud);
  Parameters parameters;
  parameters.boundaries = true;
  const CrestRun with = extract (cloud, parameters);
  std::size_t boundary = 0;
  for (std::size_t i = 0; i < cloud->size(); ++i)
    if (with.labels[i].label == LABEL_BOUNDARY) {
      ++boundary;
      EXPECT_EQ (without.labels[i].label, LABEL_NONE);
    }
    else
      EXPECT_EQ (without.labels[i].label, with.labels[i].label);
  EXPECT_GT (boundary, 200U);
}

TEST (Boundaries, EndsOfLinesTellThem)
{
  std::size_t at_boundary = 0;
  for (const auto& surface : {oracle::wavyRidge(), oracle::ridgeAndValley()}) {
    const Cloud::Ptr cloud = oracle::sample (surface, 12000);
    const auto h = static_cast<float> (oracle::meanSpacing (*cloud));
    const CrestRun run = extract (cloud);
    for (const CrestLine& line : run.lines)
      for (std::size_t i = 0; i < line.polylines.size(); ++i)
        for (const auto& [point, end] :
             {std::pair (line.polylines[i].front(), line.ends[i][0]),
              std::pair (line.polylines[i].back(), line.ends[i][1])}) {
          const pcl::PointNormal& p = (*cloud)[point];
          const auto to_border = [&] (float x, double low, double high) {
            return std::min (x - static_cast<float> (low),
                             static_cast<float> (high) - x);
          };
          const float distance =
              std::min (to_border (p.x, surface.u_min, surface.u_max),
                        to_border (p.y, surface.v_min, surface.v_max));
          if (end == LineEnd::BOUNDARY) {
            ++at_boundary;
            EXPECT_LT (distance, 3.0F * h);
          }
          else if (end == LineEnd::FREE) {
            EXPECT_GT (distance, h);
          }
        }
  }
  EXPECT_GE (at_boundary, 6U);
}
