// SPDX-License-Identifier: BSD-3-Clause
// Where noisy samples are in the surface.
#pragma once

#include "surface/neighbor_search.h"

namespace pcl {
namespace crest {

/** \brief What the surroundings of samples tell of the surface that noise has moved
 * them off; for each sample, lengths in the cloud's unit.
 */
struct FlatPlaces {
  /** the foot of the sample on the surface, or the sample itself where too few are
   * around it */
  std::vector<Eigen::Vector3f> positions;
  std::vector<Eigen::Vector3f> normals;
  /** standard deviation of the samples around from the surface; 0 where too few are
   * there, and so are spacings */
  std::vector<float> noise;
  /** of samples spread evenly over the surface there */
  std::vector<float> spacings;
};

/** \brief The noise over the spacing, as three quarters of the places have it at least:
 * elsewhere it may be shape. 0 if none has any.
 */
double
typicalNoise (const FlatPlaces& places);

/** \brief The same of samples all over a cloud, in windows of 24 neighbours.
 * \param[in] search finds more of them: those of other sheets do not count
 */
double
typicalNoise (const OrientedPoints& points, const NeighborSearch& search);

/** \brief Moves samples, twice, to the foot on a quadric height function that is
 * fitted, by least squares, to the samples whose places are nearest: 48 of them where
 * noise is less than a fifth of the window's radius, else 96. Samples whose normals
 * differ by more than a right angle (the second time 70 degrees) are on another sheet.
 *
 * Nearest in space are samples at the same height in the noise, whose means would not
 * be in the surface; nearest by place are those around. Residuals are always those of
 * the samples themselves.
 */
FlatPlaces
flattenPlaces (const OrientedPoints& points, const Workers& workers);

} // namespace crest
} // namespace pcl
