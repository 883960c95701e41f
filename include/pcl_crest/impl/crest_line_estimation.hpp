// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_crest/crest_line_estimation.h>
#include <pcl_crest/impl/oriented_normal_estimation.hpp>

#include <pcl/common/io.h>
#include <pcl/common/point_tests.h>
#include <pcl/features/impl/feature.hpp>
#include <pcl/search/organized.h>
#include <pcl/conversions.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <new>
#include <stdexcept>

namespace pcl {

namespace crest {

/** \brief The neighbours of a point through any of PCL's searches: k with the point
 * itself, or all within the radius.
 *
 * Points as far away as the k-th are all found, however many: which of them a search
 * returns depends on its inner order.
 *
 * \param[in] search a search whose input cloud is set
 * \param[in] query the query point
 * \param[in] k the number of neighbours, where radius is 0
 * \param[in] radius in the unit of the searched cloud
 * \param[out] found indices into the input cloud of the search, in no special order
 */
template <typename PointT>
void
findNeighbors (const pcl::search::Search<PointT>& search,
               const PointT& query,
               int k,
               double radius,
               pcl::Indices& found)
{
  thread_local std::vector<float> distances;
  thread_local std::vector<float> ranked;
  if (radius > 0.0) {
    search.radiusSearch (query, radius, found, distances);
    return;
  }
  const auto checkDistances = [&found] {
    if (distances.size() != found.size())
      throw std::runtime_error ("it returned " + std::to_string (found.size()) +
                                " points with " + std::to_string (distances.size()) +
                                " distances");
  };
  search.nearestKSearch (query, k + 1, found, distances);
  checkDistances();
  if (found.size() <= static_cast<std::size_t> (k))
    return;
  ranked = distances;
  const auto kth = ranked.begin() + (k - 1);
  std::nth_element (ranked.begin(), kth, ranked.end());
  const auto limit = static_cast<float> (*kth * (1.0 + EQUIDISTANT));
  if (*std::max_element (kth, ranked.end()) <= limit) {
    // Searches leave out what is at the radius itself, and round on the way there.
    constexpr double WIDER = 1.0 + 1e-5;
    const float squared = std::max (limit, std::numeric_limits<float>::min());
    search.radiusSearch (query, WIDER * std::sqrt (squared), found, distances);
    checkDistances();
  }
  std::size_t kept = 0;
  for (std::size_t i = 0; i < found.size(); ++i)
    if (distances[i] <= limit)
      found[kept++] = found[i];
  found.resize (kept);
}

/** \brief The default: PCL's KdTree, as a SearchMaker. */
PCL_CREST_EXPORT NeighborSearch
kdTreeSearch (const std::vector<Eigen::Vector3f>& points, int k, double radius);

} // namespace crest

template <typename PointInT, typename PointOutT>
bool
CrestLineEstimation<PointInT, PointOutT>::initCompute()
{
  // What a compute that ran out of memory has left.
  this->deinitCompute();
  result_ = Result();
  if (known_curvatures_.source.expired())
    known_curvatures_ = KnownCurvatures();
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
  if (normals_ && normals_->size() != surface_->size())
    return refuse ("There are " + std::to_string (normals_->size()) +
                   " input normals for a surface of " +
                   std::to_string (surface_->size()) +
                   " points: set one normal for each, or none to estimate them");
  if (sign_trust_ && sign_trust_->size() != surface_->size())
    return refuse ("There are " + std::to_string (sign_trust_->size()) +
                   " trusts of signs for a surface of " +
                   std::to_string (surface_->size()) +
                   " points: set one for each, or none");
  if (sign_trust_ &&
      !std::all_of (sign_trust_->begin(), sign_trust_->end(), [] (float trust) {
        return trust >= 0.0F && trust <= 1.0F;
      }))
    return refuse ("The trust of a sign is not from 0 to 1");
  if (surface_->empty())
    return refuse ("The search surface is empty: set one that has the input points, or "
                   "none to search the input cloud");
  return analysis_ || !tree_ || prepareSearchMethod();
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
  catch (...) {
    return refuse ("The search method failed: it threw no std::exception");
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
CrestLineEstimation<PointInT, PointOutT>::surfaceView() const
{
  crest::PointView view = crest::viewOf (*surface_);
  if (normals_) {
    view.normal = &normals_->front().normal_x;
    view.normal_stride = sizeof (pcl::Normal) / sizeof (float);
  }
  return view;
}

template <typename PointInT, typename PointOutT>
bool
CrestLineEstimation<PointInT, PointOutT>::locateInput (pcl::Indices& located) const
{
  if (surface_ == input_) {
    located = *indices_;
    return true;
  }
  const index_t stranger =
      crest::locatePoints (crest::viewOf (*input_), *indices_, surfaceView(), located);
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
crest::NeighborSearch
CrestLineEstimation<PointInT, PointOutT>::givenSearch() const
{
  if (!tree_)
    return nullptr;
  const crest::Parameters parameters = getParameters();
  return [this, k = parameters.k, radius = parameters.radius] (
             crest::index_t point, std::vector<crest::index_t>& found) {
    try {
      crest::findNeighbors<PointInT> (
          *tree_, (*surface_)[static_cast<std::size_t> (point)], k, radius, found);
    }
    catch (const std::bad_alloc&) {
      throw;
    }
    catch (const std::exception& problem) {
      throw std::runtime_error (std::string ("The search method failed: ") +
                                problem.what());
    }
    catch (...) {
      throw std::runtime_error ("The search method failed: it threw no std::exception");
    }
  };
}

template <typename PointInT, typename PointOutT>
pcl::PointCloud<pcl::PrincipalCurvatures>::ConstPtr
CrestLineEstimation<PointInT, PointOutT>::curvaturesOf (const crest::Extraction& found,
                                                        const pcl::Indices& located,
                                                        const PointCloudOut& layout)
{
  const auto& known = known_curvatures_.cloud;
  if (isInputSurface() && known &&
      known_curvatures_.source.lock() == found.curvatures &&
      known->header == layout.header && known->width == layout.width &&
      known->height == layout.height)
    return known;
  constexpr float NAN_VALUE = std::numeric_limits<float>::quiet_NaN();
  auto curvatures = pcl::make_shared<pcl::PointCloud<pcl::PrincipalCurvatures>>();
  curvatures->reserve (layout.size());
  for (std::size_t i = 0; i < layout.size(); ++i) {
    const crest::PrincipalCurvature* const c = found.curvatureOf (
        isInputSurface() ? static_cast<crest::index_t> (i) : located[i]);
    if (c != nullptr)
      curvatures->push_back ({c->t1.x(), c->t1.y(), c->t1.z(), c->k1, c->k2});
    else {
      curvatures->push_back ({NAN_VALUE, NAN_VALUE, NAN_VALUE, NAN_VALUE, NAN_VALUE});
      curvatures->is_dense = false;
    }
  }
  curvatures->header = layout.header;
  curvatures->width = layout.width;
  curvatures->height = layout.height;
  if (isInputSurface() && keep_analysis_)
    known_curvatures_ = {found.curvatures, curvatures};
  return curvatures;
}

template <typename PointInT, typename PointOutT>
bool
CrestLineEstimation<PointInT, PointOutT>::extract (PointCloudOut& output)
{
  pcl::Indices located;
  if (!isInputSurface() && !locateInput (located))
    return false;
  crest::ExtractionRequest request;
  request.cloud = surfaceView();
  if (sign_trust_)
    request.sign_trust = sign_trust_->data();
  request.nodes = nodes_;
  request.hints = crest::hintsOf (*surface_, viewpoint_, up_);
  request.parameters = getParameters();
  request.search = givenSearch();
  request.make_search = crest::kdTreeSearch;
  request.progress = progress_callback_;
  request.analysis = analysis_;
  request.keep_analysis = keep_analysis_;
  crest::Extraction found = crest::extractCrests (request);
  if (found.labels.empty() && !found.normals)
    PCL_WARN ("[pcl::%s::compute] No point has a finite position and a normal, so "
              "that there are no crests.\n",
              getClassName().c_str());
  // With an analysis all was said when it was made.
  if (!analysis_)
    warnOfNormals (found);

  for (std::size_t i = 0; i < output.size(); ++i) {
    const auto place = static_cast<crest::index_t> (i);
    pcl::copyPoint ((*input_)[static_cast<std::size_t> ((*indices_)[i])], output[i]);
    output[i].label = found.labelOf (isInputSurface() ? place : located[i]);
  }
  const auto is_invalid = [] (const auto& point) {
    return point.label == crest::LABEL_INVALID;
  };
  if (search_radius_ > 0.0 && std::all_of (output.begin(), output.end(), is_invalid))
    PCL_WARN ("[pcl::%s::compute] No point has enough neighbours within the radius of "
              "%g, which is in the unit of the cloud: set a few spacings, or k.\n",
              getClassName().c_str(),
              search_radius_);
  result_.curvatures = curvaturesOf (found, located, output);
  result_.lines = std::move (found.lines);
  result_.statistics = std::move (found.statistics);
  result_.analysis = std::move (found.analysis);
  result_.normals = std::move (found.normals);
  result_.normal_check = std::move (found.normal_check);
  result_.line_cloud = surface_;
  if (!found.places.empty()) {
    auto moved = pcl::make_shared<PointCloudIn> (*surface_);
    for (const crest::LinePlace& place : found.places)
      (*moved)[static_cast<std::size_t> (place.point)].getVector3fMap() =
          place.position;
    result_.line_cloud = moved;
  }
  return true;
}

template <typename PointInT, typename PointOutT>
void
CrestLineEstimation<PointInT, PointOutT>::warnOfNormals (
    const crest::Extraction& found) const
{
  if (found.normals)
    crest::warnOfDoubt (getClassName(), *found.normals);
  if (!found.normal_check)
    return;
  const std::string findings = crest::explainFindings (found.normal_check->findings);
  if (!findings.empty())
    PCL_WARN ("[pcl::%s::compute] %s.%s\n",
              getClassName().c_str(),
              findings.c_str(),
              found.normal_check->findings.guessed == 0 ? "" : crest::SIDE_SETTERS);
}

template <typename PointInT, typename PointOutT>
void
CrestLineEstimation<PointInT, PointOutT>::computeFeature (PointCloudOut& output)
{
  const auto leaveNothing = [this, &output] {
    result_ = Result();
    output.clear();
    output.width = output.height = 0;
    // Feature::compute does so only where nothing is thrown.
    this->deinitCompute();
  };
  try {
    result_.complete = extract (output);
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
      vertices.vertices = pcl::Indices (polyline);
      lines.polygons.push_back (std::move (vertices));
    }
}

} // namespace pcl

#define PCL_INSTANTIATE_CrestLineEstimation(T, OutT)                                   \
  template class PCL_CREST_EXPORT pcl::CrestLineEstimation<T, OutT>
