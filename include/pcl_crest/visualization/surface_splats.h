// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_crest/export.h>
#include <pcl_crest/types.h>

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

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

/** \brief Draws every valid point as a small polygon, large enough to reach its
 * neighbours, so that the points cover the surface whatever their local density.
 *
 * The corners lie on the surface that the neighbours' tangent planes tell of, with the
 * normals in between theirs: flat discs would shade a curved surface in facets, and
 * stand out as beads along its edges. Points without a normal are not drawn.
 */
PCL_CREST_EXPORT SurfaceSplats
makeSurfaceSplats (const pcl::PointCloud<pcl::PointNormal>& cloud);

} // namespace crest
} // namespace pcl
