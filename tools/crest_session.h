// SPDX-License-Identifier: BSD-3-Clause
// A cloud whose thresholds change while its lines are looked at.
#pragma once

#include <pcl_crest/crest_line_estimation.h>
#include <pcl_crest/io/read_cloud.h>

namespace pcl {
namespace crest {

/** \brief A cloud, its crest lines at the thresholds of the moment, and the analysis
 * that serves the next ones.
 */
class CrestSession {
public:
  using Estimation = pcl::CrestLineEstimation<pcl::PointNormal>;

  /** \brief Runs all stages.
   * \param[in] parameters valid ones
   * \param[in] progress told how far they are; once it says not to go on, there are no
   * labels, and nothing else of the session can be used
   */
  CrestSession (InputCloud cloud,
                const Parameters& parameters,
                const ProgressCallback& progress = nullptr);

  /** \brief Changes thresholds. min_size, min_strength, wanted, positions and
   * boundaries only choose among what is there; maximality, prune, angle, min_length
   * and confidence repeat section 4.3 and what follows.
   * \param[in] thresholds those of getParameters with other values of these
   */
  void
  setThresholds (const Parameters& thresholds);

  const InputCloud&
  getCloud () const
  {
    return cloud_;
  }
  const SurfaceAnalysis&
  getAnalysis () const
  {
    return *estimation_.getAnalysis();
  }
  Parameters
  getParameters () const
  {
    return estimation_.getParameters();
  }
  /** \brief One for each point of the cloud. */
  const pcl::PointCloud<pcl::Label>&
  getLabels () const
  {
    return labels_;
  }
  const std::vector<CrestLine>&
  getLines () const
  {
    return estimation_.getLines();
  }
  const pcl::PointCloud<pcl::PointNormal>&
  getLineCloud () const
  {
    return *estimation_.getLineCloud();
  }
  const pcl::PointCloud<pcl::PrincipalCurvatures>&
  getCurvatures () const
  {
    return estimation_.getPrincipalCurvatures();
  }
  /** \brief Its times are those of the stages that the last change repeated. */
  const Estimation::Statistics&
  getStatistics () const
  {
    return estimation_.getStatistics();
  }

private:
  InputCloud cloud_;
  Estimation estimation_;
  pcl::PointCloud<pcl::Label> labels_;
};

} // namespace crest
} // namespace pcl
