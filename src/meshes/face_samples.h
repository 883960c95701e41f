// SPDX-License-Identifier: BSD-3-Clause
// Samples spread evenly over the faces of a mesh.
#pragma once

#include <pcl_crest/input.h>

#include "base/progress.h"
#include "meshes/triangle_shapes.h"

namespace pcl {
namespace crest {

/** \brief Positions on faces, each with the normal of its face. */
struct FaceSamples {
  std::vector<Eigen::Vector3f> positions;
  std::vector<Eigen::Vector3f> normals;
};

/** The most samples that sampleFaces may be asked for, by area and spacing. */
constexpr double MOST_FACE_SAMPLES = 2e7;

/** \brief Samples at random that keep a distance, as many as there are squares of the
 * spacing in the area of the faces (Poisson disks by dart throwing, Cook 1986).
 *
 * Darts are so many that hardly one more would find room. They are spread over the
 * faces by a sequence of low discrepancy (Roberts 2018), and thrown cell by cell of
 * space, eight cells of two after the other, those that are no neighbours at once (Wei
 * 2008). Distances are those of space, across edges as within faces, but samples on
 * sides that look apart by more than 154 degrees see nothing of each other, so that
 * both sides of a plate are complete. The same faces give the same samples, whatever
 * the number of threads.
 *
 * \param[in] cloud only its positions are used
 * \param[in] triangles whose corners are finite points of the cloud
 * \param[in] shapes of these
 * \param[in] spacing in the unit of the cloud
 * \param[in] workers a number of threads, 0 for all processors
 */
PCL_CREST_EXPORT FaceSamples
sampleFaces (const PointView& cloud,
             const Faces& triangles,
             const TriangleShapes& shapes,
             double spacing,
             const Workers& workers);

} // namespace crest
} // namespace pcl
