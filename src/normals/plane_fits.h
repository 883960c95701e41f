// SPDX-License-Identifier: BSD-3-Clause
// Planes through the neighbours of samples.
#pragma once

#include <pcl_crest/types.h>

#include <Eigen/Core>

#include "base/progress.h"
#include "search/point_tree.h"

#include <cmath>
#include <cstdint>
#include <vector>

namespace pcl {
namespace crest {

/** \brief What windows of neighbours tell of samples, all by their places in the tree
 * and in its unit. Signs of normals mean nothing yet.
 */
struct PlaneFits {
  /** How many nearest a sample votes with (see findVotes). */
  static constexpr int NEAREST = 12;

  std::vector<Eigen::Vector3f> positions;
  /** of planes through the k nearest, of unit length, or zero where these span none;
   * where it takes more to see two sheets, of their planes */
  std::vector<Eigen::Vector3f> plain;
  /** how high these planes are above the samples, how far their points scatter about
   * them, and how far from their middles, both standard deviations */
  std::vector<float> heights;
  std::vector<float> sigmas;
  std::vector<float> radii;
  /** the smallest eigenvalue of the covariance of these over the sum of all */
  std::vector<float> variation;
  /** of planes through as many as noise asks for, of one sheet where there are two */
  std::vector<Eigen::Vector3f> normals;
  /** the samples on these planes where there is noise, else as they are */
  std::vector<Eigen::Vector3f> feet;
  /** how far feet may be off the surface, a standard deviation */
  std::vector<float> errors;
  /** of heights in these windows, fourth moment over squared variance, where windows
   * are rough; else 3 */
  std::vector<float> kurtosis;
  /** the height above the foot of the plane halfway to another sheet; 0 for none */
  std::vector<float> middles;
  /** 1 where noise may have moved a sample to the other sheet */
  std::vector<std::uint8_t> between;
  /** squared distance to the last of the NEAREST, of stray points that of what is near
   */
  std::vector<float> reach;

  std::size_t
  size () const
  {
    return positions.size();
  }

  /** \brief Of samples that are spread evenly how far they are apart. */
  float
  spacing (std::size_t i) const
  {
    constexpr float PI = 3.14159265F;
    return std::sqrt (PI * reach[i] / (NEAREST + 1));
  }
};

/** The largest ratio of the reach of neighbours on one surface. */
constexpr float MOST_UNEVEN = 16.0F;

/** \brief Fits planes to the k nearest of all samples, themselves among them.
 *
 * Where noise hides the surface from so few, the window doubles until it is flat, up to
 * 192: decided for some 64 samples together, as the noise is that of their place, and
 * no further where the residuals grow, which is then the shape of the surface and no
 * noise. Where heights fall into two clumps, which are two sheets of a thin part, each
 * sample has a plane through its own. Sheets less than six standard deviations of the
 * noise apart look much like one in a single window: there most of the 64 have to
 * agree.
 *
 * \param[in] k 3 or more
 */
PlaneFits
fitPlanes (const PointTree& tree, int k, const Workers& workers);

} // namespace crest
} // namespace pcl
