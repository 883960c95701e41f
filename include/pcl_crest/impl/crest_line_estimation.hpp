// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_crest/crest_line_estimation.h>
#include <pcl_crest/impl/cloud_results.hpp>
#include <pcl_crest/impl/neighbor_search.hpp>
#include <pcl_crest/search/point_tree.h>

#include <pcl/common/io.h>
#include <pcl/common/point_tests.h>
#include <pcl/features/impl/feature.hpp>
#include <pcl/search/organized.h>
#include <pcl/conversions.h>

#include <atomic>
#include <exception>
#include <new>
#include <stdexcept>

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

  for (const auto& cloud : {input_, surface_})
    if (cloud && cloud->size() > crest::MOST_POINTS)
      return refuse ("A cloud of " + std::to_string (cloud->size()) +
                     " points is too large for 32-bit indices, which tell " +
                     std::to_string (crest::MOST_POINTS) +
                     " points apart: compute it in parts that overlap");
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
  if (surface_->empty())
    return refuse ("The search surface is empty: set one that has the input points, or "
                   "none to search the input cloud");
  if (analysis_) {
    const std::string other =
        crest::explainOtherShape (analysis_->parameters, getParameters());
    if (!other.empty())
      return refuse ("The analysis that is set was made with " + other +
                     ": call setAnalysis (nullptr), or set what it was made with");
    if (analysis_->cloud != fingerprint (*surface_))
      return refuse ("The analysis that is set is that of another cloud: call "
                     "setAnalysis (nullptr) when the cloud has changed");
    return true;
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
  try {
    tree_->setInputCloud (surface_);
  }
  catch (const std::exception& problem) {
    return refuse (std::string ("The search method failed: ") + problem.what());
  }
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
std::uint64_t
CrestLineEstimation<PointInT, PointOutT>::fingerprint (const PointCloudIn& cloud) const
{
  return crest::fingerprint (viewOf (cloud), parameters_.threads);
}

template <typename PointInT, typename PointOutT>
bool
CrestLineEstimation<PointInT, PointOutT>::locateInput (
    const crest::OrientedPoints& points, pcl::Indices& packed) const
{
  if (surface_ == input_) {
    packed.reserve (indices_->size());
    for (const index_t i : *indices_)
      packed.push_back (points.packed_index[i]);
    return true;
  }
  const index_t stranger = crest::locatePoints (
      viewOf (*input_), *indices_, viewOf (*surface_), points, packed);
  if (stranger < 0)
    return true;
  PCL_ERROR (
      "[pcl::%s::compute] Input point %d is not a point of the search surface, so "
      "that it has no place in the graph of its samples.\n",
      getClassName().c_str(),
      static_cast<int> (stranger));
  return false;
}

template <typename PointInT, typename PointOutT>
bool
CrestLineEstimation<PointInT, PointOutT>::analyze (const crest::OrientedPoints& points,
                                                   crest::Progress& progress,
                                                   crest::SurfaceShape& shape) const
{
  const crest::Parameters parameters = getParameters();
  std::atomic<bool> stale_search{false};
  const crest::NeighborSearch given_search = [&] (index_t point, pcl::Indices& found) {
    try {
      crest::findNeighbors<PointInT> (*tree_,
                                      (*surface_)[points.cloud_index[point]],
                                      parameters.k,
                                      parameters.radius,
                                      found);
    }
    catch (const std::bad_alloc&) {
      throw;
    }
    catch (const std::exception& problem) {
      throw std::runtime_error (std::string ("The search method failed: ") +
                                problem.what());
    }
    std::size_t kept = 0;
    for (const index_t i : found)
      if (i < 0 || static_cast<std::size_t> (i) >= surface_->size())
        stale_search = true;
      else if (points.packed_index[i] != crest::OrientedPoints::INVALID)
        found[kept++] = points.packed_index[i];
    found.resize (kept);
    if (!(parameters.radius > 0.0))
      crest::keepNearest (points, point, parameters.k, found);
  };
  shape = tree_ ? crest::analyzeSurface (points, given_search, parameters, &progress)
                : crest::analyzeSurface (points, parameters, &progress);
  if (stale_search)
    PCL_ERROR (
        "[pcl::%s::compute] The search method returned points outside the cloud: "
        "it does not search the cloud that it was given.\n",
        getClassName().c_str());
  return !stale_search;
}

template <typename PointInT, typename PointOutT>
bool
CrestLineEstimation<PointInT, PointOutT>::extract (crest::Progress& progress,
                                                   PointCloudOut& output)
{
  const crest::Parameters parameters = getParameters();
  std::vector<crest::StageTime> times;
  crest::Stopwatch watch (times);
  std::shared_ptr<const crest::OrientedPoints> points;
  std::shared_ptr<const crest::SurfaceShape> shape;
  // What is made for this compute alone, which goes as soon as it is not needed.
  std::shared_ptr<crest::OrientedPoints> own_points;
  std::shared_ptr<crest::SurfaceShape> own_shape;
  if (analysis_) {
    points = analysis_->points;
    shape = analysis_->shape;
  }
  else
    points = own_points = std::make_shared<crest::OrientedPoints> (
        crest::packOrientedPoints (viewOf (*surface_), parameters.threads));
  if (points->size() == 0 && !surface_->empty())
    PCL_WARN ("[pcl::%s::compute] No point has a finite position and a normal, so "
              "that there are no crests. pcl::NormalEstimation estimates normals.\n",
              getClassName().c_str());
  pcl::Indices located;
  if (!isInputSurface() && !locateInput (*points, located))
    return false;
  const pcl::Indices& packed_indices =
      isInputSurface() ? points->packed_index : located;
  if (!analysis_) {
    watch.stageDone ("packing");
    shape = own_shape = std::make_shared<crest::SurfaceShape>();
    if (!analyze (*points, progress, *own_shape))
      return false;
    times.insert (times.end(), shape->times.begin(), shape->times.end());
  }
  if (keep_analysis_) {
    own_points.reset();
    own_shape.reset();
  }

  std::shared_ptr<const crest::Crests> traced;
  if (analysis_ && crest::haveSameTrace (analysis_->parameters, parameters))
    traced = analysis_->traced;
  if (!traced) {
    crest::Stopwatch crest_watch (times);
    std::vector<crest::CrestType> crest_points =
        crest::findCrestPoints (*points, *shape, parameters, &progress);
    if (own_shape && parameters.preset == crest::Preset::PAPER) {
      own_points->normals = std::vector<Eigen::Vector3f>();
      own_shape->maximality = std::vector<double>();
    }
    crest_watch.stageDone ("crest points");
    crest::Parameters wanted = parameters;
    if (keep_analysis_)
      wanted.wanted = {true, true};
    traced = std::make_shared<const crest::Crests> (crest::traceCrests (
        *points, *shape, std::move (crest_points), wanted, &progress));
    for (const crest::StageTime& time : traced->times)
      crest::addTime (times, time);
  }
  crest::Crests crests = crest::keepLines (*points, *shape, *traced, parameters);
  const std::vector<crest::Label> labels =
      crest::labelPoints (*shape, crests, parameters);
  result_.statistics = {
      shape->graph.mean_spacing, points->extent, std::move (crests.sizes), times};
  if (own_shape) {
    // Outputs take the place of these.
    own_shape->graph = crest::SurfaceGraph();
    own_shape->profiles = std::vector<crest::CrestProfile>();
    traced.reset();
  }
  writeLabels (packed_indices, labels, output);
  const bool known = analysis_ && analysis_->curvatures && isInputSurface() &&
                     crest::haveSameLayout (*analysis_->curvatures, output);
  result_.curvatures =
      known ? analysis_->curvatures
            : crest::curvaturesOf (packed_indices, shape->curvature, output);
  if (keep_analysis_)
    result_.analysis = std::make_shared<const crest::SurfaceAnalysis> (
        crest::SurfaceAnalysis{analysis_ ? analysis_->cloud : fingerprint (*surface_),
                               points,
                               shape,
                               traced,
                               isInputSurface() ? result_.curvatures : nullptr,
                               parameters});
  result_.lines = crest::linesOfCloud (*points, std::move (crests.lines));
  result_.line_cloud = surface_;
  if (!crests.positions.empty())
    result_.line_cloud =
        crest::cloudOfLines (*surface_, *points, result_.lines, crests.positions);
  progress.finish();
  return true;
}

template <typename PointInT, typename PointOutT>
void
CrestLineEstimation<PointInT, PointOutT>::writeLabels (
    const pcl::Indices& packed_indices,
    const std::vector<crest::Label>& labels,
    PointCloudOut& output) const
{
  for (std::size_t i = 0; i < packed_indices.size(); ++i) {
    pcl::copyPoint ((*input_)[(*indices_)[i]], output[i]);
    output[i].label = crest::labelAt (labels, packed_indices[i]);
  }
}

template <typename PointInT, typename PointOutT>
void
CrestLineEstimation<PointInT, PointOutT>::computeFeature (PointCloudOut& output)
{
  crest::Progress progress (progress_callback_);
  const auto leaveNothing = [this, &output] {
    result_ = Result();
    output.clear();
    output.width = output.height = 0;
    // Feature::compute does so only where nothing is thrown.
    this->deinitCompute();
  };
  try {
    result_.complete = extract (progress, output);
  }
  catch (const crest::Cancelled&) {
    PCL_WARN ("[pcl::%s::compute] Cancelled by the progress callback: there is no "
              "output.\n",
              getClassName().c_str());
  }
  catch (const std::bad_alloc&) {
    leaveNothing();
    throw;
  }
  catch (const std::exception& problem) {
    PCL_ERROR ("[pcl::%s::compute] %s.\n", getClassName().c_str(), problem.what());
  }
  catch (...) {
    leaveNothing();
    throw;
  }
  if (!result_.complete)
    leaveNothing();
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
