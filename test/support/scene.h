// SPDX-License-Identifier: BSD-3-Clause
// Surfaces before sensors, with the crests that are to be found on them.
#pragma once

#include <Eigen/Geometry>

#include "ray_caster.h"

#include <optional>

namespace oracle {

/** \brief A face beside a sharp edge. */
struct EdgeSide {
  Eigen::Vector3d normal;
  /** in the face, away from the edge, of unit length */
  Eigen::Vector3d inward;
  /** how far the face goes on there */
  double width;
};

struct SceneCrest {
  TruthSegment segment;
  /** the two of a sharp edge; none where the surface is smooth */
  std::vector<EdgeSide> sides;
  /** of a sharp edge that of the narrower face; of a smooth crest how far apart its
   * curvature, a parabola across it, has fallen to zero: 2 sqrt (2 k1 / k1'')
   */
  double width;
};

struct Scene {
  std::string name;
  RayCaster cast;
  /** about as many even samples with exact normals; the same seed gives the same */
  std::function<pcl::PointCloud<pcl::PointNormal>::Ptr (std::size_t count,
                                                        unsigned seed)>
      sample;
  std::vector<SceneCrest> crests;
  /** \brief All that is in it is between these. */
  Eigen::Vector3d low, high;
};

/** \brief Of a solid whose faces are all flat. */
Scene
sceneOf (const SharpSolid& solid);

/** \brief Of a surface (u, v, z (u, v)). */
Scene
heightFieldScene (const AnalyticSurface& surface);

/** \brief Four blocks on a floor of 2 x 2 around the origin, at z = 0: two boxes, one
 * of them low, an L and a hexagon, none of them along an axis. Open below.
 */
SharpSolid
blocks ();

/** \brief All lengths times a factor. */
Scene
scaled (const Scene& scene, double factor);

/** \brief Where a sensor is that sends rays, and what these reach. */
struct View {
  /** of the sensor in the scene; its directions are z ahead, or up of what spins */
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  /** whether there are rays in that direction of the sensor's own axes */
  std::function<bool (const Eigen::Vector3d& direction)> covers;
  /** between neighbouring rays, where they are farthest apart, in radians */
  double step = 0.0;
};

/** \brief Eyes at a place that look at another, with x to the right and y down. */
Eigen::Isometry3d
lookAt (const Eigen::Vector3d& eye, const Eigen::Vector3d& target);

/** \brief The crests of a scene as truth to score lines by. Salient (salientLines) is
 * of them only what can be seen, on both sides, as wide as so many spacings; the rest
 * is true, too.
 *
 * \param[in] view what can be seen is on rays from there; without, all
 * \param[in] spacing of the samples, or of what they are gathered to. Where the rays of
 * the view meet the surface farther apart, that counts.
 */
std::vector<TruthSegment>
visibleCrests (const Scene& scene,
               const std::optional<View>& view,
               double spacing,
               double least_spacings);

} // namespace oracle
