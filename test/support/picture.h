// SPDX-License-Identifier: BSD-3-Clause
// Pictures, pixel by pixel, and a surface whose crests are known.
#pragma once

#include <pcl_crest/visualization/view.h>

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <Eigen/Geometry>

#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>
#include <vtkSmartPointer.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace oracle {

/** Pixels of a side of the tests' pictures. */
constexpr int SIZE = 500;

/** A picture with its lower left pixel first. */
class Picture {
public:
  explicit Picture (const std::string& png)
  {
    vtkNew<vtkPNGReader> reader;
    reader->SetMemoryBuffer (png.data());
    reader->SetMemoryBufferLength (static_cast<vtkIdType> (png.size()));
    reader->Update();
    image_ = reader->GetOutput();
  }

  std::array<int, 3>
  operator() (int x, int y) const
  {
    const auto* pixel =
        static_cast<const unsigned char*> (image_->GetScalarPointer (x, y, 0));
    return {pixel[0], pixel[1], pixel[2]};
  }
  int
  width () const
  {
    return image_->GetDimensions()[0];
  }
  int
  height () const
  {
    return image_->GetDimensions()[1];
  }

private:
  vtkSmartPointer<vtkImageData> image_;
};

inline bool
isWhite (const std::array<int, 3>& pixel)
{
  return pixel == std::array<int, 3>{255, 255, 255};
}
inline bool
isGrey (const std::array<int, 3>& pixel)
{
  const auto [low, high] = std::minmax_element (pixel.begin(), pixel.end());
  return *high - *low <= 2 && *low > 40 && *high < 245;
}
inline bool
isBlue (const std::array<int, 3>& pixel)
{
  return pixel[2] > 150 && pixel[0] < 100 && pixel[1] < 110;
}
inline bool
isRed (const std::array<int, 3>& pixel)
{
  return pixel[0] > 150 && pixel[1] < 100 && pixel[2] < 100;
}

using PixelTest = bool (const std::array<int, 3>&);

/** Whether a pixel within `reach` pixels of a place passes the test. */
inline bool
isNear (const Picture& picture,
        const Eigen::Vector2d& place,
        int reach,
        PixelTest& test)
{
  const int x0 = static_cast<int> (std::floor (place.x()));
  const int y0 = static_cast<int> (std::floor (place.y()));
  for (int y = y0 - reach; y <= y0 + reach; ++y)
    for (int x = x0 - reach; x <= x0 + reach; ++x)
      if (x >= 0 && y >= 0 && x < picture.width() && y < picture.height() &&
          test (picture (x, y)))
        return true;
  return false;
}

inline int
count (const Picture& picture, PixelTest& test)
{
  int pixels = 0;
  for (int y = 0; y < picture.height(); ++y)
    for (int x = 0; x < picture.width(); ++x)
      pixels += test (picture (x, y)) ? 1 : 0;
  return pixels;
}

inline Eigen::Vector2d
project (const pcl::crest::View& view, const Eigen::Vector3d& point)
{
  const Eigen::Vector3d back = (view.position - view.focal_point).normalized();
  const Eigen::Vector3d right = view.up.cross (back).normalized();
  const Eigen::Vector3d ray = point - view.position;
  const double pixels =
      0.5 * view.window_size.y() / std::tan (view.field_of_view / 2) / -ray.dot (back);
  return 0.5 * view.window_size.cast<double>() +
         pixels * Eigen::Vector2d (ray.dot (right), ray.dot (back.cross (right)));
}

/** Waves z = 0.1 cos (2 pi (x - c (y))) that wind with c (y) = 0.15 sin (3 y): a ridge
 * at x = c (y), valleys at x = c (y) +- 1/2. */
inline double
windingOf (double y)
{
  return 0.15 * std::sin (3.0 * y);
}

inline pcl::PointCloud<pcl::PointNormal>::Ptr
waves ()
{
  pcl::PointCloud<pcl::PointNormal>::Ptr cloud (new pcl::PointCloud<pcl::PointNormal>);
  constexpr int STEPS = 150;
  for (int row = 0; row < STEPS; ++row)
    for (int column = 0; column < STEPS; ++column) {
      const double x = 1.8 * column / (STEPS - 1) - 0.9;
      const double y = 1.8 * row / (STEPS - 1) - 0.9;
      const double phase = 2.0 * M_PI * (x - windingOf (y));
      const double slope_x = -0.2 * M_PI * std::sin (phase);
      const double slope_y = -slope_x * 0.45 * std::cos (3.0 * y);
      pcl::PointNormal point;
      point.getVector3fMap() =
          Eigen::Vector3d (x, y, 0.1 * std::cos (phase)).cast<float>();
      point.getNormalVector3fMap() =
          Eigen::Vector3d (-slope_x, -slope_y, 1.0).normalized().cast<float>();
      cloud->push_back (point);
    }
  return cloud;
}

} // namespace oracle
