// SPDX-License-Identifier: BSD-3-Clause
// Room normals: normals for clouds that have none, estimated and turned to one side of
// the surface (Hoppe et al. 1992), or taken from faces.
//
// Positions, perhaps faces or a viewpoint, go in; a normal for each comes out, and how
// its side was decided. How planes are fitted and neighbours found is given by the
// caller. It knows nothing of files, and nothing of the stages that use normals.
#pragma once

#include <pcl_crest/export.h>
#include <pcl_crest/input.h>

#include "normals/normal_orientation.h"

#include <functional>

namespace pcl {
namespace crest {

/** \brief Fits planes to the k nearest neighbours of points that are not far from unit
 * size: gives for each its normal, of unit length with any sign, or zero where there is
 * none.
 */
using PlaneFits = std::function<void (const std::vector<Eigen::Vector3f>& points,
                                      int k,
                                      unsigned threads,
                                      std::vector<Eigen::Vector3f>& normals)>;

/** \brief What a library of point clouds does for the estimation. */
struct PointLibrary {
  PlaneFits fit_planes;
  NearestMaker find_nearest;
};

/** \brief Estimates the normals of points and makes them consistent over the cloud (see
 * orientNormals).
 * \param[in] cloud only its positions are used: points that are not finite get zero
 * normals, coincident ones the same
 * \param[in] viewpoint, organized as in orientNormals
 * \param[in] library, k, threads how to estimate; 0 threads are all processors
 * \param[out] normals of unit length or zero
 */
PCL_CREST_EXPORT Orientation
estimateNormals (const PointView& cloud,
                 const std::optional<Eigen::Vector3f>& viewpoint,
                 bool organized,
                 const PointLibrary& library,
                 int k,
                 unsigned threads,
                 std::vector<Eigen::Vector3f>& normals);

} // namespace crest
} // namespace pcl
