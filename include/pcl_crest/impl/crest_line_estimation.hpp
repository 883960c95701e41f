// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_crest/crest_line_estimation.h>
#include <pcl_crest/impl/cloud_results.hpp>
#include <pcl_crest/impl/neighbor_search.hpp>

#include <pcl/common/io.h>
#include <pcl/common/point_tests.h>
#include <pcl/features/impl/feature.hpp>
#include <pcl/search/organized.h>
#include <pcl/conversions.h>

#include <atomic>

namespace pcl {

template <typename PointInT, typename PointOutT>
bool
CrestLineEstimation<PointInT, PointOutT>::initCompute()
{
  result_ = Result();
  const auto refuse = [this] (const std::string& why) {
    PCL_ERROR ("[pcl::%s::compute] %s.\n", getClassName().c_str(), why.c_str());
    this->deinitCompute();
    return false;
  };

  if (!PCLBase<PointInT>::initCompute())
    return refuse ("No input cloud was given: call setInputCloud first");
  if (input_->empty())
    return refuse ("The input cloud is empty");
  for (const index_t index : *indices_)
    if (index < 0 || static_cast<std::size_t> (index) >= input_->size())
      return refuse ("Index " + std::to_string (index) +
                     " is outside the input cloud of " +
                     std::to_string (input_->size()) + " points");
  if (k_ != 0 && search_radius_ != 0.0)
    return refuse ("Both k (" + std::to_string (k_) + ") and a radius (" +
                   std::to_string (search_radius_) + ") are set: set one of them to 0");
  if (tree_ && parameters_.batched_search)
    return refuse ("Both a search method and the batched search are set: call "
                   "setSearchMethod (nullptr) or setUseBatchedSearch (false)");
  const std::string invalid = crest::explainInvalid (getParameters());
  if (!invalid.empty())
    return refuse ("Invalid parameter: " + invalid);

  if (!surface_) {
    fake_surface_ = true;
    surface_ = input_;
  }
  return !tree_ || prepareSearchMethod();
}

template <typename PointInT, typename PointOutT>
bool
CrestLineEstimation<PointInT, PointOutT>::prepareSearchMethod()
{
  const auto refuse = [this] (const std::string& why) {
    PCL_ERROR ("[pcl::%s::compute] %s.\n", getClassName().c_str(), why.c_str());
    this->deinitCompute();
    return false;
  };
  if (surface_->is_dense)
    for (std::size_t i = 0; i < surface_->size(); ++i)
      if (!pcl::isXYZFinite ((*surface_)[i]))
        return refuse (
            "Point " + std::to_string (i) +
            " is not finite, though is_dense of its cloud is true: set it to "
            "false to use a search method of your own");
  tree_->setInputCloud (surface_);
  const auto* const organized =
      dynamic_cast<const pcl::search::OrganizedNeighbor<PointInT>*> (tree_.get());
  if (organized != nullptr && !organized->isValid())
    return refuse (
        "OrganizedNeighbor cannot search this cloud, which is not the image of "
        "a projective device: leave the search method away, or set a KdTree");
  return true;
}

template <typename PointInT, typename PointOutT>
crest::PointView
CrestLineEstimation<PointInT, PointOutT>::viewOf (const PointCloudIn& cloud)
{
  const PointInT& first = cloud.front();
  return {&first.x, &first.normal_x, sizeof (PointInT) / sizeof (float), cloud.size()};
}

template <typename PointInT, typename PointOutT>
void
CrestLineEstimation<PointInT, PointOutT>::computeFeature (PointCloudOut& output)
{
  const auto fail = [&output] {
    output.clear();
    output.width = output.height = 0;
  };
  const crest::Parameters parameters = getParameters();
  std::vector<crest::StageTime> times;
  crest::Stopwatch watch (times);
  const crest::OrientedPoints points = crest::packOrientedPoints (viewOf (*surface_));
  pcl::Indices packed_indices;
  if (surface_ == input_)
    for (const index_t i : *indices_)
      packed_indices.push_back (points.packed_index[i]);
  else {
    const index_t stranger = crest::locatePoints (
        viewOf (*input_), *indices_, viewOf (*surface_), points, packed_indices);
    if (stranger >= 0) {
      PCL_ERROR ("[pcl::%s::compute] Input point %d is not a point of the search "
                 "surface, so that it has no place in the graph of its samples.\n",
                 getClassName().c_str(),
                 static_cast<int> (stranger));
      return fail();
    }
  }
  watch.stageDone ("packing");

  std::atomic<bool> stale_search{false};
  const crest::NeighborSearch given_search = [&] (index_t point, pcl::Indices& found) {
    crest::findNeighbors<PointInT> (*tree_,
                                    (*surface_)[points.cloud_index[point]],
                                    parameters.k,
                                    parameters.radius,
                                    found);
    std::size_t kept = 0;
    for (const index_t i : found)
      if (i < 0 || static_cast<std::size_t> (i) >= surface_->size())
        stale_search = true;
      else if (points.packed_index[i] != crest::OrientedPoints::INVALID)
        found[kept++] = points.packed_index[i];
    found.resize (kept);
  };
  const crest::SurfaceShape shape =
      tree_ ? crest::analyzeSurface (points, given_search, parameters)
            : crest::analyzeSurface (points, parameters);
  if (stale_search) {
    PCL_ERROR (
        "[pcl::%s::compute] The search method returned points outside the cloud: "
        "it does not search the cloud that it was given.\n",
        getClassName().c_str());
    return fail();
  }
  crest::Crests crests = crest::extractCrests (points, shape, parameters);
  times.insert (times.end(), shape.times.begin(), shape.times.end());
  times.insert (times.end(), crests.times.begin(), crests.times.end());

  const std::vector<crest::Label> labels =
      crest::labelPoints (shape, crests, parameters);
  pcl::PointCloud<pcl::PrincipalCurvatures>& curvatures = result_.curvatures;
  curvatures.header = output.header;
  for (std::size_t i = 0; i < packed_indices.size(); ++i) {
    pcl::copyPoint ((*input_)[(*indices_)[i]], output[i]);
    output[i].label = crest::labelAt (labels, packed_indices[i]);
    curvatures.push_back (crest::curvatureAt (shape, packed_indices[i]));
    if (output[i].label == crest::LABEL_INVALID)
      curvatures.is_dense = false;
  }
  curvatures.width = output.width;
  curvatures.height = output.height;
  result_.lines = crest::linesOfCloud (points, std::move (crests.lines));
  result_.line_cloud =
      crest::cloudOfLines (*surface_, points, result_.lines, crests.positions);
  result_.complete = true;
  result_.statistics = {
      shape.graph.mean_spacing, points.extent, std::move (crests.sizes), times};
}

template <typename PointInT, typename PointOutT>
void
CrestLineEstimation<PointInT, PointOutT>::compute (PointCloudOut& labels,
                                                   pcl::PolygonMesh& lines)
{
  lines = pcl::PolygonMesh();
  compute (labels);
  if (!result_.complete)
    return;
  pcl::toPCLPointCloud2 (*result_.line_cloud, lines.cloud);
  lines.header = lines.cloud.header;
  for (const crest::CrestLine& line : result_.lines)
    for (const std::vector<index_t>& polyline : line.polylines) {
      pcl::Vertices vertices;
      vertices.vertices.assign (polyline.begin(), polyline.end());
      lines.polygons.push_back (std::move (vertices));
    }
}

} // namespace pcl

#define PCL_INSTANTIATE_CrestLineEstimation(T, OutT)                                   \
  template class PCL_EXPORTS pcl::CrestLineEstimation<T, OutT>
