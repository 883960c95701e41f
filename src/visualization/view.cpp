// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_crest/visualization/view.h>

#include <pcl/common/point_tests.h>

#include <Eigen/Geometry>

#include "io/parse_number.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <sstream>
#include <vector>

namespace pcl {
namespace crest {

namespace {

constexpr double FIELD_OF_VIEW = M_PI / 6.0;
/** how much of the window the cloud takes */
constexpr double FILL = 0.96;
/** A point at the edge of the cloud counts where it is no farther away from the middle
 * 98 of 100 than these are wide. */
constexpr std::size_t ONE_SIDE = 100;
/** Mean normals longer than this have a side that they face. */
constexpr double FACING = 0.25;

struct Direction {
  Eigen::Vector3d toward_viewer;
  Eigen::Vector3d up;
};

Direction
chooseDirection (const Eigen::Vector3d& extent, const Eigen::Vector3d& mean_normal)
{
  int axis = 2;
  for (const int other : {1, 0})
    if (extent[other] < extent[axis])
      axis = other;
  const double facing = mean_normal[axis];
  const bool positive = std::abs (facing) > FACING ? facing > 0.0 : axis != 1;
  Direction direction;
  direction.toward_viewer = (positive ? 1.0 : -1.0) * Eigen::Vector3d::Unit (axis);
  if (axis == 1)
    direction.up = Eigen::Vector3d::UnitZ();
  else
    direction.up = (axis == 2 && !positive ? -1.0 : 1.0) * Eigen::Vector3d::UnitY();
  return direction;
}

/** The numbers of "1,2/3" as {{1, 2}, {3}}; empty if any of it is no such number. */
std::vector<std::vector<double>>
parseGroups (const std::string& text)
{
  std::vector<std::vector<double>> groups;
  std::istringstream group_stream (text);
  for (std::string group; std::getline (group_stream, group, '/');) {
    groups.emplace_back();
    std::istringstream number_stream (group);
    for (std::string number; std::getline (number_stream, number, ',');) {
      double value;
      if (!parseNumber (number, value) || !std::isfinite (value))
        return {};
      groups.back().push_back (value);
    }
  }
  return groups;
}

Eigen::Vector2i
toPixels (const std::vector<double>& numbers)
{
  return Eigen::Vector2d (numbers[0], numbers[1])
      .cwiseMax (-1e9)
      .cwiseMin (1e9)
      .cast<int>();
}

/** What would be right about a view that is not, or nothing. */
std::string
explainInvalidView (const View& view)
{
  const Eigen::Vector3d ray = view.focal_point - view.position;
  if (!(view.clip[0] > 0.0 && view.clip[1] > view.clip[0]))
    return "a camera with clipping planes 0 < near < far";
  if (!(ray.cross (view.up).norm() > 1e-6 * ray.norm() * view.up.norm()))
    return "a camera whose position, focal point and up are not on one line";
  if (!(view.field_of_view > 0.0 && view.field_of_view < M_PI))
    return "a camera with a field of view between 0 and pi";
  if (view.window_size.minCoeff() < 1 || view.window_size.maxCoeff() > LARGEST_WINDOW)
    return "a camera with a window of 1 to " + std::to_string (LARGEST_WINDOW) +
           " pixels";
  return "";
}

/** The box of the points that there are to look at: not of few that are far from all
 * others, beside which these would be a dot. */
Eigen::AlignedBox3d
boxOfMost (const pcl::PointCloud<pcl::PointNormal>& cloud)
{
  constexpr std::size_t ENOUGH = 200000;
  std::array<std::vector<float>, 3> numbers;
  for (std::size_t i = 0; i < cloud.size(); i += 1 + cloud.size() / ENOUGH)
    if (pcl::isXYZFinite (cloud[i]))
      for (std::size_t axis = 0; axis < 3; ++axis)
        numbers[axis].push_back (cloud[i].data[axis]);
  Eigen::AlignedBox3d box;
  if (numbers[0].empty())
    return box;
  Eigen::Vector3d low;
  Eigen::Vector3d high;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::vector<float>& sorted = numbers[axis];
    const std::size_t few = sorted.size() / ONE_SIDE;
    const auto at = [&sorted] (std::size_t rank) {
      const auto place = sorted.begin() + static_cast<std::ptrdiff_t> (rank);
      std::nth_element (sorted.begin(), place, sorted.end());
      return static_cast<double> (*place);
    };
    low[static_cast<Eigen::Index> (axis)] = at (few);
    high[static_cast<Eigen::Index> (axis)] = at (sorted.size() - 1 - few);
  }
  const double width = (high - low).maxCoeff();
  const Eigen::AlignedBox3d near (low.array() - width, high.array() + width);
  for (const auto& point : cloud) {
    const Eigen::Vector3d position = point.getVector3fMap().cast<double>();
    if (pcl::isXYZFinite (point) && near.contains (position))
      box.extend (position);
  }
  return box;
}

} // namespace

View
fitView (const pcl::PointCloud<pcl::PointNormal>& cloud,
         const Eigen::Vector2i& window_size)
{
  Eigen::AlignedBox3d whole;
  Eigen::Vector3d mean_normal = Eigen::Vector3d::Zero();
  std::size_t normals = 0;
  for (const auto& point : cloud)
    if (pcl::isXYZFinite (point)) {
      whole.extend (point.getVector3fMap().cast<double>());
      if (pcl::isNormalFinite (point)) {
        mean_normal += point.getNormalVector3fMap().cast<double>();
        ++normals;
      }
    }
  if (whole.isEmpty())
    whole.extend (Eigen::Vector3d::Zero());
  Eigen::AlignedBox3d box = boxOfMost (cloud);
  if (box.isEmpty())
    box = whole;
  if (normals > 0)
    mean_normal /= static_cast<double> (normals);
  const Direction direction = chooseDirection (box.sizes(), mean_normal);
  const Eigen::Vector3d right = direction.up.cross (direction.toward_viewer);

  // Seen from the height z above the center, a point at height h and x to the right of
  // the view axis is in the window where |x| <= tan (z - h): with the largest h tan + x
  // and h tan - x known, the axis goes half way between them.
  const double tan_y = FILL * std::tan (0.5 * FIELD_OF_VIEW);
  const double tan_x = tan_y * window_size.x() / window_size.y();
  Eigen::Vector2d reach_x = Eigen::Vector2d::Constant (-INFINITY);
  Eigen::Vector2d reach_y = reach_x;
  for (const auto& point : cloud)
    if (pcl::isXYZFinite (point) &&
        box.contains (point.getVector3fMap().cast<double>())) {
      const Eigen::Vector3d offset =
          point.getVector3fMap().cast<double>() - box.center();
      const double height = offset.dot (direction.toward_viewer);
      const double x = offset.dot (right), y = offset.dot (direction.up);
      reach_x =
          reach_x.cwiseMax (Eigen::Vector2d (height * tan_x + x, height * tan_x - x));
      reach_y =
          reach_y.cwiseMax (Eigen::Vector2d (height * tan_y + y, height * tan_y - y));
    }
  double distance = std::max (reach_x.sum() / tan_x, reach_y.sum() / tan_y) / 2.0;
  if (!(distance > 0.0)) {
    distance = 1.0;
    reach_x.setZero();
    reach_y.setZero();
  }

  View view;
  const double middle =
      distance - (whole.center() - box.center()).dot (direction.toward_viewer);
  const double depth = 0.5 * whole.sizes().dot (direction.toward_viewer.cwiseAbs());
  view.clip = {std::max (0.9 * (middle - depth), 1e-3 * distance),
               1.1 * (middle + depth)};
  view.focal_point = box.center() + 0.5 * (reach_x[0] - reach_x[1]) * right +
                     0.5 * (reach_y[0] - reach_y[1]) * direction.up;
  view.position = view.focal_point + distance * direction.toward_viewer;
  view.up = direction.up;
  view.field_of_view = FIELD_OF_VIEW;
  view.window_size = window_size;
  view.window_position.setZero();
  return view;
}

bool
readView (const std::string& text, View& view, std::string& error)
{
  std::string line = text;
  if (std::ifstream file (text); file)
    std::getline (file, line);
  const auto groups = parseGroups (line);
  std::vector<std::size_t> sizes;
  for (const auto& group : groups)
    sizes.push_back (group.size());
  if (sizes != std::vector<std::size_t>{2, 3, 3, 3, 1, 2, 2}) {
    error = "the name of a file that pcl_viewer saved a camera to, or a camera: "
            "near,far/focal point x,y,z/position x,y,z/up x,y,z/field of view/"
            "window width,height/window x,y";
    return false;
  }
  View read;
  read.clip = Eigen::Map<const Eigen::Vector2d> (groups[0].data());
  read.focal_point = Eigen::Map<const Eigen::Vector3d> (groups[1].data());
  read.position = Eigen::Map<const Eigen::Vector3d> (groups[2].data());
  read.up = Eigen::Map<const Eigen::Vector3d> (groups[3].data());
  read.field_of_view = groups[4][0];
  read.window_size = toPixels (groups[5]);
  read.window_position = toPixels (groups[6]);
  error = explainInvalidView (read);
  if (error.empty())
    view = read;
  return error.empty();
}

void
setCamera (const View& view, vtkCamera& camera)
{
  camera.SetFocalPoint (view.focal_point.data());
  camera.SetPosition (view.position.data());
  camera.SetViewUp (view.up.data());
  camera.SetViewAngle (view.field_of_view * 180.0 / M_PI);
  camera.SetClippingRange (view.clip.data());
}

} // namespace crest
} // namespace pcl
