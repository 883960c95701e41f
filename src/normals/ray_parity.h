// SPDX-License-Identifier: BSD-3-Clause
// On which side of samples the inside of a closed surface is.
#pragma once

#include "normals/plane_fits.h"

namespace pcl {
namespace crest {

/** \brief Tells by rays whether the normals of samples look out of a closed surface: a
 * ray that meets an odd number of sheets starts inside (as Mullen et al. 2010 and
 * Takayama et al. 2014 do). Each sample is a disc in its plane.
 */
class RayParity {
public:
  /** \param[in] fits have to outlive this; signs of their normals may change */
  explicit RayParity (const PlaneFits& fits);

  /** \brief What rays from both sides of a sample say of the normal of its window: 1
   * that it looks outward, -1 inward, 0 that they disagree.
   */
  float
  vote (std::size_t sample) const;

private:
  static constexpr std::size_t CHILDREN = 8;

  struct Disc {
    Eigen::Vector3f center;
    Eigen::Vector3f normal;
    float radius;
  };

  struct Box {
    Eigen::Array3f low;
    Eigen::Array3f high;
  };

  /** \brief Where a ray meets a disc, and the cosine between them. */
  struct Hit {
    float distance;
    float cosine;
  };

  /** \brief The number of sheets that a ray meets. */
  struct Sheets {
    int count = 0;
    /** less than 1 where the ray grazes one, or meets one of few samples */
    float certainty = 1.0F;
  };

  /** \brief The discs that a ray meets, in no special order.
   * \return whether it runs along none
   */
  bool
  findHits (const Eigen::Vector3f& from,
            const Eigen::Vector3f& direction,
            std::vector<Hit>& hits) const;

  Sheets
  countSheets (const Eigen::Vector3f& from,
               const Eigen::Vector3f& direction,
               float spacing) const;

  const PlaneFits& fits_;
  std::vector<Disc> discs_;
  /** boxes of CHILDREN discs, of as many of these boxes, and so on */
  std::vector<std::vector<Box>> levels_;
};

} // namespace crest
} // namespace pcl
