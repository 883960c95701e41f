// SPDX-License-Identifier: BSD-3-Clause
// Normals that look to one side of the surface, as a pcl::Feature.
#pragma once

#include <pcl_crest/normal_estimation.h>

#include <pcl/features/feature.h>
#include <pcl/point_types.h>

#include <optional>

namespace pcl {

/** \brief OrientedNormalEstimation estimates the normals of a cloud, as
 * NormalEstimation does, and turns them to one side of the surface (see
 * crest::estimateNormals): toward the viewpoint where all was seen from there, else
 * outward of closed surfaces, toward the viewpoint of open ones, or up.
 *
 * \code
 * pcl::OrientedNormalEstimation<pcl::PointXYZ, pcl::Normal> estimation;
 * estimation.setInputCloud (cloud);
 * pcl::PointCloud<pcl::Normal> normals;
 * estimation.compute (normals);
 * \endcode
 *
 * The k neighbours, 24 unless setKSearch says otherwise, are found by the library's own
 * search: one that is set with setSearchMethod is not used, and PCL_WARN says so; a
 * radius is a mistake. setIndices restricts the points that normals are given out for,
 * not the surface; with setSearchSurface every finite input point has to be a point of
 * that surface.
 *
 * As of NormalEstimation the normals of points that are not finite, or whose neighbours
 * span no plane, are NaN, and is_dense of the output is then false. As there the
 * viewpoint is sensor_origin_ of the cloud unless one is set; but at the origin, where
 * most clouds have it that say nothing of a sensor, it is no more than a guess.
 *
 * Mistakes are reported with PCL_ERROR and leave the output empty. Where memory does
 * not suffice it is left empty, too, and std::bad_alloc is thrown.
 *
 * Compiled into the library for pcl::Normal and PointXYZ, PointXYZI, PointXYZRGB,
 * PointXYZRGBA and PointNormal, and for PointNormal and PointXYZ and PointNormal; for
 * other types include pcl_crest/impl/oriented_normal_estimation.hpp, or define
 * PCL_NO_PRECOMPILE.
 *
 * \tparam PointInT a point type with xyz
 * \tparam PointOutT a point type with normal and curvature; fields it shares with
 * PointInT are copied. curvature is the variation of the surface, the smallest
 * eigenvalue of the neighbours' covariance over the sum of all
 * \ingroup features
 */
template <typename PointInT, typename PointOutT = pcl::Normal>
class PCL_CREST_EXPORT OrientedNormalEstimation : public Feature<PointInT, PointOutT> {
  static_assert (pcl::traits::has_xyz<PointInT>::value,
                 "the input points need x, y and z, as in pcl::PointXYZ");
  static_assert (pcl::traits::has_normal<PointOutT>::value &&
                     pcl::traits::has_curvature<PointOutT>::value,
                 "the output points need a normal and curvature, as in pcl::Normal");

public:
  using Ptr = shared_ptr<OrientedNormalEstimation<PointInT, PointOutT>>;
  using ConstPtr = shared_ptr<const OrientedNormalEstimation<PointInT, PointOutT>>;
  using typename Feature<PointInT, PointOutT>::PointCloudIn;
  using typename Feature<PointInT, PointOutT>::PointCloudOut;

  OrientedNormalEstimation() { feature_name_ = "OrientedNormalEstimation"; }

  /** \brief Set where the cloud was seen from, in its unit. */
  void
  setViewPoint (float x, float y, float z)
  {
    viewpoint_ = Eigen::Vector3f (x, y, z);
  }

  /** \brief Undo setViewPoint: the viewpoint is sensor_origin_ of the surface, which is
   * the input cloud unless setSearchSurface is used. At the origin it is one that is
   * assumed (see crest::NormalHints).
   */
  void
  useSensorOriginAsViewPoint ()
  {
    viewpoint_.reset();
  }

  /** \brief Set the side of open parts that no viewpoint decides; +z by default,
   * which is a guess. */
  void
  setUpDirection (float x, float y, float z)
  {
    up_ = Eigen::Vector3f (x, y, z);
  }

  /** \brief Set the number of threads; 0 takes all processors. */
  void
  setNumberOfThreads (unsigned nr_threads = 0)
  {
    threads_ = nr_threads;
  }

  /** \brief How sure the sign of each normal of the last compute is, 0 to 1 (see
   * crest::NormalEstimate::trust); from crest::SURE_SIGN on it is known.
   */
  const std::vector<float>&
  getTrust () const
  {
    return trust_;
  }

  /** \brief The connected parts of the last compute's surface, the largest first. */
  const std::vector<crest::NormalPart>&
  getParts () const
  {
    return parts_;
  }

  /** \brief Of each normal of the last compute its part, or -1. */
  const std::vector<crest::index_t>&
  getPartOfPoints () const
  {
    return part_of_;
  }

protected:
  using Feature<PointInT, PointOutT>::feature_name_;
  using Feature<PointInT, PointOutT>::getClassName;
  using Feature<PointInT, PointOutT>::input_;
  using Feature<PointInT, PointOutT>::indices_;
  using Feature<PointInT, PointOutT>::fake_indices_;
  using Feature<PointInT, PointOutT>::surface_;
  using Feature<PointInT, PointOutT>::fake_surface_;
  using Feature<PointInT, PointOutT>::tree_;
  using Feature<PointInT, PointOutT>::k_;
  using Feature<PointInT, PointOutT>::search_radius_;

  /** \brief Checks the input. Takes the place of Feature::initCompute, which builds a
   * search that is not used.
   */
  bool
  initCompute () override;

private:
  void
  computeFeature (PointCloudOut& output) override;

  /** \brief All of the work; throws where it cannot be done. */
  void
  estimate (PointCloudOut& output);

  /** \brief Leaves nothing of the last compute. */
  void
  forget ()
  {
    trust_.clear();
    parts_.clear();
    part_of_.clear();
  }

  std::optional<Eigen::Vector3f> viewpoint_;
  std::optional<Eigen::Vector3f> up_;
  unsigned threads_ = 0;
  std::vector<float> trust_;
  std::vector<crest::NormalPart> parts_;
  std::vector<crest::index_t> part_of_;
};

} // namespace pcl

#ifdef PCL_NO_PRECOMPILE
#include <pcl_crest/impl/oriented_normal_estimation.hpp>
#endif
