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

  /** \brief Discs that are near each other, coordinate by coordinate; those that are
   * missing have no radius.
   */
  struct Discs {
    float center[3][CHILDREN] = {};
    float normal[3][CHILDREN] = {};
    float squared_radius[CHILDREN] = {};
  };

  /** \brief Their boxes, or those of such boxes. */
  struct alignas (64) Boxes {
    float low[3][CHILDREN] = {};
    float high[3][CHILDREN] = {};
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

  struct Ray {
    Eigen::Vector3f from;
    Eigen::Vector3f direction;
  };

  /** \brief Adds the discs of a group that a ray meets.
   * \return whether it runs along none
   */
  static bool
  meet (const Ray& ray, const Discs& discs, std::vector<Hit>& hits);

  /** \brief The boxes that a ray meets, a bit each. */
  static unsigned
  meet (const Ray& ray, const Boxes& boxes);

  /** \brief The discs that a ray meets, in no special order.
   * \return whether it runs along none
   */
  bool
  findHits (const Ray& ray, std::vector<Hit>& hits) const;

  Sheets
  countSheets (const Ray& ray, float spacing) const;

  const PlaneFits& fits_;
  std::vector<Discs> discs_;
  /** group g of a level has the boxes of groups CHILDREN g and so on of the level
   * below; the last has one group */
  std::vector<std::vector<Boxes>> levels_;
};

} // namespace crest
} // namespace pcl
