// SPDX-License-Identifier: BSD-3-Clause
// A cloud whose thresholds change while its lines are looked at.
#pragma once

#include <pcl_crest/crest_line_estimation.h>
#include <pcl_crest/io/read_cloud.h>

#include <functional>

namespace pcl {
namespace crest {

/** \brief What was found out about a cloud, and its crest lines at the thresholds of
 * the moment. It gives what CrestLineEstimation gives with the same parameters, but
 * repeats no more of the stages than a change asks for.
 */
class CrestSession {
public:
  using Statistics = pcl::CrestLineEstimation<pcl::PointNormal>::Statistics;

  /** \brief Runs all stages.
   * \param[in] parameters valid ones
   * \param[in] tell called with what comes next, before each long part of the work
   */
  CrestSession (
      InputCloud cloud,
      const Parameters& parameters,
      const std::function<void (const std::string&)>& tell = [] (const std::string&) {
      });

  /** \brief Changes thresholds. min_size, min_strength, wanted, positions and
   * boundaries only choose among what is there; maximality, prune, angle, min_length
   * and confidence repeat section 4.3 and what follows. All that the surface's shape
   * depends on stays as it is.
   */
  void
  setThresholds (const Parameters& thresholds);

  const InputCloud&
  getCloud () const
  {
    return cloud_;
  }
  const SurfaceShape&
  getShape () const
  {
    return shape_;
  }
  const OrientedPoints&
  getPoints () const
  {
    return points_;
  }
  const Parameters&
  getParameters () const
  {
    return parameters_;
  }
  /** \brief As CrestLineEstimation::getLines. */
  const std::vector<CrestLine>&
  getLines () const
  {
    return lines_;
  }
  /** \brief As CrestLineEstimation::getLineCloud. */
  const pcl::PointCloud<pcl::PointNormal>&
  getLineCloud () const
  {
    return line_cloud_;
  }

  /** \brief One for each point of the cloud. */
  pcl::PointCloud<pcl::Label>
  labels () const;

  /** \brief As CrestLineEstimation::getPrincipalCurvatures. */
  pcl::PointCloud<pcl::PrincipalCurvatures>
  curvatures () const;

  /** \brief Those of the last change; its times are those of the stages it repeated. */
  const Statistics&
  getStatistics () const
  {
    return statistics_;
  }

private:
  void
  trace ();
  void
  keep ();

  InputCloud cloud_;
  Parameters parameters_;
  OrientedPoints points_;
  SurfaceShape shape_;
  /** of both types, whichever are wanted */
  Crests traced_;
  Crests crests_;
  std::vector<CrestLine> lines_;
  pcl::PointCloud<pcl::PointNormal> line_cloud_;
  Statistics statistics_;
};

} // namespace crest
} // namespace pcl
