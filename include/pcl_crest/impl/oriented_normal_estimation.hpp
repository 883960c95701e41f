// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_crest/oriented_normal_estimation.h>

#include <pcl/common/io.h>
#include <pcl/features/impl/feature.hpp>

#include <limits>
#include <new>
#include <stdexcept>
#include <string>
#include <type_traits>

namespace pcl {

static_assert (std::is_same<index_t, crest::index_t>::value,
               "PCL has to be built with indices of 32 bits, as it is by default");

namespace crest {

/** \brief A cloud of PCL as plain arrays, with normals where its points have some. */
template <typename PointT>
PointView
viewOf (const pcl::PointCloud<PointT>& cloud)
{
  if (cloud.empty())
    return {nullptr, nullptr, sizeof (PointT) / sizeof (float), 0};
  const PointT& first = cloud.front();
  PointView view{&first.x, nullptr, sizeof (PointT) / sizeof (float), cloud.size()};
  if constexpr (pcl::traits::has_normal<PointT>::value)
    view.normal = &first.normal_x;
  return view;
}

/** \brief What to say of a cloud of more than MOST_POINTS, or one whose width and
 * height are not those of its points; else nothing. Where they were never set (0), PCL
 * takes a cloud for one row, too.
 */
template <typename PointT>
std::string
explainUnfit (const pcl::PointCloud<PointT>& cloud)
{
  const std::string points = "A cloud of " + std::to_string (cloud.size()) + " points ";
  if (cloud.size() > MOST_POINTS)
    return points + "is too large for 32-bit indices, which tell " +
           std::to_string (MOST_POINTS) +
           " points apart: compute it in parts that overlap";
  const std::size_t in_rows = std::size_t (cloud.width) * cloud.height;
  if (in_rows != 0 && in_rows != cloud.size())
    return points + "has a width of " + std::to_string (cloud.width) +
           " and a height of " + std::to_string (cloud.height) +
           ": set these to its size and 1";
  return {};
}

/** \brief What is known of the side of a cloud's normals.
 * \param[in] viewpoint, up that somebody set; without, the viewpoint is what the cloud
 * says of where it was seen from
 */
template <typename PointT>
NormalHints
hintsOf (const pcl::PointCloud<PointT>& cloud,
         const std::optional<Eigen::Vector3f>& viewpoint,
         const std::optional<Eigen::Vector3f>& up)
{
  NormalHints hints;
  const Eigen::Vector3f origin = cloud.sensor_origin_.template head<3>();
  hints.viewpoint = viewpoint.value_or (origin);
  hints.viewpoint_assumed = !viewpoint && origin.isZero (0.0F);
  hints.organized = cloud.isOrganized();
  hints.up = up;
  return hints;
}

/** What tells the side of normals that is not known. */
constexpr const char* SIDE_SETTERS = " setViewPoint tells it, or setUpDirection.";

/** \brief Says what of the signs of a class's normals is not to be trusted. */
inline void
warnOfDoubt (const std::string& class_name, const NormalEstimate& estimate)
{
  const std::string doubt = explainDoubt (estimate);
  if (estimate.parts.empty())
    PCL_WARN ("[pcl::%s::compute] No three points span a plane, so that there are no "
              "normals.\n",
              class_name.c_str());
  else if (!doubt.empty())
    PCL_WARN ("[pcl::%s::compute] %s.%s\n",
              class_name.c_str(),
              doubt.c_str(),
              estimate.canBeTold() ? SIDE_SETTERS : "");
}

} // namespace crest

template <typename PointInT, typename PointOutT>
bool
OrientedNormalEstimation<PointInT, PointOutT>::initCompute()
{
  // What a compute that ran out of memory has left.
  this->deinitCompute();
  forget();
  const auto refuse = [this] (const std::string& why) {
    PCL_ERROR ("[pcl::%s::compute] %s.\n", getClassName().c_str(), why.c_str());
    this->deinitCompute();
    return false;
  };
  for (const auto& cloud : {input_, surface_}) {
    const std::string unfit = cloud ? crest::explainUnfit (*cloud) : std::string();
    if (!unfit.empty())
      return refuse (unfit);
  }
  if (!PCLBase<PointInT>::initCompute())
    return refuse ("No input cloud was given: call setInputCloud first");
  if (input_->empty())
    return refuse ("The input cloud is empty");
  for (const index_t index : *indices_)
    if (index < 0 || static_cast<std::size_t> (index) >= input_->size())
      return refuse ("Index " + std::to_string (index) +
                     " is outside the input cloud of " +
                     std::to_string (input_->size()) + " points");
  if (search_radius_ != 0.0)
    return refuse ("A radius of " + std::to_string (search_radius_) +
                   " is set, but planes are fitted to k neighbours: set k");
  if (tree_)
    PCL_WARN ("[pcl::%s::compute] The search method is not used: the neighbours are "
              "found by a search of the library's own.\n",
              getClassName().c_str());
  if (!surface_) {
    fake_surface_ = true;
    surface_ = input_;
  }
  if (surface_->empty())
    return refuse ("The search surface is empty: set one that has the input points, or "
                   "none to search the input cloud");
  return true;
}

template <typename PointInT, typename PointOutT>
void
OrientedNormalEstimation<PointInT, PointOutT>::estimate (PointCloudOut& output)
{
  crest::NormalRequest request;
  request.cloud = crest::viewOf (*surface_);
  if (k_ != 0)
    request.k = k_;
  request.hints = crest::hintsOf (*surface_, viewpoint_, up_);
  request.threads = threads_;
  pcl::Indices located = *indices_;
  if (surface_ != input_) {
    const index_t stranger = crest::locatePoints (
        crest::viewOf (*input_), *indices_, request.cloud, located);
    if (stranger >= 0)
      throw std::invalid_argument ("Input point " + std::to_string (stranger) +
                                   " is not a point of the search surface");
  }
  crest::NormalEstimate found = crest::estimateNormals (request);
  crest::warnOfDoubt (getClassName(), found);
  constexpr float NAN_VALUE = std::numeric_limits<float>::quiet_NaN();
  output.is_dense = true;
  for (std::size_t i = 0; i < output.size(); ++i) {
    pcl::copyPoint ((*input_)[static_cast<std::size_t> ((*indices_)[i])], output[i]);
    const auto point = static_cast<std::size_t> (located[i]);
    const bool has_normal = located[i] >= 0 && found.part[point] >= 0;
    output[i].getNormalVector3fMap() =
        has_normal ? found.normals[point] : Eigen::Vector3f::Constant (NAN_VALUE);
    output[i].curvature = has_normal ? found.variation[point] : NAN_VALUE;
    output.is_dense = output.is_dense && has_normal;
    trust_.push_back (has_normal ? found.trust[point] : 0.0F);
    part_of_.push_back (has_normal ? found.part[point] : -1);
  }
  parts_ = std::move (found.parts);
}

template <typename PointInT, typename PointOutT>
void
OrientedNormalEstimation<PointInT, PointOutT>::computeFeature (PointCloudOut& output)
{
  const auto leaveNothing = [this, &output] {
    forget();
    output.clear();
    output.width = output.height = 0;
    // Feature::compute does so only where nothing is thrown.
    this->deinitCompute();
  };
  try {
    estimate (output);
  }
  catch (const std::bad_alloc&) {
    leaveNothing();
    throw;
  }
  catch (const std::exception& problem) {
    PCL_ERROR ("[pcl::%s::compute] %s.\n", getClassName().c_str(), problem.what());
    leaveNothing();
  }
}

} // namespace pcl

#define PCL_INSTANTIATE_OrientedNormalEstimation(T, OutT)                              \
  template class PCL_CREST_EXPORT pcl::OrientedNormalEstimation<T, OutT>
