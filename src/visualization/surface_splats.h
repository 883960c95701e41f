// SPDX-License-Identifier: BSD-3-Clause
// What surface points are drawn as.
#pragma once

#include <pcl_crest/visualization/crest_scene.h>

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <vector>

namespace pcl {
namespace crest {

/** \brief Points drawn as a surface. */
struct SurfaceSplats {
  /** one polygon per point, with normals */
  vtkSmartPointer<vtkPolyData> polygons;
  /** for each polygon the index of its point */
  std::vector<index_t> points;
  /** the median of the polygons' radii, in the cloud's unit */
  double radius = 0.0;
};

} // namespace crest
} // namespace pcl
