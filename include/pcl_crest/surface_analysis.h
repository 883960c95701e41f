// SPDX-License-Identifier: BSD-3-Clause
// What can be used again when thresholds change.
#pragma once

#include <pcl_crest/crest_extraction.h>

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <memory>

namespace pcl {
namespace crest {

/** \brief What is known of a cloud before thresholds choose among its lines. A value:
 * it never changes, and may be shared.
 */
struct SurfaceAnalysis {
  /** of the cloud (see fingerprint) */
  std::uint64_t cloud = 0;
  std::shared_ptr<const OrientedPoints> points;
  std::shared_ptr<const SurfaceShape> shape;
  /** all lines of both types */
  std::shared_ptr<const Crests> traced;
  /** those of the cloud's points, in its order; null where it was computed for others
   */
  pcl::PointCloud<pcl::PrincipalCurvatures>::ConstPtr curvatures;
  /** that it was made with */
  Parameters parameters;
};

/** \brief The first parameter that the shape of a surface depends on and that differs:
 * its name and both values, in words for the user. Empty if the shape is the same.
 */
std::string
explainOtherShape (const Parameters& made_with, const Parameters& wanted);

/** \brief Whether, on the same shape, traceCrests gives the same. Lines of one type
 * depend on M of the other, too, as they do not grow over its points.
 */
bool
haveSameTrace (const Parameters& a, const Parameters& b);

} // namespace crest
} // namespace pcl
