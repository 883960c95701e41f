// SPDX-License-Identifier: BSD-3-Clause
// What can be used again when thresholds change.
#pragma once

#include <pcl_crest/types.h>

#include <memory>

namespace pcl {
namespace crest {

/** \brief A point that the stages worked on: finite, with a unit normal, one for all
 * coincident points of the cloud.
 */
struct Sample {
  /** where it is in the cloud; of coincident points the first */
  index_t point;
  Eigen::Vector3f position;
  Eigen::Vector3f normal;
  /** mean distance to its 6 nearest, in the cloud's unit */
  float spacing;
  /** whether the surface ends here (paper, section 4.1) */
  bool boundary;
  PrincipalCurvature curvature;
};

struct AnalysisContents;

/** \brief What is known of a cloud before thresholds choose among its lines (paper,
 * sections 4.1 and 4.2), and all lines at some thresholds. A value: it never changes,
 * and may be shared.
 */
class PCL_CREST_EXPORT SurfaceAnalysis {
public:
  ~SurfaceAnalysis();
  SurfaceAnalysis (const SurfaceAnalysis&) = delete;
  SurfaceAnalysis&
  operator= (const SurfaceAnalysis&) = delete;

  /** \brief How many samples there are. They are in spatial order, so that every n-th
   * are spread over the surface.
   */
  index_t
  size () const;

  /** \param[in] i from 0 to size () - 1 */
  Sample
  sample (index_t i) const;

  /** \brief The sample of a point of the cloud; -1 for an invalid point.
   * \param[in] point its index in the cloud
   */
  index_t
  sampleOf (index_t point) const;

private:
  friend std::shared_ptr<const SurfaceAnalysis>
  makeAnalysis (AnalysisContents contents);
  friend const AnalysisContents&
  contentsOf (const SurfaceAnalysis& analysis);

  explicit SurfaceAnalysis (AnalysisContents contents);

  std::unique_ptr<const AnalysisContents> contents_;
};

} // namespace crest
} // namespace pcl
