// SPDX-License-Identifier: BSD-3-Clause
// Fits at a scale of samples of a surface, and what their errors are like.
#pragma once

#include "curvature/scale_fit.h"
#include "surface_stages.h"

#include <algorithm>
#include <vector>

namespace oracle {

struct ScaleFits {
  SurfaceStages stages;
  pcl::crest::PyramidLevel level;
  std::vector<pcl::crest::ScaleFit> fits;
};

/** \brief The fits to the nearest nodes of a level of the pyramid, for all nodes. */
inline ScaleFits
fitsAt (const pcl::PointCloud<pcl::PointNormal>& cloud, int number, int nearest)
{
  ScaleFits result;
  result.stages = surfaceStages (cloud);
  result.level = finestLevel (result.stages.points,
                              result.stages.graph,
                              pcl::crest::treeOver (result.stages.points.positions, 1));
  for (int i = 0; i < number; ++i)
    result.level = coarserLevel (result.level, 0);
  result.fits = fitAtScale (
      result.level, nearest, std::vector<std::uint8_t> (result.level.size(), 1), 0);
  return result;
}

inline double
median (std::vector<double> values)
{
  const auto middle = values.begin() + static_cast<std::ptrdiff_t> (values.size() / 2);
  std::nth_element (values.begin(), middle, values.end());
  return *middle;
}

inline double
variance (const std::vector<double>& values)
{
  double mean = 0.0;
  double squares = 0.0;
  for (const double x : values)
    mean += x / static_cast<double> (values.size());
  for (const double x : values)
    squares += (x - mean) * (x - mean);
  return squares / static_cast<double> (values.size() - 1);
}

} // namespace oracle
